/**
 * The points that a vessel is clicked by: what is wrong with them, the voxels that take their
 * place, and paths that end where they were clicked.
 */
#ifndef FlipFreeVesselPoints_h
#define FlipFreeVesselPoints_h

#include "Image/SeedRegion.h"
#include <string>

namespace FlipFree
{

/// Throws Error for fewer than two points, and for those outside the volume, named by `name`, or in
/// one place.
void RequirePoints(const ImageGeometry& geometry, const PointList& points, const std::string& name);

/// The brightest voxels within `distance` millimeters of the points.
PointList Snap(const ImageView<float>& image, const PointList& points, double distance);

/// A path leads to where its points were snapped; the vessel ends where they were clicked.
void EndAtPoints(const PointList& snapped, const PointList& clicked, bool hasParent,
  PointList& line);

} // namespace FlipFree

#endif
