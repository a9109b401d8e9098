#include "Geometry/SurfaceGap.h"

#include "Geometry/ClosestDirection.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

double SquaredDistanceOfBoxes(const TriangleBox& one, const TriangleBox& two)
{
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double gap =
      std::max({ 0.0, one.Low[axis] - two.High[axis], two.Low[axis] - one.High[axis] });
    sum += gap * gap;
  }
  return sum;
}

HullCorners CornersOf(const PointList& points, const Hull& hull)
{
  return { { points.row(hull[0]), points.row(hull[1]), points.row(hull[2]), points.row(hull[3]) } };
}

// How far two hulls are apart along the line between their centers: cheaper than the distance, and
// enough for most.
double DistanceAlongCenters(const HullCorners& one, const HullCorners& two)
{
  const Eigen::Vector3d direction =
    (one[0] + one[1] + one[2] + one[3] - two[0] - two[1] - two[2] - two[3]).normalized();
  return DistanceAlong(direction, one, two);
}

bool IsNearer(double gap, const PointList& points, const Hull& one, const Hull& two)
{
  const HullCorners first = CornersOf(points, one);
  const HullCorners second = CornersOf(points, two);
  return !(DistanceAlongCenters(first, second) >= gap || ProvenDistance(first, second) >= gap);
}

HullPair PairOf(const FaceHulls& hulls, int one, int two)
{
  return { hulls.HullAt(one), hulls.HullAt(two), { { hulls.FaceOf(one), hulls.FaceOf(two) } } };
}

} // namespace

double MeasureMinimumGap(const PointList& points, const FaceHulls& hulls,
  const ParallelFor& parallelFor)
{
  const std::vector<TriangleBox> boxes = hulls.RefitBoxes(points);
  // Threads race for the minimum, but there is only one minimum.
  std::atomic<double> least{ std::numeric_limits<double>::infinity() };
  parallelFor(0, hulls.NumberOfHulls(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int hull = static_cast<int>(first); hull < last; ++hull)
      {
        const HullCorners corners = CornersOf(points, hulls.HullAt(hull));
        TriangleBox box;
        for (const Eigen::Vector3d& corner : corners)
        {
          box.Add(corner.data());
        }
        hulls.Tree().Query([&](int node)
          { return !(SquaredDistanceOfBoxes(box, boxes[node]) > least); },
          [&](int other)
          {
            if (other > hull && hulls.AreDisjoint(hull, other))
            {
              const double distance =
                ClosestDirection(corners, CornersOf(points, hulls.HullAt(other))).squaredNorm();
              double present = least;
              while (distance < present && !least.compare_exchange_weak(present, distance))
              {
              }
            }
          });
      }
    });
  return std::sqrt(least);
}

std::vector<HullPair> FindPairsNearerThan(double gap, const PointList& points,
  const FaceHulls& hulls, const std::vector<HullPair>& adjacent, const ParallelFor& parallelFor)
{
  const std::vector<TriangleBox> boxes = hulls.RefitBoxes(points);
  const double square = gap * gap;
  std::vector<HullPair> near;
  for (const auto& pair : hulls.Tree().SelfPairs([&](int node, int other)
         { return SquaredDistanceOfBoxes(boxes[node], boxes[other]) <= square; },
         [&](int one, int two)
         {
           return hulls.AreDisjoint(one, two) &&
             IsNearer(gap, points, hulls.HullAt(one), hulls.HullAt(two));
         },
         parallelFor))
  {
    near.push_back(PairOf(hulls, pair.first, pair.second));
  }
  const std::vector<HullPair> nearAdjacent = Select(
    adjacent, [&](const HullPair& pair) { return IsNearer(gap, points, pair.One, pair.Two); },
    parallelFor);
  near.insert(near.end(), nearAdjacent.begin(), nearAdjacent.end());
  return near;
}

const std::vector<HullPair>& NearPairSearch::Find(const PointList& points,
  const ParallelFor& parallelFor)
{
  std::vector<char> moved(points.rows(), 1);
  for (Eigen::Index vertex = 0; vertex < this->Points.rows(); ++vertex)
  {
    moved[vertex] = points.row(vertex) != this->Points.row(vertex) ? 1 : 0;
  }
  // Where much has moved, the tree's search of all pairs is the faster one, and in many threads.
  if (4 * std::count(moved.begin(), moved.end(), 1) < points.rows())
  {
    this->Renew(points, moved, parallelFor);
  }
  else
  {
    this->Near = FindPairsNearerThan(this->Gap, points, this->Hulls, this->Adjacent, parallelFor);
  }
  this->Points = points;
  return this->Near;
}

void NearPairSearch::Renew(const PointList& points, const std::vector<char>& moved,
  const ParallelFor& parallelFor)
{
  const auto hasMoved = [&](const Hull& hull)
  { return std::any_of(hull.begin(), hull.end(), [&](int vertex) { return moved[vertex] != 0; }); };
  const auto pairHasMoved = [&](const HullPair& pair)
  { return hasMoved(pair.One) || hasMoved(pair.Two); };
  this->Near.erase(std::remove_if(this->Near.begin(), this->Near.end(), pairHasMoved),
    this->Near.end());
  const std::vector<HullPair> adjacent = Select(
    this->Adjacent,
    [&](const HullPair& pair)
    { return pairHasMoved(pair) && IsNearer(this->Gap, points, pair.One, pair.Two); },
    parallelFor);
  this->Near.insert(this->Near.end(), adjacent.begin(), adjacent.end());
  const std::vector<TriangleBox> boxes = this->Hulls.RefitBoxes(points);
  const double square = this->Gap * this->Gap;
  for (int hull = 0; hull < this->Hulls.NumberOfHulls(); ++hull)
  {
    const Hull corners = this->Hulls.HullAt(hull);
    if (!hasMoved(corners))
    {
      continue;
    }
    TriangleBox box;
    for (int vertex : corners)
    {
      box.Add(points.row(vertex).data());
    }
    this->Hulls.Tree().Query([&](int node)
      { return SquaredDistanceOfBoxes(box, boxes[node]) <= square; },
      [&](int other)
      {
        const bool isFoundTwice = other <= hull && hasMoved(this->Hulls.HullAt(other));
        if (!isFoundTwice && this->Hulls.AreDisjoint(hull, other) &&
          IsNearer(this->Gap, points, corners, this->Hulls.HullAt(other)))
        {
          this->Near.push_back(PairOf(this->Hulls, std::min(hull, other), std::max(hull, other)));
        }
      });
  }
}

} // namespace FlipFree
