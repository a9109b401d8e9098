#include "Guard/EmbeddingGuard.h"

#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Guard/HullTest.h"
#include "Guard/QuadFold.h"
#include "Guard/StepLimiter.h"
#include "Mesh/EdgeLength.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace FlipFree
{
namespace
{

// Relative to the typical edge length.
constexpr double WantedPartOfEdge = 1e-3;

// By how much farther a vertex may move at its own scale than at its neighbor's, in typical edge
// lengths: a region whose motion is long is slowed as a whole instead of being sheared where the
// scale changes.
constexpr double RelativeShear = 0.25;

// In millimeters; boxes of motions are kept in single precision.
constexpr double MaximumPosition = 1e30;

// Longer displacements, in units of the surface's extent, are errors of the caller. They are cut
// first, so that the rounding errors of their ends do not spoil the rest.
constexpr double MaximumDisplacement = 100;

// Calls visit(before, vertex, after) for the corners of a face.
template <typename Visit>
void VisitCorners(const int* face, int size, const Visit& visit)
{
  // A triangle has the same normal at all corners. The triangles that a larger face is cut into are
  // corners of it, except the middle ones of a fan.
  visit(face[size - 1], face[0], face[1]);
  for (int corner = 1; corner < size && size > 3; ++corner)
  {
    visit(face[corner - 1], face[corner], face[corner + 1 < size ? corner + 1 : 0]);
  }
  for (int corner = 3; corner < size - 1; ++corner)
  {
    visit(face[0], face[corner - 1], face[corner]);
  }
}

PointList CutToLength(const PointList& displacements, double maximum)
{
  PointList cut = displacements;
  for (Eigen::Index vertex = 0; vertex < cut.rows(); ++vertex)
  {
    const double length = cut.row(vertex).lpNorm<Eigen::Infinity>();
    if (length > maximum)
    {
      cut.row(vertex) *= maximum / length;
    }
  }
  return cut;
}

} // namespace

EmbeddingGuard::EmbeddingGuard(const ContourMesh& mesh, const ParallelFor& parallelFor)
  : Faces(mesh.Faces)
  , Neighbors(mesh.Neighbors)
  , Candidates(mesh.NumberOfPoints(), mesh.Faces, parallelFor)
{
  const auto& overlapping = this->Candidates.OverlappingFaces();
  if (!overlapping.empty())
  {
    throw Error(ErrorCode::InvalidMesh, NameOfOverlap(overlapping[0]) + "; use a finer mesh");
  }
}

GuardReport EmbeddingGuard::Limit(const PointList& points, PointList& displacements,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  this->RequireFinite(points, "position", MaximumPosition);
  this->RequireFinite(displacements, "displacement", std::numeric_limits<double>::max());

  const double maximum =
    MaximumDisplacement * (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  const double edgeLength = TypicalEdgeLength(this->Neighbors, points);
  MinimumDistance distance;
  distance.Resolution = RelativeResolution * (points.cwiseAbs().maxCoeff() + maximum);
  distance.Wanted = std::max(WantedPartOfEdge * edgeLength, 2 * distance.Resolution);

  StepLimiter step(points, CutToLength(displacements, maximum), this->Neighbors,
    RelativeShear * edgeLength, edgeLength);
  HullTest hulls(this->Faces, this->Candidates, points, distance);
  // Vertices whose motion has changed since the test was last run.
  std::vector<char> changedForShapes(points.rows(), 1);
  std::vector<char> changedForPairs(points.rows(), 1);
  GuardReport report;
  while (true)
  {
    ++report.Passes;
    this->TestShapes(changedForShapes, step, parallelFor);
    std::fill(changedForShapes.begin(), changedForShapes.end(), 0);
    if (step.IsClean())
    {
      hulls.Run(changedForPairs, step, parallelFor);
      hulls.RunObstacles(this->Obstacles, this->Ranges, changedForPairs, step, parallelFor);
      std::fill(changedForPairs.begin(), changedForPairs.end(), 0);
    }
    if (step.IsClean())
    {
      break;
    }
    if (!monitor(1 - 1.0 / report.Passes))
    {
      displacements.setZero();
      report.Positions = points;
      report.IsGuarded.assign(points.rows(), 0);
      return report;
    }
    for (int vertex : step.ScaleDown())
    {
      changedForShapes[vertex] = 1;
      changedForPairs[vertex] = 1;
    }
  }

  report.IsGuarded = step.IsScaled();
  report.Guarded =
    static_cast<int>(std::count(report.IsGuarded.begin(), report.IsGuarded.end(), 1));
  // Where its last step ended, the surface is known to be embedded: what moved was proven to be
  // apart until there, and what was at rest had been tested, or proven by the step before.
  if (this->Embedded.rows() != points.rows() || this->Embedded != points)
  {
    this->RequireEmbeddedAtRest(step.Path(), parallelFor);
  }
  report.Positions = step.Path().To;
  this->Embedded = report.Positions;
  displacements = report.Positions - points;
  return report;
}

void EmbeddingGuard::RequireFinite(const PointList& points, const char* what, double maximum) const
{
  if (points.rows() != static_cast<Eigen::Index>(this->Neighbors.size()))
  {
    throw Error(ErrorCode::InvalidMesh,
      "expected " + std::to_string(this->Neighbors.size()) + " " + what +
        "s, one per vertex, but got " + std::to_string(points.rows()));
  }
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    if (!points.row(vertex).allFinite() || points.row(vertex).cwiseAbs().maxCoeff() > maximum)
    {
      throw Error(ErrorCode::NonFiniteValue,
        "the " + std::string(what) + " of vertex " + std::to_string(vertex) +
          " is not finite or too large; check the image and the surface it comes from");
    }
  }
}

// Hulls that move have been proven to be apart at the start. That leaves those at rest.
void EmbeddingGuard::RequireEmbeddedAtRest(const Motion& motion,
  const ParallelFor& parallelFor) const
{
  const PointList& points = motion.From;
  std::vector<char> isAtRest(points.rows());
  for (std::size_t vertex = 0; vertex < isAtRest.size(); ++vertex)
  {
    isAtRest[vertex] = motion.IsAtRest(static_cast<int>(vertex)) ? 1 : 0;
  }
  if (std::count(isAtRest.begin(), isAtRest.end(), 1) == 0)
  {
    return;
  }
  const FaceHulls& hulls = this->Candidates.Hulls();
  if (!MarkedHullsMeet(points, hulls, this->Candidates.AdjacentPairs(), isAtRest, parallelFor))
  {
    return;
  }
  // Not empty: it makes the same exact tests of the same hulls and parts, at all vertices instead
  // of those at rest, so it finds at least what has just been found.
  const auto pairs = FindSelfIntersections(points, hulls, parallelFor);
  const auto textOf = [&](int face)
  {
    std::string text = "(";
    for (int corner = 0; corner < this->Faces.FaceSize(face); ++corner)
    {
      text += (corner > 0 ? ", " : "") + std::to_string(this->Faces.Face(face)[corner]);
    }
    return text + ")";
  };
  const int vertex = this->Faces.Face(pairs.front().first)[0];
  std::ostringstream message;
  message << "the surface intersects itself before it is moved, in " << pairs.size()
          << " pairs of faces; the first are those of the vertices " << textOf(pairs.front().first)
          << " and " << textOf(pairs.front().second) << ", near (" << points(vertex, 0) << ", "
          << points(vertex, 1) << ", " << points(vertex, 2)
          << "); start from a surface without self-intersections";
  throw Error(ErrorCode::SelfIntersecting, message.str());
}

void EmbeddingGuard::TestShapes(const std::vector<char>& changed, StepLimiter& step,
  const ParallelFor& parallelFor) const
{
  const Motion motion = step.Path();
  const auto test = [&](const auto& vertices, const auto& timeOfFailure)
  {
    const double time = timeOfFailure(motion, vertices);
    if (!(time >= 1))
    {
      step.Limit(vertices, time);
    }
  };
  parallelFor(0, this->Faces.NumberOfFaces(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int face = static_cast<int>(first); face < last; ++face)
      {
        const int* const v = this->Faces.Face(face);
        const int size = this->Faces.FaceSize(face);
        if (!HasFlaggedVertex(changed, this->Faces, face))
        {
          continue;
        }
        VisitCorners(v, size,
          [&](int before, int vertex, int after) {
            test(std::array<int, 3>{ { before, vertex, after } }, TimeOfFlip);
          });
        if (size == 4)
        {
          test(Hull{ { v[0], v[1], v[2], v[3] } }, TimeOfFold);
        }
      }
    });
}

} // namespace FlipFree
