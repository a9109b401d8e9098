#include "Deformation/DeformationStep.h"

#include "Deformation/FlipAvoidance.h"
#include "Stopwatch.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace FlipFree
{

PointList FindMotion(DeformationSolver& solver, const DeformationStepSettings& settings,
  const PointList& points, CorrespondenceField& field, DeformationStepReport& report)
{
  const ContourMesh& mesh = solver.GetMesh();
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
  std::transform(detected.begin(), detected.end(), field.States.begin(), field.States.begin(),
    [](VertexState before, VertexState now)
    { return before == VertexState::Flipping ? before : now; });
  report.SolveSeconds = watch.Lap();
  return motion;
}

DeformationStepReport DeformOnce(DeformationSolver& solver, EmbeddingGuard* guard,
  const DeformationStepSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  CorrespondenceField& field, PointList& points)
{
  DeformationStepReport report;
  PointList motion = FindMotion(solver, settings, points, field, report);
  Stopwatch watch;
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
  return report;
}

} // namespace FlipFree
