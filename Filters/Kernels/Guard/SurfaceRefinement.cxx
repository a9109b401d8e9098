#include "Guard/SurfaceRefinement.h"

#include "Geometry/SurfaceGap.h"
#include "Geometry/WindingNumber.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/ObstacleTest.h"
#include "Guard/QuadFold.h"
#include "Guard/SinglePrecision.h"
#include "Mesh/EdgeLength.h"
#include "Mesh/MeshRefinement.h"
#include "Mesh/MeshUnion.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

namespace FlipFree
{
namespace
{

constexpr int MaximumAttempts = 9;
constexpr int MaximumRelaxations = 30;
// Gap the refined surface keeps from itself, relative to the typical edge length of the old one,
// after it has been rounded to single precision.
constexpr double RelativeGap = 1e-4;
// Relative to the typical edge length.
constexpr double MaximumGap = 0.1;
// Of the way of a vertex to the mean of its neighbors.
constexpr double Relaxation = 0.5;

// Smooths the surface at some vertices. The fixed surface's vertices follow its own.
void RelaxOnce(const ContourMesh& mesh, const PointList& fixed, EmbeddingGuard& guard,
  const std::set<int>& vertices, const ParallelFor& parallelFor, const Monitor& monitor,
  PointList& points)
{
  PointList motion = PointList::Zero(points.rows() + fixed.rows(), 3);
  for (int vertex : vertices)
  {
    const auto& ring = mesh.Neighbors[vertex];
    motion.row(vertex) = Relaxation *
      (0.25 *
          (points.row(ring[0]) + points.row(ring[1]) + points.row(ring[2]) + points.row(ring[3])) -
        points.row(vertex));
  }
  PointList all = points;
  AppendPoints(fixed, all);
  points = guard.Limit(all, motion, parallelFor, monitor).Positions.topRows(points.rows());
}

// One guard for both, so that they cannot meet; the fixed vertices come last.
std::unique_ptr<EmbeddingGuard> MakeGuard(const ContourMesh& mesh, const ContourMesh& fixed,
  const ParallelFor& parallelFor)
{
  ContourMesh all = mesh;
  AppendMesh(fixed, all);
  return std::make_unique<EmbeddingGuard>(all, parallelFor);
}

// Those of one of several surfaces: of its triangles, it has all corners or none.
template <typename Predicate>
TriangleList TrianglesWhere(const TriangleList& triangles, const Predicate& isVertexOf)
{
  TriangleList some(triangles.rows(), 3);
  Eigen::Index count = 0;
  for (const auto& triangle : triangles.rowwise())
  {
    if (isVertexOf(triangle[0]))
    {
      some.row(count++) = triangle;
    }
  }
  some.conservativeResize(count, 3);
  return some;
}

struct CoarseSurface
{
  const ContourMesh& Mesh;
  const PointList& Points;
};

struct FineFaces
{
  const RefinedMesh& Refined;
  const TriangleList& Triangles;
  const EmbeddingGuard& Guard;
};

// The refined surface wherever its old vertices are.
class EmbeddedRefinement
{
public:
  EmbeddedRefinement(const CoarseSurface& coarse, const FineFaces& fine,
    const RefinementSurroundings& surroundings, double edgeLength, double gap)
    : Mesh(coarse.Mesh)
    , Parents(fine.Refined.Parents)
    , Triangles(fine.Triangles)
    , Fixed(surroundings.FixedPoints)
    , EdgeLength(edgeLength)
    , Gap(gap)
    , Hulls(fine.Guard.Hulls())
    , NearPairs(gap, fine.Guard.Hulls(), fine.Guard.AdjacentPairs())
    , Quads(ListQuads(fine.Refined.Faces))
    , Obstacles(surroundings.Obstacles)
    , Ranges(surroundings.Ranges)
  {
    this->Ranges.resize(this->Obstacles.rows());
    for (std::size_t obstacle = 0; obstacle < this->Ranges.size(); ++obstacle)
    {
      const VertexRange& range = this->Ranges[obstacle];
      const TriangleList bound =
        TrianglesWhere(coarse.Mesh.Triangles, [&range](int vertex) { return range.Holds(vertex); });
      this->Sides.push_back(WindingNumber(coarse.Points, bound,
        this->Obstacles.row(static_cast<Eigen::Index>(obstacle)).transpose()));
    }
  }

  // Pulls the new points where the surface comes too near to itself toward their parents until
  // there are none. False if some remain; `involved` are then the old vertices near those.
  bool Run(const PointList& points, const ParallelFor& parallelFor, const Monitor& monitor,
    PointList& refined, std::set<int>& involved)
  {
    Eigen::VectorXd reach = Eigen::VectorXd::Ones(points.rows());
    for (int attempt = 0; attempt < MaximumAttempts; ++attempt)
    {
      if (!monitor(0))
      {
        return false;
      }
      refined = RefinePoints(this->Mesh, points, reach);
      for (auto position : refined.rowwise())
      {
        position = RoundToSingle(position, this->EdgeLength);
      }
      const std::vector<Hull> bad = this->FindBadHulls(refined, parallelFor);
      if (bad.empty())
      {
        return true;
      }
      involved.clear();
      for (const Hull& hull : bad)
      {
        for (int vertex : hull)
        {
          if (!this->IsRefined(vertex))
          {
            continue;
          }
          const int parent = this->Parents[vertex];
          involved.insert(parent);
          involved.insert(this->Mesh.Neighbors[parent].begin(), this->Mesh.Neighbors[parent].end());
        }
      }
      for (int vertex : involved)
      {
        reach[vertex] *= 0.5;
      }
    }
    return false;
  }

private:
  // Whether the vertex is not one of the fixed surface, which follow.
  bool IsRefined(int vertex) const { return vertex < static_cast<int>(this->Parents.size()); }

  // Whether an obstacle of that range has a say over the vertex.
  bool IsBound(int vertex, const VertexRange& range) const
  {
    return this->IsRefined(vertex) && range.Holds(this->Parents[vertex]);
  }

  PointList WithFixed(PointList points) const
  {
    AppendPoints(this->Fixed, points);
    return points;
  }

  // What comes too near to other parts or to obstacles, or has passed one, and folded quads.
  std::vector<Hull> FindBadHulls(const PointList& refined, const ParallelFor& parallelFor)
  {
    std::vector<Hull> bad;
    const PointList all = this->WithFixed(refined);
    for (const HullPair& pair : this->NearPairs.Find(all, parallelFor))
    {
      if (!this->IsRefined(pair.One[0]) && !this->IsRefined(pair.Two[0]))
      {
        continue; // as it is
      }
      bad.push_back(pair.One);
      bad.push_back(pair.Two);
    }
    std::copy_if(this->Quads.begin(), this->Quads.end(), std::back_inserter(bad),
      [&](const Hull& quad) { return IsFolded(refined, quad); });
    for (std::size_t obstacle = 0; obstacle < this->Sides.size(); ++obstacle)
    {
      const Eigen::Vector3d point = this->Obstacles.row(static_cast<Eigen::Index>(obstacle));
      const auto isBound = [&](int vertex)
      { return this->IsBound(vertex, this->Ranges[obstacle]); };
      for (const Hull& hull : HullsNearerThan(this->Gap, all, this->Hulls, point))
      {
        if (isBound(hull[0]))
        {
          bad.push_back(hull);
        }
      }
      const TriangleList bound = TrianglesWhere(this->Triangles, isBound);
      if (WindingNumber(refined, bound, point) != this->Sides[obstacle])
      {
        const auto passed = bound.row(ClosestPlace(refined, bound, point).Triangle);
        bad.push_back({ { passed[0], passed[1], passed[2], passed[2] } });
      }
    }
    return bad;
  }

  const ContourMesh& Mesh;
  const std::vector<int>& Parents;
  const TriangleList& Triangles;
  const PointList& Fixed;
  const double EdgeLength;
  const double Gap;
  const FaceHulls& Hulls;
  NearPairSearch NearPairs;
  const std::vector<Hull> Quads;
  const PointList& Obstacles;
  std::vector<VertexRange> Ranges; // of the obstacles
  std::vector<int> Sides;          // where these lie of the surfaces that they bind
};

void AddRings(const ContourMesh& mesh, int rings, std::set<int>& vertices)
{
  std::vector<int> rim(vertices.begin(), vertices.end());
  for (int ring = 0; ring < rings; ++ring)
  {
    std::vector<int> next;
    for (int vertex : rim)
    {
      for (int neighbor : mesh.Neighbors[vertex])
      {
        if (vertices.insert(neighbor).second)
        {
          next.push_back(neighbor);
        }
      }
    }
    rim.swap(next);
  }
}

} // namespace

RefinedSurface RefineSurface(const ContourMesh& mesh, const PointList& points,
  const RefinementSurroundings& surroundings, bool checked, const ParallelFor& parallelFor,
  const Monitor& monitor)
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
  const double edgeLength = TypicalEdgeLength(mesh.Neighbors, points);
  const double gap =
    std::max(RelativeGap * edgeLength, RelativeResolution * points.cwiseAbs().maxCoeff());
  if (gap > MaximumGap * edgeLength)
  {
    return refined; // rounding errors are as large as the surface's features
  }
  refined.Guard = MakeGuard(refined.Mesh, surroundings.FixedMesh, parallelFor);
  EmbeddedRefinement refinement({ mesh, points }, { faces, refined.Mesh.Triangles, *refined.Guard },
    surroundings, edgeLength, gap);
  std::unique_ptr<EmbeddingGuard> guard; // of the coarse surface, which seldom needs to move
  PointList coarse = points;
  std::set<int> involved;
  // Asked at each attempt, of which some are made before and after each relaxation.
  const Monitor proceed = [&](double)
  { return monitor(static_cast<double>(refined.Relaxations) / MaximumRelaxations); };
  while (!refinement.Run(coarse, parallelFor, proceed, refined.Points, involved))
  {
    if (refined.Relaxations == MaximumRelaxations || !proceed(0))
    {
      return refined;
    }
    if (!guard)
    {
      guard = MakeGuard(mesh, surroundings.FixedMesh, parallelFor);
      guard->SetObstacles(surroundings.Obstacles, surroundings.Ranges);
    }
    AddRings(mesh, refined.Relaxations, involved);
    RelaxOnce(mesh, surroundings.FixedPoints, *guard, involved, parallelFor, monitor, coarse);
    ++refined.Relaxations;
  }
  refined.Embedded = true;
  return refined;
}

} // namespace FlipFree
