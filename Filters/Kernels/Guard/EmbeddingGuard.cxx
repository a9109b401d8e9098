#include "Guard/EmbeddingGuard.h"

#include "Error.h"
#include "Geometry/HullIntersection.h"
#include "Geometry/SelfIntersection.h"
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
constexpr double RelativeGap = 1e-3;

// By how much farther a vertex may move at its own scale than at its neighbor's, in typical edge
// lengths: a region whose motion is long is slowed as a whole instead of being sheared where the
// scale changes.
constexpr double RelativeShear = 0.25;

// Relative to the maximum coordinate: well above the rounding errors of positions and distances.
constexpr double RelativeResolution = 1e-12;

// In millimeters; boxes of motions are kept in single precision.
constexpr double MaximumPosition = 1e30;

// Longer displacements, in units of the surface's extent, are errors of the caller. They are cut
// first, so that the rounding errors of their ends do not spoil the rest.
constexpr double MaximumDisplacement = 100;

std::vector<std::array<int, 3>> ListCorners(const FaceList& faces)
{
  std::vector<std::array<int, 3>> corners;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const vertices = faces.Face(face);
    const int size = faces.FaceSize(face);
    // A triangle has the same normal at all corners. The triangles that a larger face is cut into
    // are corners of it, except the middle ones of a fan.
    for (int corner = 0; corner < (size == 3 ? 1 : size); ++corner)
    {
      corners.push_back({ { vertices[(corner + size - 1) % size], vertices[corner],
        vertices[(corner + 1) % size] } });
    }
    for (int corner = 3; corner < size - 1; ++corner)
    {
      corners.push_back({ { vertices[0], vertices[corner - 1], vertices[corner] } });
    }
  }
  return corners;
}

template <std::size_t N>
bool AnyOf(const std::vector<char>& flags, const std::array<int, N>& vertices)
{
  return std::any_of(vertices.begin(), vertices.end(),
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

  void Run(const std::vector<char>& changed, StepLimiter& step, const ParallelFor& parallelFor)
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
      if (!HaveSeparatingDirection(this->Rounded, one, two, this->Distance.Wanted))
      {
        const double time =
          TimeOfImpact(motion, one, two, this->Distance, step.LatestUsefulTime(one, two));
        if (!(time >= 1))
        {
          step.Limit(one, time);
          step.Limit(two, time);
        }
      }
    };
    this->Candidates.VisitDisjointHulls(motion, this->Distance.Wanted, changed, this->Boxes, test,
      parallelFor);
    ForEach(this->Candidates.AdjacentPairs(), parallelFor,
      [&](const HullPair& pair)
      {
        if (AnyOf(changed, pair.One) || AnyOf(changed, pair.Two))
        {
          test(pair.One, pair.Two);
        }
      });
  }

private:
  const CandidatePairs& Candidates;
  const MinimumDistance Distance;
  SinglePrecisionMotion Rounded;
  std::vector<MotionBox> Boxes;
};

EmbeddingGuard::EmbeddingGuard(const ContourMesh& mesh)
  : Faces(mesh.Faces)
  , Neighbors(mesh.Neighbors)
  , Corners(ListCorners(mesh.Faces))
  , Quads(ListQuads(mesh.Faces))
  , Candidates(mesh.NumberOfPoints(), mesh.Faces)
{
  const auto overlapping = this->Candidates.Hulls().OverlappingFaces();
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
  distance.Wanted = std::max(RelativeGap * edgeLength, 2 * distance.Resolution);

  StepLimiter step(points, CutToLength(displacements, maximum), this->Neighbors,
    RelativeShear * edgeLength, edgeLength);
  HullTest hulls(this->Candidates, points, distance);
  // Vertices whose motion has changed since the test was last run.
  std::vector<char> changedForShapes(points.rows(), 1);
  std::vector<char> changedForPairs(points.rows(), 1);
  bool arePairsUntested = true;
  GuardReport report;
  while (true)
  {
    ++report.Passes;
    this->TestShapes(changedForShapes, step, parallelFor);
    std::fill(changedForShapes.begin(), changedForShapes.end(), 0);
    if (step.IsClean())
    {
      if (arePairsUntested)
      {
        step.SuspectHeldVertices();
        arePairsUntested = false;
      }
      hulls.Run(changedForPairs, step, parallelFor);
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
      return report;
    }
    for (int vertex : step.ScaleDown())
    {
      changedForShapes[vertex] = 1;
      changedForPairs[vertex] = 1;
    }
  }

  report.Guarded = step.NumberOfScaled();
  // Parts that intersect at the start fail whenever they are tested, unless corners have already
  // brought them to rest.
  this->RequireEmbeddedAt(points, step.Suspects(), parallelFor);
  report.Positions = step.Path().To;
  displacements = report.Positions - points;
  return report;
}

void EmbeddingGuard::RequireEmbedded(const PointList& points, const ParallelFor& parallelFor) const
{
  this->RequireFinite(points, "position", MaximumPosition);
  this->RequireEmbeddedAt(points, std::vector<char>(points.rows(), 1), parallelFor);
}

void EmbeddingGuard::RequireFinite(const PointList& points, const char* what, double maximum) const
{
  if (points.rows() != static_cast<Eigen::Index>(this->Neighbors.size()))
  {
    throw Error(ErrorCode::InvalidMesh,
      "the guard was made for a mesh of " + std::to_string(this->Neighbors.size()) +
        " vertices, but there is one " + what + " for each of " + std::to_string(points.rows()));
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

// Whether hulls meet that have one of the marked vertices.
bool EmbeddingGuard::AnyMeet(const PointList& points, const std::vector<char>& vertices,
  const ParallelFor& parallelFor) const
{
  const FaceHulls& hulls = this->Candidates.Hulls();
  const auto meet = [&](const Hull& one, const Hull& two)
  { return (AnyOf(vertices, one) || AnyOf(vertices, two)) && HullsMeet(points, one, two); };
  const std::vector<TriangleBox> boxes = hulls.RefitBoxes(points);
  const auto disjoint =
    hulls.Tree().SelfPairs([&](int node, int other) { return boxes[node].Touches(boxes[other]); },
      [&](int one, int two)
      { return hulls.AreDisjoint(one, two) && meet(hulls.HullAt(one), hulls.HullAt(two)); },
      parallelFor);
  return !disjoint.empty() ||
    !Select(
      this->Candidates.AdjacentPairs(),
      [&](const HullPair& pair) { return meet(pair.One, pair.Two); }, parallelFor)
       .empty();
}

// Throws if faces intersect that have one of the marked vertices.
void EmbeddingGuard::RequireEmbeddedAt(const PointList& points, const std::vector<char>& vertices,
  const ParallelFor& parallelFor) const
{
  if (std::count(vertices.begin(), vertices.end(), 0) == points.rows() ||
    !this->AnyMeet(points, vertices, parallelFor))
  {
    return;
  }
  const auto isMarked = [&](int face)
  {
    return std::any_of(this->Faces.Face(face), this->Faces.Face(face) + this->Faces.FaceSize(face),
      [&](int vertex) { return vertices[vertex] != 0; });
  };
  auto pairs = FindSelfIntersections(points, this->Candidates.Hulls(), parallelFor);
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                [&](const auto& pair) { return !isMarked(pair.first) && !isMarked(pair.second); }),
    pairs.end());
  if (pairs.empty())
  {
    return;
  }
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
    if (AnyOf(changed, vertices))
    {
      const double time = timeOfFailure(motion, vertices);
      if (!(time >= 1))
      {
        step.Limit(vertices, time);
      }
    }
  };
  ForEach(this->Corners, parallelFor, [&](const Corner& corner) { test(corner, TimeOfFlip); });
  ForEach(this->Quads, parallelFor, [&](const Hull& quad) { test(quad, TimeOfFold); });
}

} // namespace FlipFree
