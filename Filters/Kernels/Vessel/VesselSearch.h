/**
 * The search for a vessel of one style in the part of the image around its points: the path, and
 * the outline around it.
 */
#ifndef FlipFreeVesselSearch_h
#define FlipFreeVesselSearch_h

#include "Vessel/VesselImage.h"
#include "Vessel/VesselStyle.h"
#include "Vessel/VesselTree.h"

namespace FlipFree
{

/// Outlines that the image supports less are doubtful.
constexpr double DoubtfulSupport = 0.8;

/// The search for a vessel of one style: first as it is clicked, and where that is doubtful again.
class VesselSearch
{
public:
  VesselSearch(const VesselStyle& style, const PointList& clicked, const PointList& outside,
    double radius, VesselImage image, const ParallelFor& parallelFor);

  /// Nothing where the monitor stopped it.
  VesselTree Seek(const Monitor& monitor);

  /// Where a first result is doubtful, other paths: away from where the image showed no outline,
  /// and from the points as they are clicked, since what is brightest near them may be something
  /// else. The first one that is not doubtful is taken, or that with the highest support. Nothing
  /// where the monitor stopped it.
  VesselTree SeekBetter(const VesselTree& found, const Monitor& monitor);

  /// Whether the image hardly shows the outline, or does not over a long stretch.
  bool IsDoubtful(const VesselTree& tree) const;

private:
  // From points that are snapped so far: where a vessel through them may run.
  void Begin(double snapDistance);
  void CloseNoData();

  // The paths that join the points, and the outline around them.
  VesselTree Trace(const Monitor& monitor) const;

  const VesselStyle& Style;
  const PointList& Clicked;
  const PointList& Outside;
  double Radius;
  VesselImage Image;
  const ParallelFor& Parallel;
  SpeedScales Scales; // the same whatever the points are snapped to
  PointList Points;
  FloatImage Depth;
  FloatImage Speed;
};

} // namespace FlipFree

#endif
