// Tries to break the guard: thousands of adverse motions, of spheres and of what earlier motions
// left of them. Prints, per kind of motion, what is wrong with the surfaces it let through (nothing
// should be), as our own test and CGAL's count it, and exits with an error if anything is.
#include "AdverseMotions.h"
#include "FindWithCGAL.h"
#include "Geometry/SelfIntersection.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/SurfaceRefinement.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <exception>
#include <limits>
#include <stdexcept>

using namespace FlipFree;

namespace
{

struct Tally
{
  int Motions = 0;
  int GuardedMotions = 0;
  std::ptrdiff_t Intersections = 0;
  std::ptrdiff_t IntersectionsOnTheWay = 0;
  std::ptrdiff_t IntersectionsRounded = 0; ///< in single precision
  std::ptrdiff_t IntersectionsByCGAL = 0;  ///< of both
  std::ptrdiff_t FlippedCorners = 0;
  double Kept = 0; ///< mean length of the displacements, part of the wanted one
  double Seconds = 0;

  bool IsClean() const
  {
    return this->Intersections + this->IntersectionsOnTheWay + this->IntersectionsRounded +
      this->IntersectionsByCGAL + this->FlippedCorners ==
      0;
  }
};

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A surface that motions start from.
struct Shape
{
  ContourMesh Mesh;
  PointList Points;
  double EdgeLength;
};

// Spheres, what refinement makes of a crumpled one, and tubes, long and thin.
std::vector<Shape> ShapesOf(int n)
{
  const TestSphere sphere(n);
  std::vector<Shape> shapes{ { sphere.Mesh, sphere.Points(), sphere.EdgeLength } };
  std::mt19937 random(n);
  const TestSphere coarse(n / 2);
  PointList crumpled = coarse.Points();
  EmbeddingGuard guard(coarse.Mesh);
  for (int step = 0; step < 3; ++step)
  {
    PointList motion = WhiteNoise(crumpled.rows(), 0.2 * coarse.EdgeLength, random);
    crumpled = guard.Limit(crumpled, motion, SerialFor, NeverStop).Positions;
  }
  const RefinedSurface refined = RefineSurface(coarse.Mesh, crumpled, true, SerialFor, NeverStop);
  if (refined.Embedded)
  {
    shapes.push_back({ refined.Mesh, refined.Points, coarse.EdgeLength / 2 });
  }
  Shape tube{ sphere.Mesh, sphere.Points(), sphere.EdgeLength / 3 };
  tube.Points.leftCols(2) *= 0.1;
  tube.Points.col(0) += (0.05 * tube.Points.col(2)).array().sin().matrix() * 10;
  shapes.push_back(tube);
  return shapes;
}

// One motion; returns where it ended.
PointList Try(const Shape& shape, EmbeddingGuard& guard, const PointList& points,
  const PointList& wanted, std::mt19937& random, Tally& tally)
{
  const FaceList& faces = shape.Mesh.Faces;
  PointList displacements = wanted;
  const double begin = Now();
  const GuardReport report = guard.Limit(points, displacements, SerialFor, NeverStop);
  tally.Seconds += Now() - begin;
  ++tally.Motions;
  tally.GuardedMotions += report.Guarded > 0 ? 1 : 0;
  tally.Kept += wanted.isZero(0) ? 1 : displacements.norm() / wanted.norm();
  const PointList& after = report.Positions;
  tally.Intersections += CountSelfIntersections(after, faces);
  // As files hold it, where single precision is fine enough.
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> single = after.cast<float>();
  const bool isFineEnough = after.cwiseAbs().maxCoeff() / (1 << 24) < 1e-3 * shape.EdgeLength;
  const PointList rounded = isFineEnough ? PointList(single.cast<double>()) : after;
  tally.IntersectionsRounded += CountSelfIntersections(rounded, faces);
  // One diagonal, the other one, and both in turn.
  for (int cut = 0; cut < 3; ++cut)
  {
    PairList pairs;
    AppendWithCGAL(
      cut < 2 ? rounded : after, faces,
      [cut](int face) { return cut == 2 ? face % 2 == 1 : cut == 1; }, pairs);
    tally.IntersectionsByCGAL += static_cast<std::ptrdiff_t>(pairs.size());
  }
  tally.FlippedCorners += CountFlippedCorners(shape.Mesh, points, after);
  const double time = std::uniform_real_distribution<double>(0.0, 1.0)(random);
  tally.IntersectionsOnTheWay += CountSelfIntersections(points + time * displacements, faces);
  return after;
}

// Targets that are not finite must be refused, whichever they are.
int CountAccepted(const Shape& shape, EmbeddingGuard& guard, int tries, std::mt19937& random)
{
  int accepted = 0;
  for (int i = 0; i < tries; ++i)
  {
    PointList displacements = WhiteNoise(shape.Points.rows(), shape.EdgeLength, random);
    const Eigen::Index entry =
      std::uniform_int_distribution<Eigen::Index>(0, displacements.size() - 1)(random);
    const double bad[] = { std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
    displacements.data()[entry] = bad[i % 3];
    try
    {
      guard.Limit(shape.Points, displacements, SerialFor, NeverStop);
      ++accepted;
    }
    catch (const std::invalid_argument&)
    {
    }
  }
  return accepted;
}

void Print(const char* name, const Tally& tally)
{
  std::printf("| %-30s | %6d | %6d | %.2f | %td | %td | %td | %td | %td | %6.1f |\n", name,
    tally.Motions, tally.GuardedMotions, tally.Kept / tally.Motions, tally.Intersections,
    tally.IntersectionsOnTheWay, tally.IntersectionsRounded, tally.IntersectionsByCGAL,
    tally.FlippedCorners, tally.Seconds);
}

int Fuzz(int chains, int length)
{
  std::vector<Tally> tallies(NumberOfAdverseMotions);
  int refused = 0;
  int accepted = 0;
  std::mt19937 random(2026);
  for (int n : { 4, 8, 16, 32 })
  {
    const std::vector<Shape> shapes = ShapesOf(n);
    std::vector<EmbeddingGuard> guards;
    for (const Shape& shape : shapes)
    {
      guards.emplace_back(shape.Mesh);
    }
    // As many of the small as of the large, by time.
    const int count = std::max(1, chains * 4 / n);
    for (int chain = 0; chain < count; ++chain)
    {
      // Half of them spheres.
      const std::size_t which = chain % 2 == 0 ? 0 : 1 + chain / 2 % (shapes.size() - 1);
      const Shape& shape = shapes[which];
      PointList points = shape.Points;
      for (int step = 0; step < length; ++step)
      {
        const int kind = std::uniform_int_distribution<int>(0, NumberOfAdverseMotions - 1)(random);
        const PointList wanted = AdverseMotion(kind, shape.EdgeLength, points, random);
        points = Try(shape, guards[which], points, wanted, random, tallies[kind]);
      }
    }
    const int tries = 3 * std::max(1, count / 10);
    accepted += CountAccepted(shapes[0], guards[0], tries, random);
    refused += tries;
  }
  std::puts("| motion | motions | guarded | part kept | intersections | "
            "on the way | rounded | by CGAL | flipped corners | guard s |\n"
            "|---|---|---|---|---|---|---|---|---|---|");
  Tally sum;
  for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
  {
    const Tally& tally = tallies[kind];
    Print(AdverseMotionNames[kind], tally);
    sum.Motions += tally.Motions;
    sum.GuardedMotions += tally.GuardedMotions;
    sum.Kept += tally.Kept;
    sum.Intersections += tally.Intersections;
    sum.IntersectionsOnTheWay += tally.IntersectionsOnTheWay;
    sum.IntersectionsRounded += tally.IntersectionsRounded;
    sum.IntersectionsByCGAL += tally.IntersectionsByCGAL;
    sum.FlippedCorners += tally.FlippedCorners;
    sum.Seconds += tally.Seconds;
  }
  Print("all", sum);
  std::printf("targets that are not finite: %d, accepted %d\n", refused, accepted);
  return sum.IsClean() && accepted == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char* argv[])
{
  int chains = 1000;
  int length = 6;
  CLI::App app("Tries to break the guard that keeps surfaces embedded.");
  app.add_option("--chains", chains, "of motions on the coarsest mesh")->capture_default_str();
  app.add_option("--length", length, "motions in a chain")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const double begin = Now();
  try
  {
    const int status = Fuzz(chains, length);
    std::printf("whole run %.0f s\n", Now() - begin);
    return status;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
