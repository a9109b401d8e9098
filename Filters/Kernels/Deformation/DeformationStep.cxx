#include "Deformation/DeformationStep.h"

#include "Deformation/FlipAvoidance.h"
#include "Stopwatch.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace FlipFree
{

DeformationStepReport DeformOnce(DeformationSolver& solver, const EmbeddingGuard* guard,
  const DeformationStepSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  CorrespondenceField& field, PointList& points)
{
  const ContourMesh& mesh = solver.GetMesh();
  DeformationStepReport report;
  Stopwatch watch;
  report.Flipping = DetectFlips(mesh, points, settings.FlipThreshold, field);
  const std::vector<VertexState> detected = field.States;
  if (settings.AvoidFlips)
  {
    AvoidFlips(mesh, points, settings.FlipThreshold, field);
  }
  DiffuseDisplacements(mesh, settings.Propagation, field);
  report.FlipSeconds = watch.Lap();

  PointList motion = field.Displacements;
  report.Solver = solver.Solve(points, field.Displacements, settings.Energy, motion);
  report.SolveSeconds = watch.Lap();

  if (guard != nullptr)
  {
    GuardReport limited = guard->Limit(points, motion, parallelFor, monitor);
    report.Guarded = limited.Guarded;
    points = std::move(limited.Positions);
    report.GuardSeconds = watch.Lap();
  }
  else
  {
    points += motion;
  }
  std::transform(detected.begin(), detected.end(), field.States.begin(), field.States.begin(),
    [](VertexState before, VertexState now)
    { return before == VertexState::Flipping ? before : now; });
  return report;
}

} // namespace FlipFree
