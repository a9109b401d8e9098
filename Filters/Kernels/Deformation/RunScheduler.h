/**
 * The runs of an OrganSegmenter that end with the result. Where the surface without constraints is
 * known, constraints correct it only where they have changed the foreground, so that no constraint
 * moves the surface elsewhere.
 */
#ifndef FlipFreeRunScheduler_h
#define FlipFreeRunScheduler_h

#include "Deformation/DeformingOrgan.h"

#include <memory>
#include <utility>

namespace FlipFree
{

/// What all these runs are called with, for all or a part of the work. Refers to everything but the
/// monitor.
struct RunInputs
{
  const ConstraintList& Constraints;
  const DeformableSurface& Start;
  int FirstLevel;             ///< from which levels are counted
  const BitMask& Uncorrected; ///< the foreground without constraints, if the surface is known
  Monitor Proceed;
  const IterationObserver& Observer;

  /// The same with other constraints.
  RunInputs With(const ConstraintList& constraints) const;
  /// For the part of the work from the fraction `first` to `last`. Refers to this object.
  RunInputs Part(double first, double last) const;
};

class RunScheduler
{
public:
  /// Both must outlive the object.
  RunScheduler(DeformingOrgan& organ, const ParallelFor& parallelFor);
  ~RunScheduler();
  // Neither copied nor moved: the organ refers to what is kept here.
  RunScheduler(const RunScheduler&) = delete;
  RunScheduler& operator=(const RunScheduler&) = delete;

  /// What Run() gives without constraints.
  void SetSurface(DeformableSurface surface) { this->Surface = std::move(surface); }
  bool HasSurface() const { return this->Surface.Points.rows() > 0; }
  /// Frees the surface, and what is kept of earlier runs.
  void Release();

  /// Runs the organ, whose foreground the constraints have corrected, to the result. Returns false
  /// if the monitor stopped it. Throws Error where a constraint cannot be obeyed.
  bool Run(const RunInputs& inputs);

private:
  void Begin(OutsidePoints outside, const RunInputs& inputs);
  /// From the start surface. Where the constraints change nothing, it ends on the surface without
  /// them, if there is one. Where it cannot be pulled back from an outside point, it keeps off from
  /// the start.
  bool RunAllLevels(const RunInputs& inputs);
  /// From a surface as fine as the result, which stays as it is in unchanged places.
  bool RunLastLevelFrom(const DeformableSurface& from, const UnchangedPlaces& unchanged,
    const RunInputs& inputs);

  struct DeepChange;
  /// Moves the surface without constraints only where these have changed the foreground, to
  /// `corrected`: what changes deeply in a run of all levels, the rest in one of the last level.
  bool Correct(const BitMask& corrected, const RunInputs& inputs);
  bool RunDeepChange(const RunInputs& inputs, DeepChange& change);

  DeformingOrgan& Organ;
  const ParallelFor& Parallel;
  DeformableSurface Surface; // without constraints
  std::unique_ptr<DeepChange> Deep;
};

} // namespace FlipFree

#endif
