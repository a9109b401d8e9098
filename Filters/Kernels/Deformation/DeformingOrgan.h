/**
 * The state of one organ while its surface deforms: the evidence of where it ends, the points it
 * obeys, the surface, and each iteration's targets and desired motion. JointDeformation moves one
 * or several of them.
 */
#ifndef FlipFreeDeformingOrgan_h
#define FlipFreeDeformingOrgan_h

#include "Deformation/ConstraintEnforcer.h"
#include "Deformation/OrganSegmentation.h"
#include "Deformation/StartSurface.h"
#include "Deformation/UnchangedPlaces.h"
#include "Evidence/ForegroundCorrection.h"
#include "Intensity/OrganForeground.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace FlipFree
{

class DeformingOrgan
{
public:
  /// The region and `parallelFor` must outlive the object. `noise` is the standard deviation before
  /// smoothing.
  DeformingOrgan(SmoothRegion& region, double noise, const SeedSphere& seed,
    const OrganSegmentationSettings& settings, const ParallelFor& parallelFor);
  // Neither copied nor moved: the foreground refers to this object's seed and settings.
  DeformingOrgan(const DeformingOrgan&) = delete;
  DeformingOrgan& operator=(const DeformingOrgan&) = delete;

  /// What errors of a run name the organ by, in front; none by default.
  void SetName(const std::string& name) { this->Name = name; }

  /// Frees the surface, not the evidence, for another run; `seconds` is what earlier runs of the
  /// same call took to find the evidence.
  void ReleaseSurface(double seconds = 0);

  // The evidence. Functions that may take long return false if the monitor stopped them.

  bool FindForegroundOfSeed(const Monitor& monitor);
  /// Refits the intensities to the surface, finds the foreground anew by their threshold, and
  /// corrects it by the run's constraints.
  bool RefitForeground(const Monitor& monitor);
  /// Makes the foreground by the surface and the image around it (CarvedForeground.h). It is then
  /// settled.
  bool CarveSurface(const Monitor& monitor);
  /// Corrects the foreground by constraints (ForegroundCorrection.h).
  bool CorrectForeground(const ConstraintList& constraints, const Monitor& monitor);
  /// Takes a foreground from elsewhere, which is settled.
  void SettleForeground(BitMask mask);
  /// Whether later levels keep the foreground as it is.
  bool IsSettled() const { return this->Settled; }
  OrganForeground& GetForeground() { return this->Foreground; }

  // The surface.

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
  /// Whether the level has ended for this organ, after the latest iteration; see the reason.
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

  const OrganSegmentationSettings& GetSettings() const { return this->Settings; }
  OrganSurface& GetSurface() { return this->Surface; }
  const OrganSurface& GetSurface() const { return this->Surface; }

private:
  bool FindOthers(const CarvedForegroundInputs& inputs, const CarvedForeground& carved,
    const Monitor& monitor);
  ForegroundImage CorrectedImage(const Monitor& monitor);
  bool FindForegroundOfSurface(const Monitor& monitor);
  bool SnapsToEdges() const;
  void FindTargets();
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
  const double Noise;
  const SeedSphere Seed;
  const OrganSegmentationSettings Settings;
  const ParallelFor& Parallel;
  const double Voxel; // the greatest spacing
  OrganForeground Foreground;
  TissueGrowth NewTissue;
  IntensityModel OfSeed;
  IntensityModel Model;          // refitted
  double OrganRadius;            // the seed's, until more is known
  BitMask Candidate;             // of carving
  std::vector<OtherPart> Others; // about which other opinions disagree with what was carved
  bool Settled = false;

  // Of the present run.
  OrganSurface Surface;
  ConstraintList Constraints;
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
