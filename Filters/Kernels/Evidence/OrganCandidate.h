/**
 * All that may be the organ: what a surface encloses that has found it, more or less, and what else
 * has its gray values and is connected with it. A surface that grows misses what lies behind a neck
 * or is thin, such as the far end of a liver's left lobe; voxels reach it.
 */
#ifndef FlipFreeOrganCandidate_h
#define FlipFreeOrganCandidate_h

#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

namespace FlipFree
{

struct OrganCandidateSettings
{
  double Reach = 25; ///< mm around the box of the surface's inside; beyond it, nothing is added

  /// A foreground of more than this many times the volume inside the surface has leaked, so that
  /// nothing of it is added.
  double GreatestGrowth = 1.2;
};

/// Adds the foreground by the gray values inside a surface to a mask of the voxels inside, on the
/// grid of the image; nothing in MR, where the coil's field gives the same tissue another
/// gray value elsewhere, and nothing without leak control or re-estimation. `makeSmooth` is called
/// before voxels are read. Returns false if the monitor stopped it; the mask is then useless.
bool AddForeground(const ImageView<float>& smooth, const ImageMaker& makeSmooth,
  const SeedSphere& seed, double noise, const OrganFeatureSettings& settings,
  const OrganCandidateSettings& limits, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask);

} // namespace FlipFree

#endif
