#include "Geometry/ClosestTriangle.h"

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

// The center of a triangle, times three.
struct Center
{
  std::array<float, 3> Position;
  int Triangle;
};

// Sorts the range so that every whole run of `capacity` elements lies together in
// space, and within it every whole run of a fourth of that. Halves along the longest extent.
void Arrange(int capacity, Center* first, Center* last)
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
  std::array<float, 3> low = first->Position;
  std::array<float, 3> high = first->Position;
  for (const Center* center = first; center != last; ++center)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], center->Position[axis]);
      high[axis] = std::max(high[axis], center->Position[axis]);
    }
  }
  int axis = high[1] - low[1] > high[0] - low[0] ? 1 : 0;
  axis = high[2] - low[2] > high[axis] - low[axis] ? 2 : axis;
  Center* const middle = first + runs / 2 * capacity;
  std::nth_element(first, middle, last,
    [axis](const Center& one, const Center& other)
    {
      const float a = one.Position[axis];
      const float b = other.Position[axis];
      return a < b || (a == b && one.Triangle < other.Triangle);
    });
  Arrange(capacity, first, middle);
  Arrange(capacity, middle, last);
}

// The triangles in an order in which those that follow each other lie close together.
std::vector<int> CoherentOrder(const PointList& points, const TriangleList& triangles,
  const Eigen::Vector3d& middle)
{
  std::vector<Center> centers(triangles.rows());
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const Eigen::RowVector3f position =
      (points.row(triangles(triangle, 0)) + points.row(triangles(triangle, 1)) +
        points.row(triangles(triangle, 2)) - 3 * middle.transpose())
        .cast<float>();
    centers[triangle] = { { { position[0], position[1], position[2] } },
      static_cast<int>(triangle) };
  }
  int capacity = Width;
  while (capacity < triangles.rows())
  {
    capacity *= Width;
  }
  Arrange(capacity, centers.data(), centers.data() + centers.size());
  std::vector<int> order(centers.size());
  std::transform(centers.begin(), centers.end(), order.begin(),
    [](const Center& center) { return center.Triangle; });
  return order;
}

} // namespace

TriangleForDistance::TriangleForDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  const Eigen::Vector3d& c)
  : A(a)
  , AB(b - a)
  , AC(c - a)
  , Normal(AB.cross(AC))
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
  const double weightOfB = this->TowardB().dot(from);
  const double weightOfC = this->TowardC().dot(from);
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

// The same steps as for one point, but for all at once and without branches: whether the closest
// point lies inside is asked at the end, and a side that a point is not beyond does no harm.
void TriangleForDistance::LowerToSquaredDistances(const PointPacket& points,
  PointPacket::Values& least) const
{
  const double originX = this->A.x(), originY = this->A.y(), originZ = this->A.z();
  const double normalX = this->Normal.x(), normalY = this->Normal.y(), normalZ = this->Normal.z();
  const Eigen::Vector3d towardB = this->TowardB();
  const Eigen::Vector3d towardC = this->TowardC();
  const double bX = towardB.x(), bY = towardB.y(), bZ = towardB.z();
  const double cX = towardC.x(), cY = towardC.y(), cZ = towardC.z();
  const double abX = this->AB.x(), abY = this->AB.y(), abZ = this->AB.z();
  const double acX = this->AC.x(), acY = this->AC.y(), acZ = this->AC.z();
  const double bcX = acX - abX, bcY = acY - abY, bcZ = acZ - abZ;
  const double inverseAB = this->InverseSquaredAB;
  const double inverseAC = this->InverseSquaredAC;
  const double inverseBC = this->InverseSquaredBC;
  const double squaredArea = this->SquaredArea;
  const double inverseArea = InverseOrZero(squaredArea);
  const double most = squaredArea == 0 ? -1 : squaredArea; // a needle has no inside
  const double* const xs = points.X.data();
  const double* const ys = points.Y.data();
  const double* const zs = points.Z.data();
  PointPacket::Values distances;
  for (int lane = 0; lane < PointPacket::Size; ++lane)
  {
    const double x = xs[lane] - originX;
    const double y = ys[lane] - originY;
    const double z = zs[lane] - originZ;
    const double b = bX * x + bY * y + bZ * z;
    const double c = cX * x + cY * y + cZ * z;
    const double a = squaredArea - b - c;
    const double height = normalX * x + normalY * y + normalZ * z;
    const auto toSide =
      [](double px, double py, double pz, double sx, double sy, double sz, double inverse)
    {
      const double along = (sx * px + sy * py + sz * pz) * inverse;
      const double above = along > 0 ? along : 0;
      const double t = above < 1 ? above : 1;
      const double dx = px - t * sx;
      const double dy = py - t * sy;
      const double dz = pz - t * sz;
      return dx * dx + dy * dy + dz * dz;
    };
    const double toAB = toSide(x, y, z, abX, abY, abZ, inverseAB);
    const double toAC = toSide(x, y, z, acX, acY, acZ, inverseAC);
    const double toBC = toSide(x - abX, y - abY, z - abZ, bcX, bcY, bcZ, inverseBC);
    const double toTwo = toAB < toAC ? toAB : toAC;
    const double toSides = toTwo < toBC ? toTwo : toBC;
    const double minimumOfTwo = a < b ? a : b;
    const double minimumOfThree = minimumOfTwo < c ? minimumOfTwo : c;
    const double inside = minimumOfThree < most ? minimumOfThree : most;
    const double toInside = height * height * inverseArea;
    distances[lane] = inside < 0 ? toSides : toInside;
  }
  for (int lane = 0; lane < PointPacket::Size; ++lane)
  {
    least[lane] = std::min(least[lane], distances[lane]);
  }
}

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return TriangleForDistance(a, b, c).SquaredDistance(point);
}

ClosestTriangleFinder::ClosestTriangleFinder(const PointList& points, const TriangleList& triangles)
{
  Eigen::RowVector3d low = points.row(triangles(0, 0));
  Eigen::RowVector3d high = low;
  for (Eigen::Index corner = 0; corner < triangles.size(); ++corner)
  {
    low = low.cwiseMin(points.row(triangles.data()[corner]));
    high = high.cwiseMax(points.row(triangles.data()[corner]));
  }
  this->Middle = 0.5 * (low + high);
  this->Extent = (high - low).maxCoeff() / 2;
  this->Order = CoherentOrder(points, triangles, this->Middle);
  this->Shapes.reserve(this->Order.size());
  for (const int triangle : this->Order)
  {
    this->Shapes.emplace_back(points.row(triangles(triangle, 0)),
      points.row(triangles(triangle, 1)), points.row(triangles(triangle, 2)));
  }
  this->MakeLeaves(points, triangles);
  this->MakeNodesAbove();
}

void ClosestTriangleFinder::MakeLeaves(const PointList& points, const TriangleList& triangles)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Node empty;
  empty.Low.fill(Eigen::Array4f::Constant(infinity));
  empty.High.fill(Eigen::Array4f::Constant(-infinity));
  const std::size_t leaves = (this->Order.size() + Width - 1) / Width;
  this->Nodes.reserve(leaves + leaves / (Width - 1) + 32); // those above too
  this->Nodes.assign(leaves, empty);
  this->Levels = { 0 };
  const auto margin = static_cast<float>(Rounding * this->Extent);
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

void ClosestTriangleFinder::FindSquaredDistances(const PointPacket& points, int& hint,
  PointPacket::Values& squaredDistances) const
{
  struct Entry
  {
    float Distance;
    int Level;
    int Index; // within the level
  };
  using Lanes = Eigen::Array<float, PointPacket::Size, 1>;
  squaredDistances.fill(std::numeric_limits<double>::infinity());
  // Of the points one by one, and of all of them: what is farther need not be looked at.
  Lanes bounds;
  float bound = 0;
  const auto visit = [&](int place)
  {
    const double before = squaredDistances[0];
    this->Shapes[place].LowerToSquaredDistances(points, squaredDistances);
    hint = squaredDistances[0] < before ? place : hint;
    bounds = Slack *
      Eigen::Map<const Eigen::Array<double, PointPacket::Size, 1>>(squaredDistances.data())
        .template cast<float>();
    bound = bounds.maxCoeff();
  };
  visit(hint);
  std::array<Lanes, 3> lanes;
  const std::array<const double*, 3> coordinates{ { points.X.data(), points.Y.data(),
    points.Z.data() } };
  Eigen::Array3f low;
  Eigen::Array3f high;
  for (int axis = 0; axis < 3; ++axis)
  {
    lanes[axis] = (Eigen::Map<const Eigen::Array<double, PointPacket::Size, 1>>(coordinates[axis]) -
      this->Middle[axis])
                    .template cast<float>();
    low[axis] = lanes[axis].minCoeff();
    high[axis] = lanes[axis].maxCoeff();
  }
  const auto isNearAPoint = [&](const Node& node, int lane)
  {
    Lanes sum = Lanes::Zero();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Lanes outside =
        (node.Low[axis][lane] - lanes[axis]).max(lanes[axis] - node.High[axis][lane]).max(0.0F);
      sum += outside * outside;
    }
    return (sum <= bounds).any();
  };
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
    const Node& node = this->Nodes[this->Levels[entry.Level] + entry.Index];
    const Eigen::Array4f distances = node.SquaredDistancesTo(low, high);
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
        if (isNearAPoint(node, lane))
        {
          visit(next.Index);
        }
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
}

} // namespace FlipFree
