#include "Deformation/ConstraintEnforcer.h"

#include "Error.h"
#include "Guard/ObstacleTest.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>

namespace FlipFree
{
namespace
{

// An obstacle is at least that far, in voxels, from the hulls of the faces.
constexpr double Clearance = 1e-3;

constexpr int MaximumRounds = 100;
// A round that moves the surface by less, in voxels, is the last one.
constexpr double LeastProgress = 1e-3;

// A pull moves the surface within twice its length, but not within more millimeters than this, and
// at least within this many edges, so that the bulge is no steeper than the mesh can show.
constexpr double LengthsPerPull = 2;
constexpr double WidestPull = 20;
constexpr double EdgesPerPull = 3;

double LongestEdge(const PointList& points, const Eigen::RowVector3i& triangle)
{
  double longest = 0;
  for (int corner = 0; corner < 3; ++corner)
  {
    longest = std::max(longest,
      (points.row(triangle[corner]) - points.row(triangle[(corner + 1) % 3])).norm());
  }
  return longest;
}

// The vertices within a radius of a place that are connected to it within that radius.
std::vector<int> VerticesAround(const ContourMesh& mesh, const PointList& points,
  const SurfacePlace& place, double radius)
{
  const Eigen::RowVector3i triangle = mesh.Triangles.row(place.Triangle);
  std::set<int> visited(triangle.data(), triangle.data() + 3);
  std::vector<int> front(visited.begin(), visited.end());
  std::vector<int> near;
  while (!front.empty())
  {
    const int vertex = front.back();
    front.pop_back();
    if ((points.row(vertex).transpose() - place.Point).norm() >= radius)
    {
      continue;
    }
    near.push_back(vertex);
    for (const int neighbor : mesh.Neighbors[vertex])
    {
      if (visited.insert(neighbor).second)
      {
        front.push_back(neighbor);
      }
    }
  }
  return near;
}

double RadiusOfPull(const ContourMesh& mesh, const PointList& points, const SurfacePlace& place,
  double length)
{
  return std::max(std::min(LengthsPerPull * length, WidestPull),
    EdgesPerPull * LongestEdge(points, mesh.Triangles.row(place.Triangle)));
}

// Displaces the surroundings of a place, most of all the place.
PointList BulgeAt(const ContourMesh& mesh, const PointList& points, const SurfacePlace& place,
  Eigen::Vector3d displacement)
{
  const double radius = RadiusOfPull(mesh, points, place, displacement.norm());
  displacement *= std::min(1.0, radius / (LengthsPerPull * displacement.norm()));
  PointList motion = PointList::Zero(points.rows(), 3);
  for (const int vertex : VerticesAround(mesh, points, place, radius))
  {
    const double away = (points.row(vertex).transpose() - place.Point).norm() / radius;
    motion.row(vertex) = (1 - away * away) * (1 - away * away) * displacement.transpose();
  }
  return motion;
}

// Evens out the vertices around a place within the surface: where it has been pulled far, they are
// few, and hold each other back.
PointList EvenedAt(const ContourMesh& mesh, const PointList& points, const SurfacePlace& place,
  double radius)
{
  PointList motion = PointList::Zero(points.rows(), 3);
  for (const int vertex : VerticesAround(mesh, points, place, radius))
  {
    const auto& ring = mesh.Neighbors[vertex];
    const Eigen::RowVector3d along = points.row(ring[2]) - points.row(ring[0]);
    const Eigen::RowVector3d across = points.row(ring[3]) - points.row(ring[1]);
    const Eigen::RowVector3d normal = along.cross(across).normalized();
    const Eigen::RowVector3d mean = 0.25 *
      (points.row(ring[0]) + points.row(ring[1]) + points.row(ring[2]) + points.row(ring[3]));
    const Eigen::RowVector3d toMean = mean - points.row(vertex);
    motion.row(vertex) = 0.5 * (toMean - toMean.dot(normal) * normal);
  }
  return motion;
}

} // namespace

ConstraintEnforcer::ConstraintEnforcer(const ConstraintList& constraints, double spacing,
  OutsidePoints outside)
  : Constraints(SortedConstraints(constraints))
  , IsObstacle(this->Constraints.size(), false)
  , Spacing(spacing)
  , MayPassOutside(outside != OutsidePoints::FromTheStart)
  , MayBeginAround(outside == OutsidePoints::AroundThem)
{
}

void ConstraintEnforcer::Begin(const ContourMesh& mesh, const FaceHulls& hulls,
  const PointList& points)
{
  std::fill(this->IsObstacle.begin(), this->IsObstacle.end(), false);
  this->Obstacles.resize(0, 3);
  this->Update(mesh, hulls, points);
  for (std::size_t index = 0; index < this->Constraints.size(); ++index)
  {
    const PointConstraint& constraint = this->Constraints[index];
    if (constraint.Kind == ConstraintKind::Outside && !this->IsObstacle[index] &&
      !this->MayBeginAround && this->IsOpen(constraint, mesh, hulls, points))
    {
      throw Error(ErrorCode::UnreachablePoint,
        NameOf(constraint) +
          " lies in the start surface or on it; start from a smaller surface, or move the point");
    }
  }
}

bool ConstraintEnforcer::IsOpen(const PointConstraint& constraint, const ContourMesh& mesh,
  const FaceHulls& hulls, const PointList& points) const
{
  if (constraint.Kind == ConstraintKind::Boundary)
  {
    const SurfacePlace place = ClosestPlace(points, mesh.Triangles, constraint.Point);
    return (place.Point - constraint.Point).norm() > this->Spacing / 2;
  }
  const int winding = constraint.Kind == ConstraintKind::Outside ? 0 : 1;
  return WindingNumber(points, mesh.Triangles, constraint.Point) != winding ||
    !HullsNearerThan(Clearance * this->Spacing, points, hulls, constraint.Point).empty();
}

void ConstraintEnforcer::Update(const ContourMesh& mesh, const FaceHulls& hulls,
  const PointList& points)
{
  this->MakeObstacles(mesh, hulls, points, !this->MayPassOutside);
}

void ConstraintEnforcer::MakeObstacles(const ContourMesh& mesh, const FaceHulls& hulls,
  const PointList& points, bool withOutside)
{
  for (std::size_t index = 0; index < this->Constraints.size(); ++index)
  {
    const PointConstraint& constraint = this->Constraints[index];
    const bool isWanted = constraint.Kind != ConstraintKind::Boundary &&
      (withOutside || constraint.Kind != ConstraintKind::Outside);
    if (isWanted && !this->IsObstacle[index] && !this->IsOpen(constraint, mesh, hulls, points))
    {
      this->IsObstacle[index] = true;
      this->Obstacles.conservativeResize(this->Obstacles.rows() + 1, 3);
      this->Obstacles.bottomRows(1) = constraint.Point.transpose();
    }
  }
}

Eigen::Vector3d ConstraintEnforcer::PullOf(const PointConstraint& constraint,
  const ContourMesh& mesh, const PointList& points, const SurfacePlace& place) const
{
  Eigen::Vector3d toPoint = constraint.Point - place.Point;
  if (constraint.Kind == ConstraintKind::Boundary)
  {
    return toPoint;
  }
  const bool isEnclosed = WindingNumber(points, mesh.Triangles, constraint.Point) == 1;
  if (constraint.Kind == ConstraintKind::Outside && isEnclosed &&
    toPoint.norm() > Clearance * this->Spacing)
  {
    return toPoint + this->Spacing / 2 * toPoint.normalized();
  }
  // Beyond a point that is to lie inside, outward.
  const bool isBeyond = isEnclosed;
  Eigen::Vector3d outward = isBeyond ? -toPoint : toPoint;
  if (!(outward.norm() > Clearance * this->Spacing))
  {
    const auto corner = [&](int index) -> Eigen::Vector3d
    { return points.row(mesh.Triangles(place.Triangle, index)).transpose(); };
    outward = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  }
  const Eigen::Vector3d further = this->Spacing / 2 * outward.normalized();
  return isBeyond ? further : Eigen::Vector3d(toPoint + further);
}

bool ConstraintEnforcer::Finish(const ContourMesh& mesh, EmbeddingGuard& guard,
  const ParallelFor& parallelFor, const Monitor& monitor, PointList& points)
{
  const GuardedStep step = [&](const PointList& obstacles, const PointList& from,
                             PointList& motion) -> PointList
  {
    guard.SetObstacles(obstacles);
    return guard.Limit(from, motion, parallelFor, monitor).Positions;
  };
  return this->Finish(mesh, guard.Hulls(), step, monitor, points);
}

bool ConstraintEnforcer::PullBack(const ContourMesh& mesh, const FaceHulls& hulls,
  const GuardedStep& step, const Monitor& monitor, PointList& points)
{
  return !this->MayPassOutside || this->Pull(true, mesh, hulls, step, monitor, points);
}

bool ConstraintEnforcer::Finish(const ContourMesh& mesh, const FaceHulls& hulls,
  const GuardedStep& step, const Monitor& monitor, PointList& points)
{
  return this->Pull(false, mesh, hulls, step, monitor, points);
}

bool ConstraintEnforcer::Pull(bool outsideOnly, const ContourMesh& mesh, const FaceHulls& hulls,
  const GuardedStep& step, const Monitor& monitor, PointList& points)
{
  this->MayPassOutside = false;
  this->MakeObstacles(mesh, hulls, points, true);
  const PointConstraint* open = nullptr;
  double moved = this->Spacing;
  for (int round = 0; round < MaximumRounds && moved > LeastProgress * this->Spacing; ++round)
  {
    open = nullptr;
    moved = 0;
    for (const PointConstraint& constraint : this->Constraints)
    {
      if (!monitor(static_cast<double>(round) / MaximumRounds))
      {
        return false;
      }
      const bool isMeant = !outsideOnly || constraint.Kind == ConstraintKind::Outside;
      if (!isMeant || !this->IsOpen(constraint, mesh, hulls, points))
      {
        continue;
      }
      open = &constraint;
      const SurfacePlace place = ClosestPlace(points, mesh.Triangles, constraint.Point);
      const Eigen::Vector3d pull = this->PullOf(constraint, mesh, points, place);
      PointList evened =
        EvenedAt(mesh, points, place, 2 * RadiusOfPull(mesh, points, place, pull.norm()));
      points = step(this->Obstacles, points, evened);
      PointList motion =
        BulgeAt(mesh, points, ClosestPlace(points, mesh.Triangles, constraint.Point), pull);
      const PointList before = points;
      points = step(this->Obstacles, points, motion);
      moved = std::max(moved, (points - before).rowwise().norm().maxCoeff());
      this->MakeObstacles(mesh, hulls, points, true);
    }
    if (!open)
    {
      return true;
    }
  }
  if (open)
  {
    throw Error(ErrorCode::UnreachablePoint,
      NameOf(*open) +
        " cannot be obeyed: the surface of one piece does not get there past the other points; "
        "move or remove one of them, or give a further seed on the way");
  }
  return true;
}

} // namespace FlipFree
