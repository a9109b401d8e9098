#include "Deformation/DeformationStep.h"

#include "Deformation/FlipAvoidance.h"
#include "Stopwatch.h"

#include <algorithm>
#include <vector>

#include <sstream>
#include <stdexcept>

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
  solver.Solve(points, field.Displacements, settings.Energy, motion);
  if (!motion.allFinite())
  {
    std::ostringstream message;
    message << "the displacements, of up to " << field.Displacements.cwiseAbs().maxCoeff()
            << " mm, are too long to be computed with; limit them (MaximumDisplacement)";
    throw std::invalid_argument(message.str());
  }
  report.SolveSeconds = watch.Lap();

  if (guard != nullptr)
  {
    report.HeldBack = guard->Limit(points, motion, parallelFor, monitor).HeldBack;
    report.GuardSeconds = watch.Lap();
  }
  points += motion;
  std::transform(detected.begin(), detected.end(), field.States.begin(), field.States.begin(),
    [](VertexState before, VertexState now)
    { return before == VertexState::Flipping ? before : now; });
  return report;
}

} // namespace FlipFree
