#include "Guard/EmbeddingGuard.h"

#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Guard/ObstacleTest.h"
#include "Guard/QuadFold.h"
#include "Guard/SeparatingDirection.h"
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

// Whether a vertex of the face has its flag set.
bool AnyOf(const std::vector<char>& flags, const FaceList& faces, int face)
{
  const int* const vertices = faces.Face(face);
  return std::any_of(vertices, vertices + faces.FaceSize(face),
    [&](int vertex) { return flags[vertex] != 0; });
}

template <typename Item, typename Visit>
void ForEach(const std::vector<Item>& items, const ParallelFor& parallelFor, const Visit& visit)
{
  parallelFor(0, static_cast<std::ptrdiff_t>(items.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    { std::for_each(items.begin() + first, items.begin() + last, visit); });
}

// A place near most vertices, even if one lies astray. There is at least one vertex.
Eigen::Vector3d MedianOfThree(const PointList& points)
{
  const Eigen::Vector3d first = points.row(0);
  const Eigen::Vector3d middle = points.row(points.rows() / 2);
  const Eigen::Vector3d last = points.row(points.rows() - 1);
  return first.cwiseMin(middle).cwiseMax(first.cwiseMax(middle).cwiseMin(last));
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

// The test of hulls, with what it keeps between the passes of a step.
class EmbeddingGuard::HullTest
{
public:
  HullTest(const CandidatePairs& candidates, const PointList& points,
    const MinimumDistance& distance)
    : Candidates(candidates)
    , Distance(distance)
    , Rounded(points.rows(), MedianOfThree(points))
  {
  }

  void Run(const FaceList& faces, const std::vector<char>& changed, StepLimiter& step,
    const ParallelFor& parallelFor)
  {
    const Motion motion = step.Path();
    parallelFor(0, motion.From.rows(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
        {
          if (changed[vertex])
          {
            this->Rounded.Update(motion, static_cast<int>(vertex));
          }
        }
      });
    const auto test = [&](const Hull& one, const Hull& two)
    {
      if (HaveSeparatingDirection(this->Rounded, one, two, this->Distance.Wanted))
      {
        return;
      }
      // An impact may no longer matter at all.
      const double latest = step.LatestUsefulTime(one, two);
      const double time = latest > 0 ? TimeOfImpact(motion, one, two, this->Distance, latest) : 1;
      if (!(time >= 1))
      {
        step.Limit(one, time);
        step.Limit(two, time);
      }
    };
    this->Candidates.VisitDisjointHulls(motion, this->Distance.Wanted, changed, this->Boxes, test,
      parallelFor);
    std::vector<char> isFaceChanged(faces.NumberOfFaces());
    for (int face = 0; face < faces.NumberOfFaces(); ++face)
    {
      isFaceChanged[face] = AnyOf(changed, faces, face) ? 1 : 0;
    }
    ForEach(this->Candidates.AdjacentPairs(), parallelFor,
      [&](const HullPair& pair)
      {
        if (isFaceChanged[pair.Faces[0]] || isFaceChanged[pair.Faces[1]])
        {
          test(pair.One, pair.Two);
        }
      });
  }

  void RunObstacles(const PointList& obstacles, const std::vector<VertexRange>& ranges,
    const std::vector<char>& changed, StepLimiter& step, const ParallelFor& parallelFor) const
  {
    if (obstacles.rows() == 0)
    {
      return;
    }
    const Motion motion = step.Path();
    const FaceHulls& hulls = this->Candidates.Hulls();
    parallelFor(0, hulls.NumberOfHulls(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t index = first; index < last; ++index)
        {
          const Hull hull = hulls.HullAt(static_cast<int>(index));
          if (std::none_of(hull.begin(), hull.end(), [&](int v) { return changed[v] != 0; }))
          {
            continue;
          }
          for (Eigen::Index row = 0; row < obstacles.rows(); ++row)
          {
            const Eigen::Vector3d obstacle = obstacles.row(row);
            if (hull[0] < ranges[row].Begin || hull[0] >= ranges[row].End ||
              !MayComeNear(motion, hull, obstacle, this->Distance.Wanted))
            {
              continue;
            }
            const double time = TimeToObstacle(motion, hull, obstacle, this->Distance);
            if (!(time >= 1))
            {
              step.Limit(hull, time);
            }
          }
        }
      });
  }

private:
  const CandidatePairs& Candidates;
  const MinimumDistance Distance;
  SinglePrecisionMotion Rounded;
  std::vector<MotionBox> Boxes;
};

EmbeddingGuard::EmbeddingGuard(const ContourMesh& mesh, const ParallelFor& parallelFor)
  : Faces(mesh.Faces)
  , Neighbors(mesh.Neighbors)
  , Candidates(mesh.NumberOfPoints(), mesh.Faces, parallelFor)
{
  const auto& overlapping = this->Candidates.OverlappingFaces();
  if (!overlapping.empty())
  {
    throw Error(ErrorCode::InvalidMesh,
      "faces " + std::to_string(overlapping[0].first) + " and " +
        std::to_string(overlapping[0].second) + " share more than an edge; use a finer mesh");
  }
}

GuardReport EmbeddingGuard::Limit(const PointList& points, PointList& displacements,
  const ParallelFor& parallelFor, const Monitor& monitor) const
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
  HullTest hulls(this->Candidates, points, distance);
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
      hulls.Run(this->Faces, changedForPairs, step, parallelFor);
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
  this->RequireEmbeddedAtRest(step.Path(), parallelFor);
  report.Positions = step.Path().To;
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
        if (!AnyOf(changed, this->Faces, face))
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
