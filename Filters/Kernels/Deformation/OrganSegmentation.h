/**
 * The paper's Algorithm 1, from coarse to fine: from an image, a seed and a start surface to the
 * organ's surface.
 */
#ifndef FlipFreeOrganSegmentation_h
#define FlipFreeOrganSegmentation_h

#include "Deformation/SegmentationSettings.h"
#include "Deformation/StartSurface.h"
#include "Deformation/StopReason.h"
#include "Evidence/CarvedForeground.h"
#include "Image/PointConstraint.h"

#include <memory>
#include <optional>

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
  DeformableSurface First;   ///< what the first run ended with; empty without carving
  CarvingReport Carving;     ///< how sure the foreground is that the first run gave
  std::vector<IterationRecord> Iterations;
  StopReason Reason = StopReason::NotRun;
  std::ptrdiff_t SelfIntersections = 0;
  double SmoothingSeconds = 0;
  double FeatureSeconds = 0;
};

/// Called after every iteration with the surface, its last targets, and the iteration's record.
using IterationObserver = std::function<void(const ContourMesh&, const PointList&,
  const CorrespondenceField&, const IterationRecord&)>;
inline void ObserveNothing(const ContourMesh&, const PointList&, const CorrespondenceField&,
  const IterationRecord&)
{
}

class DeformingOrgan;

/// Finds the surface of one organ in a smoothed image, from a seed and a start surface, again and
/// again with other constraints. What these do not change is kept between calls: the smoothed
/// image, and with carving the foreground of the first run and the surface without constraints
/// (UnchangedPlaces.h). The surface depends on the list of constraints alone, not on its order or
/// on earlier calls.
class OrganSegmenter
{
public:
  /// Smooths the region as far as it needs to; it and `parallelFor` must outlive the object.
  /// `noise` is the standard deviation of the noise before smoothing.
  OrganSegmenter(SmoothRegion& region, double noise, const SeedSphere& seed,
    const DeformableSurface& start, const OrganSegmentationSettings& settings,
    const ParallelFor& parallelFor);
  ~OrganSegmenter();
  OrganSegmenter(const OrganSegmenter&) = delete;
  OrganSegmenter& operator=(const OrganSegmenter&) = delete;

  /// Takes a mask of the region in place of the foreground that is found in the image, and its
  /// carving. The surface is then that of the mask, corrected by constraints; nothing deforms it
  /// but those that it does not obey yet, and the start surface has no part in it.
  void SetForeground(BitMask mask);

  /// Throws Error for bad input, and where a constraint cannot be obeyed, naming it; a stop by the
  /// monitor gives the surface reached so far and StopReason::Aborted. The observer sees the
  /// iterations that are run, not those of a first run that is kept. Constraints need the guard.
  /// `start`, if not null, takes the place of the start surface; with carving only in the second
  /// run, which alone knows of constraints.
  OrganSurface FindSurface(const ConstraintList& constraints, const DeformableSurface* start,
    const Monitor& monitor, const IterationObserver& observer);

  /// The voxels of the region that leave or enter the foreground, for which constraints hold, by
  /// one more constraint. Runs nothing. None where the foreground is neither carved nor given, and
  /// before it is known.
  std::optional<BitMask> PreviewForeground(const ConstraintList& constraints,
    const PointConstraint& next, const Monitor& monitor);

  // What FindSurface() consists of, for several organs together (OrganGroup.h).

  /// Whether the levels run twice: once to find what the foreground is carved from.
  bool RunsTwice() const;
  /// Finds the foreground, by a first run if need be. The observer sees that run. Returns false if
  /// the monitor, which remembers a stop (RememberingMonitor), stopped it.
  bool FindForeground(const ConstraintList& constraints, const Monitor& monitor,
    const IterationObserver& observer);
  /// Begins the run that ends with the result; DeformationLoop does the rest.
  void Begin(const ConstraintList& constraints, const DeformableSurface* start,
    OutsidePoints outside, const IterationObserver& observer);
  DeformingOrgan& GetOrgan();

private:
  // FindSurface() calls these; RunFrom() also RunScheduler::Run():
  //
  //   FillForeground()             with a given foreground, in place of all that follows
  //   RunFrom()
  //     FindForeground()
  //       RunAndCarve()            with carving, in the first call: finds what the foreground is
  //                                carved from
  //       RunWithoutConstraints()  with constraints, if the foreground is carved, unless an earlier
  //                                call has made the surface that they correct

  bool FillForeground(const ConstraintList& constraints, const Monitor& monitor,
    const IterationObserver& observer);
  std::optional<BitMask> ForegroundBy(const ConstraintList& constraints, const Monitor& monitor);
  bool RunAndCarve(const Monitor& monitor, const IterationObserver& observer);
  bool RunWithoutConstraints(const Monitor& monitor);
  void KeepUnconstrained();

  // Where the run that ends with the result starts. Refers to the surface.
  struct RunStart
  {
    const DeformableSurface& Surface;
    int Level; // from which levels are counted
  };
  RunStart StartOf(const DeformableSurface* given) const;
  bool RunFrom(const DeformableSurface* start, const ConstraintList& constraints,
    const Monitor& monitor, const IterationObserver& observer);

  struct State;
  std::unique_ptr<State> Kept;
  const ParallelFor& Parallel;
};

} // namespace FlipFree

#endif
