#include "Deformation/ConstraintEnforcer.h"
#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace FlipFree;

namespace
{

const Eigen::Vector3d Center(10, -20, 30);

PointConstraint At(ConstraintKind kind, double x, double y, double z)
{
  return { kind, Center + Eigen::Vector3d(x, y, z), 0 };
}

// What the surface does not obey, looked at from scratch.
int CountDisobeyed(const ConstraintList& constraints, const ContourMesh& mesh,
  const PointList& points, double spacing)
{
  int count = 0;
  for (const PointConstraint& constraint : constraints)
  {
    const double distance =
      (ClosestPlace(points, mesh.Triangles, constraint.Point).Point - constraint.Point).norm();
    const int winding = WindingNumber(points, mesh.Triangles, constraint.Point);
    const bool obeyed = constraint.Kind == ConstraintKind::Boundary ? distance <= spacing / 2
      : constraint.Kind == ConstraintKind::Outside                  ? winding == 0
                                                                    : winding == 1;
    count += obeyed ? 0 : 1;
  }
  return count;
}

GuardedStep StepBy(EmbeddingGuard& guard, const Monitor& monitor = NeverStop)
{
  return [&guard, monitor](const PointList& obstacles, const PointList& from, PointList& motion)
  {
    guard.SetObstacles(obstacles);
    return guard.Limit(from, motion, SerialFor, monitor).Positions;
  };
}

std::string Enforce(const ConstraintList& constraints, const TestSphere& sphere, PointList& points)
{
  ConstraintEnforcer enforcer(constraints, 1);
  EmbeddingGuard guard(sphere.Mesh);
  try
  {
    enforcer.Begin(sphere.Mesh, guard.Hulls(), points);
    EXPECT_TRUE(enforcer.Finish(sphere.Mesh, guard.Hulls(), StepBy(guard), NeverStop, points));
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.GetCode(), ErrorCode::UnreachablePoint);
    return error.what();
  }
  return "";
}

} // namespace

TEST(ConstraintEnforcer, PullsTheSurfaceToEveryPoint)
{
  const TestSphere sphere(12); // radius 25
  const ConstraintList constraints{ At(ConstraintKind::Inside, 33, 0, 0),
    At(ConstraintKind::Inside, 0, 25.01, 0), At(ConstraintKind::Inside, 0, 24.9, 5),
    At(ConstraintKind::Boundary, 0, 0, 29), At(ConstraintKind::Boundary, 0, 0, -18),
    At(ConstraintKind::Outside, 31, 7, 0), At(ConstraintKind::Outside, 0, 5, 28),
    At(ConstraintKind::Seed, -27, 0, 0) };
  PointList points = sphere.Points();
  EXPECT_GT(CountDisobeyed(constraints, sphere.Mesh, points, 1), 3);
  EXPECT_EQ(Enforce(constraints, sphere, points), "");
  EXPECT_EQ(CountDisobeyed(constraints, sphere.Mesh, points, 1), 0);
  EXPECT_EQ(CountSelfIntersections(points, sphere.Faces()), 0);
}

// The surface has passed points that lie outside.
TEST(ConstraintEnforcer, PullsTheSurfaceBackFromOutsidePoints)
{
  const ConstraintList constraints{ At(ConstraintKind::Outside, 18, 0, 0),
    At(ConstraintKind::Outside, 0, 23, 0), At(ConstraintKind::Inside, 0, 12, 12),
    At(ConstraintKind::Outside, 0, 0, -28) };
  const TestSphere sphere(12); // radius 25
  PointList points = sphere.Points();
  const PointList start =
    ((0.4 * (points.rowwise() - Center.transpose())).rowwise() + Center.transpose());
  EmbeddingGuard guard(sphere.Mesh);
  ConstraintEnforcer enforcer(constraints, 1, OutsidePoints::InTheLastLevel);
  enforcer.Begin(sphere.Mesh, guard.Hulls(), start);
  EXPECT_EQ(enforcer.GetObstacles().rows(), 0);
  enforcer.Update(sphere.Mesh, guard.Hulls(), points);
  EXPECT_EQ(enforcer.GetObstacles().rows(), 1); // the inside point
  EXPECT_EQ(CountDisobeyed(constraints, sphere.Mesh, points, 1), 2);
  EXPECT_TRUE(enforcer.PullBack(sphere.Mesh, guard.Hulls(), StepBy(guard), NeverStop, points));
  EXPECT_EQ(enforcer.GetObstacles().rows(), 4);
  EXPECT_EQ(CountDisobeyed(constraints, sphere.Mesh, points, 1), 0);
  EXPECT_EQ(CountSelfIntersections(points, sphere.Faces()), 0);
}

TEST(ConstraintEnforcer, LeavesAnObedientSurfaceAlone)
{
  const TestSphere sphere(6);
  PointList points = sphere.Points();
  EXPECT_EQ(Enforce({ At(ConstraintKind::Inside, 1, 2, 3), At(ConstraintKind::Outside, 30, 0, 0) },
              sphere, points),
    "");
  EXPECT_EQ(points, sphere.Points());
}

TEST(ConstraintEnforcer, NamesThePointThatCannotBeObeyed)
{
  const TestSphere sphere(8);
  PointList points = sphere.Points();
  EXPECT_EQ(Enforce({ At(ConstraintKind::Outside, 10, 0, 0) }, sphere, points),
    "the outside point (20, -20, 30) mm lies in the start surface or on it; start from a smaller "
    "surface, or move the point");
  EXPECT_THROW(
    ConstraintEnforcer({ At(ConstraintKind::Outside, 10, 0, 0) }, 1, OutsidePoints::InTheLastLevel)
      .Begin(sphere.Mesh, EmbeddingGuard(sphere.Mesh).Hulls(), points),
    Error);
  // A wall of outside points between the surface and the point.
  ConstraintList wall{ At(ConstraintKind::Inside, 40, 0, 0) };
  for (int j = -40; j <= 40; j += 4)
  {
    for (int k = -40; k <= 40; k += 4)
    {
      wall.push_back(At(ConstraintKind::Outside, 27, j, k));
    }
  }
  EXPECT_NE(
    Enforce(wall, sphere, points).find("the inside point (50, -20, 30) mm cannot be obeyed"),
    std::string::npos);
  EXPECT_EQ(CountSelfIntersections(points, sphere.Faces()), 0);
}

// A stroke takes as many steps as one of its points.
TEST(ConstraintEnforcer, PullsTheSurfaceToAStrokeAtOnce)
{
  const TestSphere sphere(12); // radius 25
  ConstraintList stroke;
  for (int point = 0; point < 40; ++point)
  {
    const double angle = 0.03 * point;
    stroke.push_back(At(ConstraintKind::Inside, 31 * std::cos(angle), 31 * std::sin(angle), 1));
  }
  const auto stepsFor = [&](const ConstraintList& constraints)
  {
    PointList points = sphere.Points();
    ConstraintEnforcer enforcer(constraints, 1);
    EmbeddingGuard guard(sphere.Mesh);
    const FaceHulls& hulls = guard.Hulls();
    enforcer.Begin(sphere.Mesh, hulls, points);
    int steps = 0;
    const GuardedStep step = [&, move = StepBy(guard)](const PointList& obstacles,
                               const PointList& from, PointList& motion) -> PointList
    {
      ++steps;
      return move(obstacles, from, motion);
    };
    EXPECT_TRUE(enforcer.Finish(sphere.Mesh, hulls, step, NeverStop, points));
    EXPECT_EQ(CountDisobeyed(constraints, sphere.Mesh, points, 1), 0);
    return steps;
  };
  EXPECT_LE(stepsFor(stroke), 2 * stepsFor({ stroke[20] }));
}

TEST(ConstraintEnforcer, CanBeStopped)
{
  const TestSphere sphere(6);
  PointList points = sphere.Points();
  ConstraintEnforcer enforcer({ At(ConstraintKind::Inside, 60, 0, 0) }, 1);
  EmbeddingGuard guard(sphere.Mesh);
  enforcer.Begin(sphere.Mesh, guard.Hulls(), points);
  int asked = 0;
  const Monitor monitor = [&asked](double) { return ++asked < 2; };
  EXPECT_FALSE(
    enforcer.Finish(sphere.Mesh, guard.Hulls(), StepBy(guard, monitor), monitor, points));
}
