/**
 * What thin and wide vessels differ in, and wide ones that lead far away from their points.
 */
#ifndef FlipFreeVesselStyle_h
#define FlipFreeVesselStyle_h

#include "Vessel/CrossSections.h"
#include "Vessel/VesselSpeed.h"

namespace FlipFree
{

/// How a vessel is sought; the defaults are for wide ones.
struct VesselStyle
{
  /// The brightest voxel within this distance, in millimeters, takes the place of a clicked point.
  double SnapDistance = 0;
  /// How far from the points the path may run, in millimeters along the image's axes: an aorta's
  /// arch needs room, a thin vessel's path gets lost in it.
  double Margin = 60;
  double GridSpacing = 1.5; ///< of the grid on which the path is sought, mm
  VesselSpeedSettings Speed;
  CrossSectionSettings Sections;
};

VesselStyle ThinVessel();
VesselStyle FarVessel();

} // namespace FlipFree

#endif
