/**
 * The paper's Algorithm 1, from coarse to fine: from an image, a seed and a start surface to the
 * organ's surface.
 */
#ifndef FlipFreeOrganSegmentation_h
#define FlipFreeOrganSegmentation_h

#include "Deformation/SegmentationSettings.h"
#include "Deformation/StopReason.h"

namespace FlipFree
{

/// One row of the convergence table.
struct IterationRecord
{
  int Iteration = 0; ///< over all levels, from 1
  int Level = 0;     ///< from 0; those of the second run, after carving, count on
  int Vertices = 0;
  TargetReport Targets;
  DeformationStepReport Step;
  double SearchSeconds = 0;
};

struct OrganSurface
{
  ContourMesh Mesh;
  PointList Points;
  CorrespondenceField Field; ///< of the last iteration
  std::vector<IterationRecord> Iterations;
  StopReason Reason = StopReason::NotRun;
  std::ptrdiff_t SelfIntersections = 0;
  double SmoothingSeconds = 0;
  double FeatureSeconds = 0;
};

/// Called after every iteration with the surface, its last targets, and the iteration's record.
using IterationObserver = std::function<void(const ContourMesh&, const PointList&,
  const CorrespondenceField&, const IterationRecord&)>;

/// Smooths the region as far as it needs to. `noise` is the standard deviation of the noise before
/// smoothing. Throws Error for bad input; a stop by the monitor gives the surface reached so far
/// and StopReason::Aborted.
OrganSurface SegmentOrgan(SmoothRegion& region, double noise, const SeedSphere& seed,
  const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer);

} // namespace FlipFree

#endif
