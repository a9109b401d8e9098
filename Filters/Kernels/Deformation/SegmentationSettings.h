/**
 * All parameters of the method, with their defaults and presets, in the units of whoever sets them:
 * seed radii, voxels, and millimeters. Stages hold one of these structs each, and every front end
 * takes its defaults from them.
 */
#ifndef FlipFreeSegmentationSettings_h
#define FlipFreeSegmentationSettings_h

#include "Deformation/DeformationStep.h"
#include "Deformation/StopReason.h"
#include "Deformation/TargetSearch.h"
#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

#include <cstddef>
#include <string>
#include <vector>

namespace FlipFree
{

/// From coarse to fine, and when to stop.
struct ScheduleSettings
{
  int Resolution = 32; ///< vertices along an edge of a side of the final mesh (n)
  int Levels = 4;
  int MaximumIterations = 40; ///< per level

  /// A level ends when the mean distance to the targets is below DistanceTolerance, or fell by less
  /// than ChangeTolerance over ChangeSpan iterations; both in voxels of the greatest spacing.
  double DistanceTolerance = 0.1;
  double ChangeTolerance = 0.02;
  static constexpr std::size_t ChangeSpan = 5;

  /// The same rule for the mean distances so far, one per iteration: DistanceBelowTolerance,
  /// Converged if they no longer fall, or NotRun if the level goes on. `voxel` is the greatest
  /// spacing.
  StopReason ReasonToStop(const std::vector<double>& distances, double voxel) const;

  /// How many levels there are: those that would begin with fewer than two vertices along an edge
  /// are left out.
  int NumberOfLevels() const;

  /// n of the first level; each level doubles it.
  int FirstResolution() const;

  /// The same with another first surface than the sphere: no more levels than bring its number of
  /// vertices, which each further level makes four times as many, nearest to 6 n²; at least one.
  ScheduleSettings From(int vertices) const;
};

struct OrganSegmentationSettings
{
  ScheduleSettings Schedule;
  SmoothingSettings Smoothing;
  OrganFeatureSettings Feature;
  /// Its EdgeWindow counts at the finest level; of a carved foreground not at all, which ends at
  /// the edge by a rule of its own (HalfContrastRim.h).
  TargetSettings Targets;
  DeformationStepSettings Step;
};

/// The paper's own method: one level, outward search by voxels, no leak control, no guard.
OrganSegmentationSettings PublishedSettings();

/// As published, without flip avoidance (the paper's Fig. 3b).
OrganSegmentationSettings NaiveSettings();

/// By name: "published" or "naive"; any other name gives the defaults.
OrganSegmentationSettings SettingsOfPreset(const std::string& name);

} // namespace FlipFree

#endif
