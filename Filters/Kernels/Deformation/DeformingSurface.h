/**
 * The state of one surface while it deforms: the points it obeys, and each iteration's targets and
 * desired motion. Derived classes know what draws it; DeformationLoop moves one or several.
 */
#ifndef FlipFreeDeformingSurface_h
#define FlipFreeDeformingSurface_h

#include "Deformation/ConstraintEnforcer.h"
#include "Deformation/OrganSegmentation.h"
#include "Deformation/StartSurface.h"
#include "Deformation/UnchangedPlaces.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace FlipFree
{

class DeformingSurface
{
public:
  virtual ~DeformingSurface() = default;
  // A loop keeps its address.
  DeformingSurface(const DeformingSurface&) = delete;
  DeformingSurface& operator=(const DeformingSurface&) = delete;

  /// What errors of a run name the surface by, in front; none by default.
  void SetName(const std::string& name) { this->Name = name; }

  /// Frees the surface, not the evidence, for another run.
  void ReleaseSurface();

  /// Begins a run of all levels, which count from `firstLevel`. Throws Error, naming the point, if
  /// an outside point lies in the surface or on it.
  void BeginAt(const DeformableSurface& start, int firstLevel, const ConstraintList& constraints,
    OutsidePoints outside, const IterationObserver& observer);
  /// The run that has begun ends on this surface in unchanged places. Both must outlive it.
  void EndOn(const DeformableSurface& surface, const UnchangedPlaces& places)
  {
    this->End = &surface;
    this->EndPlaces = &places;
  }
  /// The run that has begun moves nothing in unchanged places.
  void StayIn(const UnchangedPlaces& places);
  void BeginLevel(int level);
  /// In place of a level: an iteration that finds targets and moves nothing.
  void Stay();
  /// The motion that the next iteration wants; none where the level has ended.
  PointList FindMotion();
  /// Ends the iteration with the vertices where the guard let them go. Not where the level has
  /// ended.
  void Move(PointList points, int guarded, double guardSeconds);
  /// Whether the level has ended for this surface, after the latest iteration; see the reason.
  bool HasLevelEnded() const { return this->Surface.Reason != StopReason::NotRun; }
  void SetReason(StopReason reason) { this->Surface.Reason = reason; }
  void Replace(ContourMesh mesh, PointList points);

  /// What the surface must not pass from now on, one row each.
  PointList GetObstacles() const;
  /// Looks which inside points the surface encloses by now.
  void UpdateObstacles();
  /// Whether there is anything to finish.
  bool HasConstraints() const { return this->Enforcer.has_value() || this->End; }
  /// Pulls the surface toward the points that it does not obey yet, or before the last level back
  /// from outside points alone (ConstraintEnforcer.h).
  bool FinishConstraints(bool isLast, const GuardedStep& step, const Monitor& monitor);

  /// Before each level but the first: looks anew for what the surface is drawn to. Returns false if
  /// the monitor stopped it.
  virtual bool Refit(const Monitor& /*monitor*/) { return true; }

  const ScheduleSettings& GetSchedule() const { return this->Schedule; }
  bool HasGuard() const { return this->Step.Guard; }
  OrganSurface& GetSurface() { return this->Surface; }
  const OrganSurface& GetSurface() const { return this->Surface; }

protected:
  /// Lengths of voxels, in millimeters.
  struct VoxelSpacing
  {
    double Finest = 1;   ///< the image's; how exactly points are obeyed is measured in it
    double Coarsest = 1; ///< where targets are sought; the unit of the schedule's tolerances
  };

  /// `parallelFor` must outlive the object.
  DeformingSurface(const ScheduleSettings& schedule, const DeformationStepSettings& step,
    const VoxelSpacing& spacing, const ParallelFor& parallelFor);

  /// A run begins.
  virtual void BeginRun() {}
  /// The targets of the surface as it is.
  virtual CorrespondenceField SearchTargets(TargetReport& report) = 0;
  bool IsInLastLevel() const { return this->Level + 1 >= this->Schedule.NumberOfLevels(); }

  const ParallelFor& Parallel;
  OrganSurface Surface;       // of the present run
  ConstraintList Constraints; // likewise

private:
  void BeginIteration();
  double MeanDistanceOfMobile() const;
  void FreePulled(const PointList& from);
  bool IsGrowing() const;
  StopReason ReasonToEndLevel() const;
  template <typename Call>
  auto Naming(const Call& call) const
  {
    return this->Name.empty() ? call() : NamingSurface(this->Name, call);
  }

  std::string Name;
  const ScheduleSettings Schedule;
  const DeformationStepSettings Step;
  const VoxelSpacing Spacing;

  // Of the present run.
  std::optional<ConstraintEnforcer> Enforcer;
  const DeformableSurface* End = nullptr;
  const UnchangedPlaces* EndPlaces = nullptr;
  Eigen::VectorXd Mobility; // one per vertex, 0 to 1; empty if all may move freely
  IterationObserver Observe;
  int FirstLevel = 0;

  // Of the present level.
  int Level = 0;
  std::optional<FaceHulls> Hulls; // if there are constraints
  std::unique_ptr<DeformationSolver> Solver;
  std::vector<double> Distances; // mean distances to the targets, by iteration
  std::vector<int> Matched;      // vertices, by iteration
  IterationRecord Record;
};

} // namespace FlipFree

#endif
