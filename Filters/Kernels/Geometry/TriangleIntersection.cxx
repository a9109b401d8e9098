#include "Geometry/TriangleIntersection.h"

#include "Geometry/ExactPredicates.h"
#include "Geometry/TriangleTree.h"

#include <array>

namespace FlipFree
{
namespace
{

using Triangle = std::array<const double*, 3>;

// The coordinates of a plane in which the triangle's projection has an area; X < 0 if there is
// none.
struct Projection
{
  int X = -1;
  int Y = -1;
};

Projection FindProjection(const Triangle& t)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int x = (axis + 1) % 3;
    const int y = (axis + 2) % 3;
    if (Orientation2D(t[0], t[1], t[2], x, y) != 0)
    {
      return { x, y };
    }
  }
  return {};
}

// p is known to be on the line through a and b.
bool IsBetween(const double* a, const double* b, const double* p, const Projection& on)
{
  const auto within = [&](int axis)
  {
    return (a[axis] <= p[axis] && p[axis] <= b[axis]) || (b[axis] <= p[axis] && p[axis] <= a[axis]);
  };
  return within(on.X) && within(on.Y);
}

bool SegmentsMeet(const double* a, const double* b, const double* c, const double* d,
  const Projection& on)
{
  const int abc = Orientation2D(a, b, c, on.X, on.Y);
  const int abd = Orientation2D(a, b, d, on.X, on.Y);
  const int cda = Orientation2D(c, d, a, on.X, on.Y);
  const int cdb = Orientation2D(c, d, b, on.X, on.Y);
  if (abc * abd < 0 && cda * cdb < 0)
  {
    return true;
  }
  return (abc == 0 && IsBetween(a, b, c, on)) || (abd == 0 && IsBetween(a, b, d, on)) ||
    (cda == 0 && IsBetween(c, d, a, on)) || (cdb == 0 && IsBetween(c, d, b, on));
}

bool IsInside(const Triangle& t, const double* p, const Projection& on)
{
  const int ab = Orientation2D(t[0], t[1], p, on.X, on.Y);
  const int bc = Orientation2D(t[1], t[2], p, on.X, on.Y);
  const int ca = Orientation2D(t[2], t[0], p, on.X, on.Y);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool CoplanarSegmentMeets(const double* p, const double* q, const Triangle& t, const Projection& on)
{
  return IsInside(t, p, on) || SegmentsMeet(p, q, t[0], t[1], on) ||
    SegmentsMeet(p, q, t[1], t[2], on) || SegmentsMeet(p, q, t[2], t[0], on);
}

bool SegmentMeets(const double* p, const double* q, const Triangle& t)
{
  const int sideP = Orientation3D(t[0], t[1], t[2], p);
  const int sideQ = Orientation3D(t[0], t[1], t[2], q);
  if (sideP * sideQ > 0)
  {
    return false;
  }
  if (sideP == 0 && sideQ == 0)
  {
    const Projection on = FindProjection(t);
    return on.X >= 0 && CoplanarSegmentMeets(p, q, t, on);
  }
  const int ab = Orientation3D(p, q, t[0], t[1]);
  const int bc = Orientation3D(p, q, t[1], t[2]);
  if (ab * bc < 0)
  {
    return false;
  }
  const int ca = Orientation3D(p, q, t[2], t[0]);
  return ab * ca >= 0 && bc * ca >= 0;
}

bool EdgesMeet(const Triangle& one, const Triangle& two)
{
  return SegmentMeets(one[0], one[1], two) || SegmentMeets(one[1], one[2], two) ||
    SegmentMeets(one[2], one[0], two);
}

bool AllOnOneSide(const Triangle& plane, const Triangle& other)
{
  const int side = Orientation3D(plane[0], plane[1], plane[2], other[0]);
  return side != 0 && Orientation3D(plane[0], plane[1], plane[2], other[1]) == side &&
    Orientation3D(plane[0], plane[1], plane[2], other[2]) == side;
}

bool SeparateIntersect(const Triangle& one, const Triangle& two)
{
  if (AllOnOneSide(one, two) || AllOnOneSide(two, one))
  {
    return false;
  }
  if (EdgesMeet(one, two) || EdgesMeet(two, one))
  {
    return true;
  }
  // Both are segments or points. A surface that contains them is not embedded anyway, so their
  // boxes decide.
  if (FindProjection(one).X < 0 && FindProjection(two).X < 0)
  {
    TriangleBox boxes[2];
    for (int corner = 0; corner < 3; ++corner)
    {
      boxes[0].Add(one[corner]);
      boxes[1].Add(two[corner]);
    }
    return boxes[0].Touches(boxes[1]);
  }
  return false;
}

// Both triangles have their common vertex first. A ray from there that stays in both leaves one of
// them through the opposite edge.
bool VertexNeighborsIntersect(const Triangle& one, const Triangle& two)
{
  const int sideOne = Orientation3D(one[0], one[1], one[2], two[1]);
  const int sideTwo = Orientation3D(one[0], one[1], one[2], two[2]);
  if (sideOne * sideTwo > 0)
  {
    return false;
  }
  const int otherSideOne = Orientation3D(two[0], two[1], two[2], one[1]);
  const int otherSideTwo = Orientation3D(two[0], two[1], two[2], one[2]);
  if (otherSideOne * otherSideTwo > 0)
  {
    return false;
  }
  return SegmentMeets(one[1], one[2], two) || SegmentMeets(two[1], two[2], one) ||
    FindProjection(one).X < 0 || FindProjection(two).X < 0;
}

// Both triangles have their common edge first.
bool EdgeNeighborsIntersect(const Triangle& one, const Triangle& two)
{
  if (Orientation3D(one[0], one[1], one[2], two[2]) != 0)
  {
    return false;
  }
  const Projection on = FindProjection(one);
  if (on.X < 0)
  {
    return true;
  }
  const int sideOne = Orientation2D(one[0], one[1], one[2], on.X, on.Y);
  const int sideTwo = Orientation2D(one[0], one[1], two[2], on.X, on.Y);
  return sideOne * sideTwo >= 0;
}

} // namespace

bool TrianglesIntersect(const PointList& points, const TriangleList& triangles, int one, int two)
{
  const int* const verticesOne = triangles.row(one).data();
  const int* const verticesTwo = triangles.row(two).data();
  // Vertices that are shared come first.
  int orderOne[3] = { 0, 1, 2 };
  int orderTwo[3] = { 0, 1, 2 };
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = shared; j < 3; ++j)
    {
      if (verticesOne[i] == verticesTwo[orderTwo[j]])
      {
        std::swap(orderTwo[shared], orderTwo[j]);
        // Every position before i that is not shared moves up by one.
        for (int k = i; k > shared; --k)
        {
          orderOne[k] = orderOne[k - 1];
        }
        orderOne[shared] = i;
        ++shared;
        break;
      }
    }
  }
  Triangle pointsOne;
  Triangle pointsTwo;
  for (int corner = 0; corner < 3; ++corner)
  {
    pointsOne[corner] = points.row(verticesOne[orderOne[corner]]).data();
    pointsTwo[corner] = points.row(verticesTwo[orderTwo[corner]]).data();
  }
  switch (shared)
  {
    case 0:
      return SeparateIntersect(pointsOne, pointsTwo);
    case 1:
      return VertexNeighborsIntersect(pointsOne, pointsTwo);
    case 2:
      return EdgeNeighborsIntersect(pointsOne, pointsTwo);
    default:
      return true;
  }
}

} // namespace FlipFree
