/**
 * Makes the foregrounds of several organs disjoint. A voxel that two organs claim goes to one of
 * them by a minimum cut (Y. Boykov, G. Funka-Lea: Graph cuts and efficient N-D image segmentation,
 * 2006) among the voxels that both claim: along edges of the image and with the smallest area,
 * between the voxels that each of them alone claims. Where the liver has leaked into a kidney's
 * upper end, all of that end is claimed twice. Distance would give half of it to each organ, and
 * gray values do not depend on location; the cut finds the layer between the two.
 */
#ifndef FlipFreeOrganDivision_h
#define FlipFreeOrganDivision_h

#include "Image/BitMask.h"
#include "Image/PointConstraint.h"
#include "Intensity/Modality.h"

#include <vector>

namespace FlipFree
{

/// An organ's foreground in a region of the volume.
struct OrganClaim
{
  BitMask Mask; ///< on the region's grid
  /// The smoothed image of the region; the voxels around the mask have values.
  ImageView<float> Smooth;
  std::array<int, 3> First{ { 0, 0, 0 } }; ///< of the region: voxel of the volume
  SeedSphere Seed;
  ConstraintList Constraints; ///< seeds and inside points are not given away
  double Noise = 0;           ///< standard deviation before smoothing
  /// On the region's grid: what stays of surfaces at rest, which no organ gets. May have no grid.
  BitMask Fixed;
  bool IsCut = false; ///< set by DivideClaims: whether the claim has lost voxels
};

/// Divides what claims have in common, takes from each what is thereby cut off from its seed, and
/// fills the holes of those that were cut, but for what belongs to another: then no two have a
/// voxel in common. Seeds of different organs do not overlap. The modality is not Automatic.
/// Returns false if the monitor stopped it; the masks are then useless.
bool DivideClaims(std::vector<OrganClaim>& claims, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif
