#include "Phantom/ImplicitShape.h"

#include "Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace FlipFree
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

void RequirePositive(double value, const char* what)
{
  if (!(value > 0) || !std::isfinite(value))
  {
    throw Error(ErrorCode::OutOfRange,
      std::string(what) + " must be positive, not " + std::to_string(value));
  }
}

// The minimum of a and b, with the kink between them replaced by a parabola. Its slope never
// exceeds the greater of theirs, and it is at most blend / 4 below the minimum.
double SmoothMinimum(double a, double b, double blend)
{
  const double overlap = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - overlap * overlap / (4 * blend);
}

template <int Axes, typename Vector>
ImplicitShape MakeRoundedBox(const Vector& center, const Vector& halfEdges, double rounding,
  const char* what)
{
  RequirePositive(halfEdges.minCoeff() - rounding, what);
  const Vector core = halfEdges - Vector::Constant(rounding);
  return [=](const Vector3d& point)
  {
    const Vector beyond = (point.head<Axes>() - center).cwiseAbs() - core;
    return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0) - rounding;
  };
}

// Combines the values of the shapes, first to last.
template <typename Combine>
ImplicitShape Fold(std::vector<ImplicitShape> shapes, const Combine& combine)
{
  RequirePositive(static_cast<double>(shapes.size()), "the number of shapes to combine");
  return [shapes = std::move(shapes), combine](const Vector3d& point)
  {
    double value = shapes.front()(point);
    for (std::size_t i = 1; i < shapes.size(); ++i)
    {
      value = combine(value, shapes[i](point));
    }
    return value;
  };
}

// A piece of a tube. The slope of the radius tilts the surface: the difference of distance and
// radius, divided by InverseScale, does not exceed the distance to the surface.
struct TubePiece
{
  Vector3d Start;
  Vector3d Along;
  double InverseSquaredLength;
  double Radius;
  double Taper;
  double InverseScale;

  // Lowers the value to that of this piece. Takes a root only if the value changes.
  void Lower(double& value, const Vector3d& point) const
  {
    const Vector3d offset = point - this->Start;
    const double t = std::clamp(offset.dot(this->Along) * this->InverseSquaredLength, 0.0, 1.0);
    const double radius = this->Radius + t * this->Taper;
    const double squared = (offset - t * this->Along).squaredNorm();
    const double least = value * this->InverseScale + radius;
    if (least > 0 && squared < least * least)
    {
      value = (std::sqrt(squared) - radius) / this->InverseScale;
    }
  }
};

// Consecutive pieces and their bounding ball.
struct TubeRun
{
  std::vector<TubePiece> Pieces;
  Vector3d Center;
  double Reach;
};

TubeRun MakeTubeRun(std::vector<TubePiece> pieces)
{
  TubeRun run;
  run.Pieces = std::move(pieces);
  const TubePiece& last = run.Pieces.back();
  run.Center = 0.5 * (run.Pieces.front().Start + last.Start + last.Along);
  run.Reach = 0;
  for (const TubePiece& piece : run.Pieces)
  {
    const double start = (piece.Start - run.Center).norm() + piece.Radius;
    const double end = (piece.Start + piece.Along - run.Center).norm() + piece.Radius + piece.Taper;
    run.Reach = std::max({ run.Reach, start, end });
  }
  return run;
}

} // namespace

ImplicitShape MakeSphere(const Vector3d& center, double radius)
{
  RequirePositive(radius, "the radius of a sphere");
  return [=](const Vector3d& point) { return (point - center).norm() - radius; };
}

ImplicitShape MakeBox(const Vector3d& center, const Vector3d& halfEdges, double rounding)
{
  return MakeRoundedBox<3>(center, halfEdges, rounding, "the half edge of a box less its rounding");
}

ImplicitShape MakeColumn(const Vector2d& center, const Vector2d& halfEdges, double rounding)
{
  return MakeRoundedBox<2>(center, halfEdges, rounding,
    "the half edge of a column less its rounding");
}

ImplicitShape MakeEllipsoid(const Vector3d& center, const Vector3d& radii,
  const Eigen::Matrix3d& axes)
{
  RequirePositive(radii.minCoeff(), "the radius of an ellipsoid");
  const Eigen::Matrix3d toUnitBall = radii.cwiseInverse().asDiagonal() * axes.transpose();
  const double least = radii.minCoeff();
  return [=](const Vector3d& point)
  { return least * ((toUnitBall * (point - center)).norm() - 1); };
}

ImplicitShape MakeEllipticCylinder(const Vector2d& center, const Vector2d& radii)
{
  RequirePositive(radii.minCoeff(), "the radius of an elliptic cylinder");
  const double least = radii.minCoeff();
  return [=](const Vector3d& point)
  { return least * ((point.head<2>() - center).cwiseQuotient(radii).norm() - 1); };
}

ImplicitShape MakeHalfSpace(const Vector3d& origin, const Vector3d& normal)
{
  return [=](const Vector3d& point) { return normal.dot(point - origin); };
}

ImplicitShape MakeTube(const std::vector<Vector3d>& centerline, const std::vector<double>& radii)
{
  if (centerline.size() < 2 || radii.size() != centerline.size())
  {
    throw Error(ErrorCode::OutOfRange,
      "a tube needs at least two points and one radius for each, not " +
        std::to_string(centerline.size()) + " points and " + std::to_string(radii.size()) +
        " radii");
  }
  const std::size_t maximumPieces = 6;
  std::vector<TubeRun> runs;
  std::vector<TubePiece> pieces;
  for (std::size_t i = 0; i + 1 < centerline.size(); ++i)
  {
    RequirePositive(std::min(radii[i], radii[i + 1]), "the radius of a tube");
    const Vector3d along = centerline[i + 1] - centerline[i];
    RequirePositive(along.norm(), "the distance of consecutive points of a tube");
    const double taper = radii[i + 1] - radii[i];
    const double slope = taper / along.norm();
    pieces.push_back({ centerline[i], along, 1 / along.squaredNorm(), radii[i], taper,
      std::sqrt(1 + slope * slope) });
    if (pieces.size() == maximumPieces || i + 2 == centerline.size())
    {
      runs.push_back(MakeTubeRun(std::move(pieces)));
      pieces.clear();
    }
  }
  return [runs = std::move(runs)](const Vector3d& point)
  {
    double value = std::numeric_limits<double>::infinity();
    for (const TubeRun& run : runs)
    {
      // A run that is farther than the minimum so far cannot lower it.
      const double least = value + run.Reach;
      if (least > 0 && (point - run.Center).squaredNorm() < least * least)
      {
        for (const TubePiece& piece : run.Pieces)
        {
          piece.Lower(value, point);
        }
      }
    }
    return value;
  };
}

ImplicitShape MakeSplineTube(const std::vector<Vector3d>& points, const std::vector<double>& radii)
{
  if (points.size() < 3 || radii.size() != points.size())
  {
    return MakeTube(points, radii);
  }
  const int pieces = 6;
  const int last = static_cast<int>(points.size()) - 1;
  std::vector<Vector3d> centerline{ points.front() };
  std::vector<double> widths{ radii.front() };
  for (int i = 0; i < last; ++i)
  {
    const Vector3d& from = points[i];
    const Vector3d& to = points[i + 1];
    const Vector3d leave = 0.5 * (to - points[std::max(i - 1, 0)]);
    const Vector3d arrive = 0.5 * (points[std::min(i + 2, last)] - from);
    for (int piece = 1; piece <= pieces; ++piece)
    {
      const double t = static_cast<double>(piece) / pieces;
      const double blend = t * t * (3 - 2 * t);
      centerline.emplace_back(
        from + blend * (to - from) + t * (1 - t) * (1 - t) * leave - t * t * (1 - t) * arrive);
      widths.push_back(radii[i] + blend * (radii[i + 1] - radii[i]));
    }
  }
  return MakeTube(centerline, widths);
}

ImplicitShape MakeCup(const Vector3d& center, double radius, double halfWall, double height)
{
  RequirePositive(halfWall, "half the wall of a cup");
  RequirePositive(radius - halfWall, "the radius of a cup less half its wall");
  RequirePositive(height, "the height of a cup");
  return [=](const Vector3d& point)
  {
    // Distance to the wall's middle surface, whose profile is a quarter circle and a straight line.
    const Vector3d p = point - center;
    const double fromAxis = p.head<2>().norm();
    const double fromMiddle = p.z() < 0
      ? std::abs(p.norm() - radius)
      : std::hypot(fromAxis - radius, std::max(p.z() - height, 0.0));
    return fromMiddle - halfWall;
  };
}

ImplicitShape MakeUTube(const Vector3d& center, double bendRadius, double tubeRadius, double leg)
{
  RequirePositive(tubeRadius, "the radius of a U-tube");
  RequirePositive(bendRadius - tubeRadius, "the bend radius of a U-tube less its tube radius");
  RequirePositive(leg, "the leg of a U-tube");
  return [=](const Vector3d& point)
  {
    const Vector3d p = point - center;
    const double inPlane = p.z() < 0
      ? std::hypot(p.x(), p.z()) - bendRadius
      : std::hypot(std::abs(p.x()) - bendRadius, std::max(p.z() - leg, 0.0));
    return std::hypot(inPlane, p.y()) - tubeRadius;
  };
}

ImplicitShape Unite(std::vector<ImplicitShape> shapes)
{
  return Fold(std::move(shapes), [](double a, double b) { return std::min(a, b); });
}

ImplicitShape SmoothUnite(std::vector<ImplicitShape> shapes, double blend)
{
  RequirePositive(blend, "the width of a blend");
  return Fold(std::move(shapes),
    [blend](double a, double b) { return SmoothMinimum(a, b, blend); });
}

ImplicitShape Intersect(std::vector<ImplicitShape> shapes)
{
  return Fold(std::move(shapes), [](double a, double b) { return std::max(a, b); });
}

ImplicitShape SmoothIntersect(std::vector<ImplicitShape> shapes, double blend)
{
  RequirePositive(blend, "the width of a blend");
  return Fold(std::move(shapes),
    [blend](double a, double b) { return -SmoothMinimum(-a, -b, blend); });
}

ImplicitShape Complement(ImplicitShape shape)
{
  return [shape = std::move(shape)](const Vector3d& point) { return -shape(point); };
}

Vector3d ProjectOntoSurface(const ImplicitShape& shape, Vector3d point, double step)
{
  for (int iteration = 0; iteration < 3; ++iteration)
  {
    Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d offset = step * Vector3d::Unit(axis);
      gradient[axis] = (shape(point + offset) - shape(point - offset)) / (2 * step);
    }
    if (gradient.squaredNorm() > 0.25)
    {
      point -= shape(point) / gradient.squaredNorm() * gradient;
    }
  }
  return point;
}

ImplicitShape Grow(ImplicitShape shape, double distance)
{
  return [shape = std::move(shape), distance](const Vector3d& point)
  { return shape(point) - distance; };
}

} // namespace FlipFree
