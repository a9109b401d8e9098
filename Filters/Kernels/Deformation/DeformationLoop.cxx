#include "Deformation/DeformationLoop.h"

#include "Geometry/WindingNumber.h"
#include "Guard/SurfaceRefinement.h"
#include "Mesh/MeshRefinement.h"
#include "Mesh/MeshUnion.h"
#include "Stopwatch.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{

bool NoneIsWithinAnother(const std::vector<const DeformableSurface*>& surfaces)
{
  for (const DeformableSurface* outer : surfaces)
  {
    for (const DeformableSurface* inner : surfaces)
    {
      if (inner != outer &&
        WindingNumber(outer->Points, outer->Mesh.Triangles, inner->Points.row(0).transpose()) != 0)
      {
        return false;
      }
    }
  }
  return true;
}

DeformationLoop::DeformationLoop(std::vector<DeformingSurface*> surfaces,
  std::vector<DeformableSurface> fixed, const ParallelFor& parallelFor)
  : Surfaces(std::move(surfaces))
  , FixedParts(std::move(fixed))
  , Parallel(parallelFor)
  , Levels(this->Surfaces.front()->GetSchedule().NumberOfLevels())
{
  this->Fixed.Points.resize(0, 3);
  for (const DeformableSurface& part : this->FixedParts)
  {
    AppendMesh(part.Mesh, this->Fixed.Mesh);
    AppendPoints(part.Points, this->Fixed.Points);
  }
}

bool DeformationLoop::Run(const Monitor& monitor)
{
  const auto until = [&](int level)
  { return [&monitor, level, this](double) { return monitor(double(level) / this->Levels); }; };
  for (int level = 0; level < this->Levels; ++level)
  {
    if (level > 0)
    {
      const Monitor proceed = until(level);
      const RememberingMonitor remembering(proceed);
      if (!this->Refine(remembering.Get()))
      {
        if (remembering.HasStopped())
        {
          return false;
        }
        for (DeformingSurface* surface : this->Surfaces)
        {
          surface->SetReason(ReasonOfUnrefined(surface->GetSurface().Reason));
        }
        break;
      }
      if (!this->Refit(remembering.Get()) ||
        (level + 1 == this->Levels && !this->FinishConstraints(false, remembering.Get())))
      {
        return false;
      }
    }
    if (!this->IterateLevel(level, monitor))
    {
      return false;
    }
  }
  return this->FinishConstraints(true, until(this->Levels));
}

bool DeformationLoop::RunLastLevel(const Monitor& monitor)
{
  const int last = this->Levels - 1;
  return this->IterateLevel(last, monitor) && this->FinishConstraints(false, monitor) &&
    this->IterateLevel(last, monitor) && this->FinishConstraints(true, monitor);
}

bool DeformationLoop::Stay(const Monitor& monitor)
{
  for (DeformingSurface* surface : this->Surfaces)
  {
    surface->Stay();
  }
  return monitor(0) && this->FinishConstraints(true, monitor);
}

bool DeformationLoop::HasGuard() const
{
  return this->Surfaces.front()->HasGuard();
}

void DeformationLoop::Unite()
{
  this->Mesh = {};
  this->Parts.clear();
  for (const DeformingSurface* surface : this->Surfaces)
  {
    const int begin = this->Mesh.NumberOfPoints();
    AppendMesh(surface->GetSurface().Mesh, this->Mesh);
    this->Parts.push_back({ begin, this->Mesh.NumberOfPoints() });
  }
}

PointList DeformationLoop::PartOf(const PointList& all, std::size_t surface) const
{
  const VertexRange& part = this->Parts[surface];
  return all.middleRows(part.Begin, part.End - part.Begin);
}

// Each surface is stopped by its own obstacles only: what lies outside one may lie inside another.
PointList DeformationLoop::UniteObstacles(std::vector<VertexRange>& ranges) const
{
  PointList obstacles(0, 3);
  ranges.clear();
  for (std::size_t surface = 0; surface < this->Surfaces.size(); ++surface)
  {
    AppendPoints(this->Surfaces[surface]->GetObstacles(), obstacles);
    ranges.resize(obstacles.rows(), this->Parts[surface]);
  }
  return obstacles;
}

bool DeformationLoop::Refit(const Monitor& proceed)
{
  return std::all_of(this->Surfaces.begin(), this->Surfaces.end(),
    [&](DeformingSurface* surface) { return surface->Refit(proceed); });
}

bool DeformationLoop::Refine(const Monitor& proceed)
{
  this->Unite();
  PointList points(0, 3);
  for (const DeformingSurface* surface : this->Surfaces)
  {
    AppendPoints(surface->GetSurface().Points, points);
  }
  RefinementSurroundings surroundings;
  surroundings.Obstacles = this->UniteObstacles(surroundings.Ranges);
  surroundings.FixedMesh = this->Fixed.Mesh;
  surroundings.FixedPoints = this->Fixed.Points;
  RefinedSurface refined =
    RefineSurface(this->Mesh, points, surroundings, this->HasGuard(), this->Parallel, proceed);
  if (!refined.Embedded)
  {
    return false;
  }
  // The refinement of the union is the union of the refinements: vertices come in the order of the
  // old corners.
  std::vector<DeformableSurface> parts;
  if (this->Surfaces.size() == 1)
  {
    parts.push_back({ std::move(refined.Mesh), std::move(refined.Points) });
  }
  else
  {
    refined.Guard.reset(); // its faces come in another order
    Eigen::Index first = 0;
    for (const DeformingSurface* surface : this->Surfaces)
    {
      const FaceList faces = RefineFaces(surface->GetSurface().Mesh).Faces;
      const auto count = static_cast<int>(surface->GetSurface().Mesh.Faces.Connectivity.size());
      parts.push_back({ BuildContourMesh(count, faces), refined.Points.middleRows(first, count) });
      first += count;
    }
  }
  // Refinement is not a motion, so it is not enough that the surfaces do not meet.
  if (this->HasGuard())
  {
    std::vector<const DeformableSurface*> all;
    const auto add = [&all](const DeformableSurface& surface) { all.push_back(&surface); };
    std::for_each(parts.begin(), parts.end(), add);
    std::for_each(this->FixedParts.begin(), this->FixedParts.end(), add);
    if (!NoneIsWithinAnother(all))
    {
      return false;
    }
  }
  for (std::size_t surface = 0; surface < parts.size(); ++surface)
  {
    this->Surfaces[surface]->Replace(std::move(parts[surface].Mesh),
      std::move(parts[surface].Points));
  }
  this->Guard = std::move(refined.Guard);
  return true;
}

// The refinement leaves one that it has checked the refined surface with.
void DeformationLoop::MakeGuard()
{
  if (this->HasGuard() && !this->Guard)
  {
    ContourMesh mesh = this->Mesh;
    AppendMesh(this->Fixed.Mesh, mesh);
    this->Guard = std::make_unique<EmbeddingGuard>(mesh, this->Parallel);
  }
}

bool DeformationLoop::IterateLevel(int level, const Monitor& monitor)
{
  this->Unite();
  this->MakeGuard();
  for (DeformingSurface* surface : this->Surfaces)
  {
    surface->BeginLevel(level);
  }
  const int iterations = this->Surfaces.front()->GetSchedule().MaximumIterations;
  const RememberingMonitor remembering(monitor);
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    const double part = static_cast<double>(iteration) / iterations;
    const Monitor proceed = [&](double)
    { return remembering.Get()((level + part) / this->Levels); };
    if (!proceed(0))
    {
      return false;
    }
    if (this->Guard)
    {
      for (DeformingSurface* surface : this->Surfaces)
      {
        surface->UpdateObstacles();
      }
      std::vector<VertexRange> ranges;
      PointList obstacles = this->UniteObstacles(ranges);
      this->Guard->SetObstacles(std::move(obstacles), std::move(ranges));
    }
    this->IterateOnce(proceed);
    if (remembering.HasStopped())
    {
      return false;
    }
    if (std::all_of(this->Surfaces.begin(), this->Surfaces.end(),
          [](const DeformingSurface* surface) { return surface->HasLevelEnded(); }))
    {
      return true;
    }
  }
  for (DeformingSurface* surface : this->Surfaces)
  {
    if (!surface->HasLevelEnded())
    {
      surface->SetReason(StopReason::IterationLimit);
    }
  }
  return true;
}

void DeformationLoop::IterateOnce(const Monitor& proceed)
{
  PointList points(0, 3);
  PointList motion(0, 3);
  for (DeformingSurface* surface : this->Surfaces)
  {
    AppendPoints(surface->FindMotion(), motion);
    AppendPoints(surface->GetSurface().Points, points);
  }
  GuardReport limited;
  Stopwatch watch;
  double seconds = 0;
  if (this->Guard)
  {
    AppendPoints(PointList::Zero(this->Fixed.Points.rows(), 3), motion);
    AppendPoints(this->Fixed.Points, points);
    limited = this->Guard->Limit(points, motion, this->Parallel, proceed);
    seconds = watch.Lap() / static_cast<double>(this->Surfaces.size());
  }
  else
  {
    limited.Positions = points + motion;
    limited.IsGuarded.assign(points.rows(), 0);
  }
  for (std::size_t surface = 0; surface < this->Surfaces.size(); ++surface)
  {
    if (!this->Surfaces[surface]->HasLevelEnded())
    {
      const VertexRange& part = this->Parts[surface];
      const auto guarded =
        std::count(limited.IsGuarded.begin() + part.Begin, limited.IsGuarded.begin() + part.End, 1);
      this->Surfaces[surface]->Move(this->PartOf(limited.Positions, surface),
        static_cast<int>(guarded), seconds);
    }
  }
}

bool DeformationLoop::FinishConstraints(bool isLast, const Monitor& monitor)
{
  if (std::none_of(this->Surfaces.begin(), this->Surfaces.end(),
        [](const DeformingSurface* surface) { return surface->HasConstraints(); }))
  {
    return true;
  }
  this->Unite();
  this->MakeGuard();
  for (std::size_t pulled = 0; pulled < this->Surfaces.size(); ++pulled)
  {
    const VertexRange& part = this->Parts[pulled];
    const GuardedStep step = [&](const PointList& obstacles, const PointList& from,
                               PointList& motion) -> PointList
    {
      this->Guard->SetObstacles(obstacles, std::vector<VertexRange>(obstacles.rows(), part));
      PointList points(0, 3);
      for (const DeformingSurface* surface : this->Surfaces)
      {
        AppendPoints(surface->GetSurface().Points, points);
      }
      AppendPoints(this->Fixed.Points, points);
      points.middleRows(part.Begin, from.rows()) = from;
      PointList motions = PointList::Zero(points.rows(), 3);
      motions.middleRows(part.Begin, from.rows()) = motion;
      const GuardReport limited = this->Guard->Limit(points, motions, this->Parallel, monitor);
      return this->PartOf(limited.Positions, pulled);
    };
    if (!this->Surfaces[pulled]->FinishConstraints(isLast, step, monitor))
    {
      return false;
    }
  }
  return true;
}

} // namespace FlipFree
