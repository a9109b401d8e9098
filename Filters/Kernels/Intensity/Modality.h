/**
 * Which kind of gray values an image has: what is known of their scale beforehand.
 */
#ifndef FlipFreeModality_h
#define FlipFreeModality_h

#include "Image/AnisotropicDiffusion.h"

namespace FlipFree
{

enum class Modality
{
  Automatic = 0,
  CT = 1, ///< Hounsfield units
  MR = 2  ///< any unit; a coil's field may brighten what is near it
};

/// CT if enough of the gray values are as negative as fat and air are in Hounsfield units, else MR,
/// whose values have no sign. A grid of samples decides.
Modality ModalityOf(const VoxelReader& read, const ImageGeometry& geometry);

} // namespace FlipFree

#endif
