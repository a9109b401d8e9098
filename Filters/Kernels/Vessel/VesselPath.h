/**
 * A vessel between points, or the tree of vessels that joins them: the path, its center, and its
 * outline in cross-sections.
 *
 * Nobody is asked for the kind of vessel. The first pass takes it for a thin one: brighter than
 * what surrounds it, as portal and splenic veins are in enhanced CT. Where that pass finds one that
 * may be wide, such as aorta or cava, a second pass takes it for that: gray values may be those of
 * the surroundings, and a path must not run through wider bodies. Of both, the image's support
 * decides. Where the first pass finds a thin one that the image does not support, it may be a wide
 * one all the same, which it has missed, such as an aorta with its arch: a wide one is sought in a
 * larger part of the image, and taken if the image supports it better.
 *
 * A thin one that stays doubtful is sought again: away from where the image showed no outline, and
 * from the points as they were clicked rather than from the brightest voxels near them. Of these
 * paths, the one with the highest support is taken.
 *
 * Where the radius is given, there is one pass, for the vessel's kind, and for a wide one that the
 * image does not support the search in the larger part.
 */
#ifndef FlipFreeVesselPath_h
#define FlipFreeVesselPath_h

#include "Deformation/VolumeSegmentation.h"
#include "Vessel/CrossSections.h"
#include "Vessel/VesselSpeed.h"

namespace FlipFree
{

/// What thin and wide vessels differ in.
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
VesselStyle WideVessel();
VesselStyle FarVessel();

/// Outlines that the image supports less are doubtful.
constexpr double DoubtfulSupport = 0.8;

struct VesselPathSettings
{
  /// About the vessel's radius, in millimeters: which style it has, and how wide a body is no
  /// vessel. Zero: as found by a first pass.
  double Radius = 0;

  double WideRadius = 7;           ///< a vessel is wide from this radius on, mm
  double SmoothingDeviation = 0.8; ///< mm

  /// Added to the outline, in millimeters: gray values show the lumen.
  double WallThickness = 0.3;

  VesselStyle Thin = ThinVessel();
  VesselStyle Wide = WideVessel();
  VesselStyle Far = FarVessel();
};

struct VesselBranch
{
  VesselSections Sections;
  int Parent = -1;         ///< the earlier branch on which it begins; none for the first
  Eigen::VectorXd Support; ///< SectionSupport of each section
};

struct VesselTree
{
  std::vector<VesselBranch> Branches; ///< none where the monitor stopped it
  double Radius = 0;                  ///< mean, mm
  double Support = 0;                 ///< mean SectionSupport
};

/// The path keeps away from the places `outside`. Throws Error or std::invalid_argument, naming the
/// volume by `name`, for fewer than two points, points outside the volume or in one place, voxels
/// that are not finite near the points, and points that no path through like gray values joins.
/// Voxels that are not finite farther away only end the search there.
VesselTree TraceVessel(const GrayVolume& volume, const std::string& name, const PointList& points,
  const PointList& outside, const VesselPathSettings& settings, const Threading& threading,
  const Monitor& monitor);

} // namespace FlipFree

#endif
