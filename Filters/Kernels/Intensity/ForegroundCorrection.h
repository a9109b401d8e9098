/**
 * Obeys constraints in a foreground: where a point is on the wrong side, the part around it that
 * looks like it changes sides, up to where a minimum cut finds an edge or a neck (CorrectionCut.h).
 *
 * An inside point adds voxels, an outside point removes some. The points farthest on the wrong side
 * come first, so the order of the list means nothing. What an inside point adds far away is led to
 * the rest by a bridge.
 */
#ifndef FlipFreeForegroundCorrection_h
#define FlipFreeForegroundCorrection_h

#include "Image/BitMask.h"
#include "Image/PointConstraint.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// Makes the image have values in a box. Returns false if a monitor stopped it.
using ImageMaker = std::function<bool(const VoxelBox& box)>;

/// Corrects `foreground` and keeps what is connected with the seed. Boundary points do not count
/// here. `make` is called before voxels are read. `noise` is the standard deviation before
/// smoothing; the modality is not Automatic. Returns false if the monitor stopped it; the
/// foreground is then useless.
bool CorrectForeground(const ImageView<float>& smooth, const ImageMaker& make,
  const SeedSphere& seed, const ConstraintList& constraints, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground);

} // namespace FlipFree

#endif
