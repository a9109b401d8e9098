/**
 * Which kind of gray values an image has: what is known about their scale in advance.
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
  MR = 2  ///< any unit; the coil may brighten what is near it
};

/// CT if a hundredth of the voxels are as negative as fat in Hounsfield units, and not just a
/// little below zero in comparison with the brightest, as interpolation leaves them, while the
/// brightest hundredth begins where tissue, bone or contrast medium may; else MR, whose values have
/// no sign, or any unit. A grid of samples with data decides.
Modality ModalityOf(const VoxelReader& read, const ImageGeometry& geometry);

/// The modality given, or what the image looks like if it is Automatic.
Modality ResolveModality(Modality given, const VoxelReader& read, const ImageGeometry& geometry);

} // namespace FlipFree

#endif
