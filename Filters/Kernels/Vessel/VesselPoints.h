/**
 * The points that a vessel is clicked by: what is wrong with them, the voxels that take their
 * place, and paths that end where they were clicked.
 */
#ifndef FlipFreeVesselPoints_h
#define FlipFreeVesselPoints_h

#include "Deformation/VolumeSegmentation.h"
#include "Vessel/VesselImage.h"

#include <string>

namespace FlipFree
{

/// Throws Error for fewer than two points, and for those outside the volume, named by `name`, in
/// one place, or in voxels without data.
void RequirePoints(const GrayVolume& volume, const PointList& points, const std::string& name);

/// The brightest cubes with data within `distance` millimeters of the points.
PointList Snap(const VesselImage& image, const PointList& points, double distance);

/// A path leads to where its points were snapped; the vessel ends where they were clicked.
void EndAtPoints(const PointList& snapped, const PointList& clicked, bool hasParent,
  PointList& line);

} // namespace FlipFree

#endif
