#include "ClosestTriangle.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr int LeafSize = 4;

// Distances are rounded, those to boxes too: only boxes that are farther beyond doubt are skipped,
// so that the result does not depend on the order of the search.
constexpr double Slack = 1 + 1e-12;

double SquaredDistanceToSegment(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b)
{
  const Eigen::Vector3d along = b - a;
  const double squaredLength = along.squaredNorm();
  const double t =
    squaredLength > 0 ? std::clamp(along.dot(point - a) / squaredLength, 0.0, 1.0) : 0.0;
  return (a + t * along - point).squaredNorm();
}

} // namespace

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d ap = point - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double squaredArea = normal.squaredNorm();
  // The normal of a needle has no reliable direction; its sides are as good as its inside.
  if (squaredArea > 1e-20 * ab.squaredNorm() * ac.squaredNorm())
  {
    const double v = ap.cross(ac).dot(normal);
    const double w = ab.cross(ap).dot(normal);
    if (v >= 0 && w >= 0 && v + w <= squaredArea)
    {
      const double height = normal.dot(ap);
      return height * height / squaredArea;
    }
  }
  return std::min({ SquaredDistanceToSegment(point, a, b), SquaredDistanceToSegment(point, b, c),
    SquaredDistanceToSegment(point, c, a) });
}

ClosestTriangleTree::ClosestTriangleTree(const PointList& points, const TriangleList& triangles)
  : Points(points)
  , Triangles(triangles)
  , Order(triangles.rows())
{
  std::iota(this->Order.begin(), this->Order.end(), 0);
  PointList centroids(triangles.rows(), 3);
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    centroids.row(triangle) =
      (points.row(triangles(triangle, 0)) + points.row(triangles(triangle, 1)) +
        points.row(triangles(triangle, 2))) /
      3;
  }
  this->Nodes.reserve(this->Order.size());
  this->Build(0, static_cast<int>(this->Order.size()), centroids);
}

void ClosestTriangleTree::Build(int first, int last, const PointList& centroids)
{
  const std::size_t node = this->Nodes.size();
  this->Nodes.emplace_back();
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centroidBox;
  for (int entry = first; entry < last; ++entry)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int vertex = this->Triangles(this->Order[entry], corner);
      box.extend(this->Points.row(vertex).transpose());
    }
    centroidBox.extend(centroids.row(this->Order[entry]).transpose());
  }
  this->Nodes[node].Box = box;
  this->Nodes[node].First = first;
  this->Nodes[node].Last = last;
  if (last - first <= LeafSize)
  {
    return;
  }
  Eigen::Index axis = 0;
  centroidBox.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(this->Order.begin() + first, this->Order.begin() + middle,
    this->Order.begin() + last,
    [&centroids, axis](int a, int b)
    {
      const double x = centroids(a, axis);
      const double y = centroids(b, axis);
      return x != y ? x < y : a < b;
    });
  this->Build(first, middle, centroids);
  this->Nodes[node].SecondChild = static_cast<int>(this->Nodes.size());
  this->Build(middle, last, centroids);
}

double ClosestTriangleTree::SquaredDistance(const Eigen::Vector3d& point, int triangle) const
{
  return SquaredDistanceToTriangle(point, this->Points.row(this->Triangles(triangle, 0)),
    this->Points.row(this->Triangles(triangle, 1)), this->Points.row(this->Triangles(triangle, 2)));
}

ClosestTriangleTree::Closest ClosestTriangleTree::FindClosest(const Eigen::Vector3d& point,
  int likelyTriangle) const
{
  Closest closest;
  if (likelyTriangle >= 0)
  {
    closest = { likelyTriangle, this->SquaredDistance(point, likelyTriangle) };
  }
  // Halving keeps the depth below 32, and each level leaves at most one node waiting.
  std::array<std::pair<int, double>, 64> waiting;
  int size = 0;
  waiting[size++] = { 0, this->Nodes[0].Box.squaredExteriorDistance(point) };
  while (size > 0)
  {
    const auto [index, distance] = waiting[--size];
    if (distance > closest.SquaredDistance * Slack)
    {
      continue;
    }
    const Node& node = this->Nodes[index];
    if (node.SecondChild < 0)
    {
      for (int entry = node.First; entry < node.Last; ++entry)
      {
        const double squaredDistance = this->SquaredDistance(point, this->Order[entry]);
        if (squaredDistance < closest.SquaredDistance)
        {
          closest = { this->Order[entry], squaredDistance };
        }
      }
      continue;
    }
    std::pair<int, double> near{ index + 1,
      this->Nodes[index + 1].Box.squaredExteriorDistance(point) };
    std::pair<int, double> far{ node.SecondChild,
      this->Nodes[node.SecondChild].Box.squaredExteriorDistance(point) };
    if (far.second < near.second)
    {
      std::swap(near, far);
    }
    waiting[size++] = far;
    waiting[size++] = near;
  }
  return closest;
}

} // namespace FlipFree
