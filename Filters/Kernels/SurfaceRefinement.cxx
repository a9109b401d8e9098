#include "SurfaceRefinement.h"

#include "EmbeddingGuard.h"
#include "LaplacianDeformation.h"
#include "MeshRefinement.h"
#include "SelfIntersection.h"

namespace FlipFree
{
namespace
{

constexpr int MostFairingSteps = 30;
constexpr double Fairing = 0.5;

void FairOnce(const ContourMesh& mesh, const EmbeddingGuard& guard, const ParallelFor& parallelFor,
  const Monitor& monitor, PointList& points)
{
  DeformationSettings settings;
  settings.Fairing = Fairing;
  const PointList noTargets = PointList::Zero(points.rows(), 3);
  PointList motion = noTargets;
  SolveDeformation(mesh, points, noTargets, settings, motion);
  guard.Limit(points, motion, parallelFor, monitor);
  points += motion;
}

} // namespace

RefinedSurface RefineSurface(const ContourMesh& mesh, const PointList& points, bool checked,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  const RefinedMesh faces = RefineFaces(mesh);
  RefinedSurface refined;
  refined.Mesh = BuildContourMesh(static_cast<int>(faces.Parents.size()), faces.Faces);
  if (!checked)
  {
    refined.Points = RefinePoints(mesh, points, 1);
    refined.Embedded = true;
    return refined;
  }
  const EmbeddingGuard guard(mesh);
  PointList coarse = points;
  for (; refined.FairingSteps <= MostFairingSteps; ++refined.FairingSteps)
  {
    for (double reach : { 1.0, 0.5, 0.25, 0.1 })
    {
      if (!monitor(static_cast<double>(refined.FairingSteps) / MostFairingSteps))
      {
        return refined;
      }
      refined.Points = RefinePoints(mesh, coarse, reach);
      if (CountSelfIntersections(refined.Points, refined.Mesh.Triangles) == 0)
      {
        refined.Embedded = true;
        return refined;
      }
    }
    FairOnce(mesh, guard, parallelFor, monitor, coarse);
  }
  return refined;
}

} // namespace FlipFree
