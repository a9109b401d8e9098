/**
 * A vessel between points, or a tree of vessels, as every front end runs it: path, outline
 * in cross-sections, start surface within the outline, and its deformation onto the outline under
 * the guard; corrected by points inside, outside, and on the boundary.
 */
#ifndef FlipFreeVesselSegmentation_h
#define FlipFreeVesselSegmentation_h

#include "Deformation/VolumeSegmentation.h"
#include "Image/PointConstraint.h"
#include "Vessel/VesselConfidence.h"
#include "Vessel/VesselPath.h"

namespace FlipFree
{

struct VesselSegmentationSettings
{
  VesselPathSettings Path;

  /// Levels from coarse to fine; each doubles the vertices along an edge. One ends by the rule of
  /// ScheduleSettings, with its defaults, in voxels of the grid on which the outline is drawn.
  int Levels = 2;
  int MaximumIterations = 20; ///< per level
  int LabelValue = 1;         ///< of the vessel's voxels; read by those who make the label map
  TargetSettings Targets;
  DeformationStepSettings Step;
  VesselConfidenceSettings Confidence;
};

struct VesselSegmentation
{
  VesselTree Tree;
  VesselConfidence Confidence;
  OrganSurface Surface; ///< of triangles and quads, a mesh at rest
  std::vector<VoxelRun> Voxels;
  std::vector<std::string> Warnings; ///< a message each, with its remedy
  /// Path, outline to start surface, deformation, label map.
  std::array<double, 4> StageSeconds{ { 0, 0, 0, 0 } };
};

/// `name` is the volume's. The path keeps away from outside points, the outline is moved to all of
/// the constraints, and the surface obeys them exactly; further seeds are refused. Throws Error for
/// bad input and for a constraint that cannot be obeyed, and std::logic_error if a guarded surface
/// should intersect itself. A stop by the monitor gives StopReason::Aborted.
VesselSegmentation SegmentVessel(const GrayVolume& volume, const std::string& name,
  const PointList& points, const ConstraintList& constraints,
  const VesselSegmentationSettings& settings, const Threading& threading, const Monitor& monitor);

} // namespace FlipFree

#endif
