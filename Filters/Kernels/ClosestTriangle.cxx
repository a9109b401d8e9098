#include "ClosestTriangle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr int Width = 4;

// Boxes are kept in single precision, a little wider than they are, and only those that are farther
// beyond doubt are skipped, so that the result does not depend on the order of the search.
constexpr float Rounding = 1e-6F;
constexpr float Slack = 1 + 1e-5F;

double InverseOrZero(double value)
{
  return value > 0 ? 1 / value : 0;
}

// Of `from`, a point minus the side's beginning.
double SquaredDistanceToSide(const Eigen::Vector3d& from, const Eigen::Vector3d& side,
  double inverseSquaredLength)
{
  const double t = std::clamp(side.dot(from) * inverseSquaredLength, 0.0, 1.0);
  return (from - t * side).squaredNorm();
}

// Sorts the range so that every whole run of `capacity` elements lies together in space, and within
// it every whole run of a fourth of that. Halves along the longest extent.
void Arrange(const PointList& centers, int capacity, int* first, int* last)
{
  const auto size = static_cast<int>(last - first);
  while (capacity >= size && capacity > Width)
  {
    capacity /= Width;
  }
  const int runs = (size + capacity - 1) / capacity;
  if (runs < 2)
  {
    return;
  }
  Eigen::RowVector3d low = centers.row(*first);
  Eigen::RowVector3d high = low;
  for (const int* element = first; element != last; ++element)
  {
    low = low.cwiseMin(centers.row(*element));
    high = high.cwiseMax(centers.row(*element));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  int* const middle = first + runs / 2 * capacity;
  std::nth_element(first, middle, last,
    [&](int one, int other)
    { return std::pair(centers(one, axis), one) < std::pair(centers(other, axis), other); });
  Arrange(centers, capacity, first, middle);
  Arrange(centers, capacity, middle, last);
}

} // namespace

TriangleForDistance::TriangleForDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  const Eigen::Vector3d& c)
  : A(a)
  , AB(b - a)
  , AC(c - a)
  , Normal(AB.cross(AC))
  , TowardB(AC.cross(Normal))
  , TowardC(Normal.cross(AB))
  , SquaredArea(Normal.squaredNorm())
  , InverseSquaredAB(InverseOrZero(AB.squaredNorm()))
  , InverseSquaredAC(InverseOrZero(AC.squaredNorm()))
  , InverseSquaredBC(InverseOrZero((AC - AB).squaredNorm()))
{
  // The normal of a needle has no reliable direction; its sides are as good as its inside.
  if (!(this->SquaredArea > 1e-20 * this->AB.squaredNorm() * this->AC.squaredNorm()))
  {
    this->SquaredArea = 0;
  }
}

double TriangleForDistance::SquaredDistance(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d from = point - this->A;
  const double weightOfB = this->TowardB.dot(from);
  const double weightOfC = this->TowardC.dot(from);
  const double weightOfA = this->SquaredArea - weightOfB - weightOfC;
  const bool isNeedle = this->SquaredArea == 0;
  if (!isNeedle && weightOfA >= 0 && weightOfB >= 0 && weightOfC >= 0)
  {
    const double height = this->Normal.dot(from);
    return height * height / this->SquaredArea;
  }
  // The closest point of a convex shape lies on a side that the point is beyond.
  double least = std::numeric_limits<double>::infinity();
  if (isNeedle || weightOfA < 0)
  {
    least = SquaredDistanceToSide(from - this->AB, this->AC - this->AB, this->InverseSquaredBC);
  }
  if (isNeedle || weightOfB < 0)
  {
    least = std::min(least, SquaredDistanceToSide(from, this->AC, this->InverseSquaredAC));
  }
  if (isNeedle || weightOfC < 0)
  {
    least = std::min(least, SquaredDistanceToSide(from, this->AB, this->InverseSquaredAB));
  }
  return least;
}

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return TriangleForDistance(a, b, c).SquaredDistance(point);
}

ClosestTriangleFinder::ClosestTriangleFinder(const PointList& points, const TriangleList& triangles)
  : Order(triangles.rows())
{
  PointList centers(triangles.rows(), 3);
  this->Shapes.reserve(triangles.rows());
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const Eigen::Vector3d a = points.row(triangles(triangle, 0));
    const Eigen::Vector3d b = points.row(triangles(triangle, 1));
    const Eigen::Vector3d c = points.row(triangles(triangle, 2));
    centers.row(triangle) = (a + b + c) / 3;
    this->Shapes.emplace_back(a, b, c);
  }
  int capacity = Width;
  while (capacity < triangles.rows())
  {
    capacity *= Width;
  }
  std::iota(this->Order.begin(), this->Order.end(), 0);
  Arrange(centers, capacity, this->Order.data(), this->Order.data() + this->Order.size());
  this->Middle = 0.5 * (centers.colwise().minCoeff() + centers.colwise().maxCoeff());
  this->MakeLeaves(points, triangles);
  this->MakeNodesAbove();
}

void ClosestTriangleFinder::MakeLeaves(const PointList& points, const TriangleList& triangles)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Node empty;
  empty.Low.fill(Eigen::Array4f::Constant(infinity));
  empty.High.fill(Eigen::Array4f::Constant(-infinity));
  this->Nodes.assign((this->Order.size() + Width - 1) / Width, empty);
  this->Levels = { 0 };
  double extent = 0;
  for (Eigen::Index corner = 0; corner < triangles.size(); ++corner)
  {
    extent = std::max(extent,
      (points.row(triangles.data()[corner]).transpose() - this->Middle).cwiseAbs().maxCoeff());
  }
  const auto margin = static_cast<float>(Rounding * extent);
  for (std::size_t place = 0; place < this->Order.size(); ++place)
  {
    Node& node = this->Nodes[place / Width];
    const auto lane = static_cast<Eigen::Index>(place % Width);
    for (int corner = 0; corner < 3; ++corner)
    {
      const Eigen::Vector3f point =
        (points.row(triangles(this->Order[place], corner)).transpose() - this->Middle)
          .cast<float>();
      for (int axis = 0; axis < 3; ++axis)
      {
        float& low = node.Low[axis][lane];
        float& high = node.High[axis][lane];
        low = std::min(low, point[axis] - margin);
        high = std::max(high, point[axis] + margin);
      }
    }
  }
}

void ClosestTriangleFinder::MakeNodesAbove()
{
  auto begin = std::size_t(0);
  while (this->Nodes.size() - begin > 1)
  {
    const std::size_t end = this->Nodes.size();
    for (std::size_t below = begin; below < end; below += Width)
    {
      Node node;
      for (int lane = 0; lane < Width; ++lane)
      {
        // A lane without a node repeats the first; it is never asked for.
        const Node& of = this->Nodes[below + lane < end ? below + lane : below];
        for (int axis = 0; axis < 3; ++axis)
        {
          node.Low[axis][lane] = of.Low[axis].minCoeff();
          node.High[axis][lane] = of.High[axis].maxCoeff();
        }
      }
      this->Nodes.push_back(node);
    }
    this->Levels.push_back(static_cast<int>(end));
    begin = end;
  }
}

ClosestTriangle ClosestTriangleFinder::Find(const Eigen::Vector3d& point, int likelyTriangle) const
{
  struct Entry
  {
    float Distance;
    int Level;
    int Index; // within the level
  };
  ClosestTriangle closest;
  float bound = std::numeric_limits<float>::infinity();
  const auto visit = [&](int triangle)
  {
    const double squaredDistance = this->Shapes[triangle].SquaredDistance(point);
    if (squaredDistance < closest.SquaredDistance)
    {
      closest = { triangle, squaredDistance };
      bound = std::min(bound, static_cast<float>(squaredDistance) * Slack);
    }
  };
  if (likelyTriangle >= 0)
  {
    visit(likelyTriangle);
  }
  const Eigen::Vector3f place = (point - this->Middle).cast<float>();
  // Each of at most 16 levels leaves at most three nodes waiting.
  std::array<Entry, 64> waiting;
  int size = 0;
  waiting[size++] = { 0, static_cast<int>(this->Levels.size()) - 1, 0 };
  while (size > 0)
  {
    const Entry entry = waiting[--size];
    if (entry.Distance > bound)
    {
      continue;
    }
    const Eigen::Array4f distances =
      this->Nodes[this->Levels[entry.Level] + entry.Index].SquaredDistances(place);
    // How many triangles, or nodes of the level below, there are.
    const int count = entry.Level == 0 ? static_cast<int>(this->Order.size())
                                       : this->Levels[entry.Level] - this->Levels[entry.Level - 1];
    const int begin = size;
    for (int lane = 0; lane < Width; ++lane)
    {
      const Entry next{ distances[lane], entry.Level - 1, Width * entry.Index + lane };
      if (next.Index >= count || next.Distance > bound)
      {
        continue;
      }
      if (entry.Level == 0)
      {
        visit(this->Order[next.Index]);
        continue;
      }
      // The nearest on top.
      int slot = size++;
      for (; slot > begin && waiting[slot - 1].Distance < next.Distance; --slot)
      {
        waiting[slot] = waiting[slot - 1];
      }
      waiting[slot] = next;
    }
  }
  return closest;
}

} // namespace FlipFree
