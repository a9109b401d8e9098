/**
 * A vessel between points, or the tree of vessels that joins them: the path, its center, and its
 * outline in cross-sections.
 *
 * Users need not say what kind of vessel it is. The first pass assumes a thin one: brighter than
 * its surroundings, as portal and splenic veins are in enhanced CT. If that pass finds a vessel
 * that may be wide, such as aorta or cava, a second pass assumes a wide one: gray values may be
 * those of the surroundings, and a path must not run through wider bodies. The image's support
 * decides between the two. If the first pass finds a thin vessel that the image does not support,
 * it may have missed a wide one, such as an aorta with its arch: a wide one is then sought in a
 * larger part of the image, and taken if the image supports it better.
 *
 * A thin one that stays doubtful is sought again: away from where the image showed no outline, and
 * from the points as they were clicked rather than from the brightest voxels near them. Of these
 * paths, the one with the highest support is taken.
 *
 * If the radius is given, there is one pass, for that kind of vessel, and, for a wide one that the
 * image does not support, the search in the larger part.
 */
#ifndef FlipFreeVesselPath_h
#define FlipFreeVesselPath_h

#include "Deformation/VolumeSegmentation.h"
#include "Intensity/Modality.h"
#include "Vessel/VesselSearch.h"

namespace FlipFree
{

struct VesselPathSettings
{
  /// About the vessel's radius, in millimeters: which style it has, and how wide a body is no
  /// vessel. Zero: as found by a first pass.
  double Radius = 0;

  double WideRadius = 7;           ///< a vessel is wide from this radius on, mm
  double SmoothingDeviation = 0.8; ///< mm

  /// Added to the outline, in millimeters: gray values show the lumen.
  double WallThickness = 0.3;

  /// Of the gray values, whose contrast tells where a vessel ends: those of MR are scaled to about
  /// Hounsfield units first.
  FlipFree::Modality Modality = FlipFree::Modality::Automatic;

  VesselStyle Thin = ThinVessel();
  VesselStyle Wide;
  VesselStyle Far = FarVessel();
};

/// The path keeps away from the places `outside`. Throws Error, naming the volume by `name`, for
/// fewer than two points, points outside the volume, in one place or in voxels without data,
/// through which no path runs, and points that no path through like gray values joins.
VesselTree TraceVessel(const GrayVolume& volume, const std::string& name, const PointList& points,
  const PointList& outside, const VesselPathSettings& settings, const Threading& threading,
  const Monitor& monitor);

} // namespace FlipFree

#endif
