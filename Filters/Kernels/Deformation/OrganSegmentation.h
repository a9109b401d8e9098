/**
 * The paper's Algorithm 1, from coarse to fine: from a smoothed image and a start surface to the
 * organ's surface.
 */
#ifndef FlipFreeOrganSegmentation_h
#define FlipFreeOrganSegmentation_h

#include "Deformation/DeformationStep.h"
#include "Deformation/StopReason.h"
#include "Deformation/TargetSearch.h"
#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

namespace FlipFree
{

struct OrganSegmentationSettings
{
  int Levels = 3;
  int MaximumIterations = 40; ///< per level

  /// A level ends when the mean distance to the targets is below DistanceTolerance, or fell by less
  /// than ChangeTolerance over five iterations; both in millimeters.
  double DistanceTolerance = 0.1;
  double ChangeTolerance = 0.02;

  bool ReestimateIntensities = true; ///< the intensities, at each level after the first
  bool Guard = true;

  OrganFeatureSettings Feature;
  TargetSettings Targets; ///< its EdgeWindow counts at the finest level
  DeformationStepSettings Step;
};

/// One row of the convergence table.
struct IterationRecord
{
  int Iteration = 0; ///< over all levels, from 1
  int Level = 0;     ///< from 0
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

/// Called after every iteration with the surface as it then is, and what was wanted of it.
using IterationObserver = std::function<void(const ContourMesh&, const PointList&,
  const CorrespondenceField&, const IterationRecord&)>;

/// Smooths what it needs of the region, and no more: with leak control, a box that holds all that
/// hangs together with the seed. Otherwise like the function below, and with the same result.
OrganSurface SegmentOrgan(SmoothRegion& region, double noise, const SeedSphere& seed,
  const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer);

/// `smooth` is the smoothed image of the reachable region, `noise` the deviation of the noise
/// before smoothing. Throws std::invalid_argument for bad input; a stop by the monitor gives the
/// surface reached and StopReason::Aborted.
OrganSurface SegmentOrgan(const ImageView<float>& smooth, double noise, const SeedSphere& seed,
  const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer);

} // namespace FlipFree

#endif
