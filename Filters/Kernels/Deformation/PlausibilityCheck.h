/**
 * Signs that a surface is not the organ's. A seed in air, or in anything else that is not an organ,
 * still gives a surface.
 */
#ifndef FlipFreePlausibilityCheck_h
#define FlipFreePlausibilityCheck_h

#include "Deformation/OrganSegmentation.h"

namespace FlipFree
{

enum class ImplausibilityReason
{
  None,
  EndOfReach,    ///< the surface touches a side of the region where the image goes on
  NoBoundary,    ///< more than a tenth of the vertices found no boundary
  ImageBoundary, ///< more than a quarter lie at the image's boundary along two axes
};

struct Implausibility
{
  ImplausibilityReason Reason = ImplausibilityReason::None;
  double Fraction = 0; ///< of the vertices that cause it
};

/// Compares a surface with the reachable region and with the whole image. A surface that does not
/// start at the seed, may fold unguarded, or has shorter search lines than by default is only
/// tested for EndOfReach: it may have missed more of its boundary.
Implausibility CheckPlausibility(const OrganSurface& organ, const ImageGeometry& region,
  const ImageGeometry& image, double seedRadius, const OrganSegmentationSettings& settings,
  bool startsAtSeed);

} // namespace FlipFree

#endif
