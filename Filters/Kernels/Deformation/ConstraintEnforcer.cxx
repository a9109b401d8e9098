#include "Deformation/ConstraintEnforcer.h"

#include "Error.h"
#include "Guard/ObstacleTest.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <set>

namespace FlipFree
{
namespace
{

// An obstacle is at least that far, in voxels, from the hulls of the faces.
constexpr double Clearance = 1e-3;

constexpr int MaximumRounds = 100;
constexpr int RoundsTogether = 20;
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

// Of two motions of each vertex.
void TakeLonger(const PointList& motion, PointList& longer)
{
  for (Eigen::Index vertex = 0; vertex < motion.rows(); ++vertex)
  {
    if (motion.row(vertex).squaredNorm() > longer.row(vertex).squaredNorm())
    {
      longer.row(vertex) = motion.row(vertex);
    }
  }
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
  std::vector<const PointConstraint*> meant;
  for (const PointConstraint& constraint : this->Constraints)
  {
    if (!outsideOnly || constraint.Kind == ConstraintKind::Outside)
    {
      meant.push_back(&constraint);
    }
  }
  // The points of a stroke are pulled together, at the cost of one, as long as that moves anything;
  // where they get into each other's way, one after the other.
  bool together = true;
  std::vector<const PointConstraint*> open;
  for (int round = 0; round < MaximumRounds; ++round)
  {
    open = this->OpenOf(meant, mesh, hulls, points);
    double moved = 0;
    for (std::size_t first = 0; first < open.size(); first += together ? open.size() : 1)
    {
      if (!monitor(static_cast<double>(round) / MaximumRounds))
      {
        return false;
      }
      const std::vector<const PointConstraint*> pulled =
        together ? open : this->OpenOf({ open[first] }, mesh, hulls, points);
      moved = std::max(moved, this->PullTogether(pulled, mesh, step, points));
      this->MakeObstacles(mesh, hulls, points, true);
    }
    if (open.empty())
    {
      return true;
    }
    const bool stalls = moved <= LeastProgress * this->Spacing;
    if (stalls && !together)
    {
      break;
    }
    together = together && !stalls && round < RoundsTogether;
  }
  throw Error(ErrorCode::UnreachablePoint,
    NameOf(*open.back()) +
      " cannot be obeyed: the surface of one piece does not get there past the other points; "
      "move or remove one of them, or give a further seed on the way");
}

std::vector<const PointConstraint*> ConstraintEnforcer::OpenOf(
  const std::vector<const PointConstraint*>& constraints, const ContourMesh& mesh,
  const FaceHulls& hulls, const PointList& points) const
{
  std::vector<const PointConstraint*> open;
  std::copy_if(constraints.begin(), constraints.end(), std::back_inserter(open),
    [&](const PointConstraint* constraint)
    { return this->IsOpen(*constraint, mesh, hulls, points); });
  return open;
}

double ConstraintEnforcer::PullTogether(const std::vector<const PointConstraint*>& constraints,
  const ContourMesh& mesh, const GuardedStep& step, PointList& points) const
{
  std::vector<Eigen::Vector3d> pulls;
  PointList motion = PointList::Zero(points.rows(), 3);
  for (const PointConstraint* constraint : constraints)
  {
    const SurfacePlace place = ClosestPlace(points, mesh.Triangles, constraint->Point);
    pulls.push_back(this->PullOf(*constraint, mesh, points, place));
    const double radius = RadiusOfPull(mesh, points, place, pulls.back().norm());
    TakeLonger(EvenedAt(mesh, points, place, 2 * radius), motion);
  }
  points = step(this->Obstacles, points, motion);
  motion.setZero();
  for (std::size_t index = 0; index < constraints.size(); ++index)
  {
    const SurfacePlace place = ClosestPlace(points, mesh.Triangles, constraints[index]->Point);
    TakeLonger(BulgeAt(mesh, points, place, pulls[index]), motion);
  }
  const PointList before = points;
  points = step(this->Obstacles, points, motion);
  return constraints.empty() ? 0 : (points - before).rowwise().norm().maxCoeff();
}

} // namespace FlipFree
