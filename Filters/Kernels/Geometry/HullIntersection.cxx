#include "Geometry/HullIntersection.h"

#include "Geometry/ExactPredicates.h"

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

// Whether the segments have a common point, in space.
bool SegmentsMeet(const double* a, const double* b, const double* c, const double* d)
{
  if (Orientation3D(a, b, c, d) != 0)
  {
    return false;
  }
  for (const Triangle& plane : { Triangle{ { a, b, c } }, Triangle{ { a, b, d } },
         Triangle{ { a, c, d } }, Triangle{ { b, c, d } } })
  {
    const Projection on = FindProjection(plane);
    if (on.X >= 0)
    {
      return SegmentsMeet(a, b, c, d, on);
    }
  }
  // All on one line: their boxes decide.
  TriangleBox boxes[2];
  boxes[0].Add(a);
  boxes[0].Add(b);
  boxes[1].Add(c);
  boxes[1].Add(d);
  return boxes[0].Touches(boxes[1]);
}

template <typename Test>
bool AnyEdge(const Triangle& t, const Test& test)
{
  return test(t[0], t[1]) || test(t[1], t[2]) || test(t[2], t[0]);
}

bool AllOnOneSide(const Triangle& plane, const Triangle& other)
{
  const int side = Orientation3D(plane[0], plane[1], plane[2], other[0]);
  return side != 0 && Orientation3D(plane[0], plane[1], plane[2], other[1]) == side &&
    Orientation3D(plane[0], plane[1], plane[2], other[2]) == side;
}

TriangleBox BoxAround(const Triangle& t)
{
  TriangleBox box;
  for (const double* corner : t)
  {
    box.Add(corner);
  }
  return box;
}

// A triangle without an area is a segment or a point. Boxes spare those of one plane, as flat parts
// of a surface have them, what is slow for them: exact signs.
bool TrianglesMeet(const Triangle& one, const Triangle& two)
{
  if (!BoxAround(one).Touches(BoxAround(two)) || AllOnOneSide(one, two) || AllOnOneSide(two, one))
  {
    return false;
  }
  const auto meetsOne = [&](const double* p, const double* q) { return SegmentMeets(p, q, one); };
  const auto meetsTwo = [&](const double* p, const double* q) { return SegmentMeets(p, q, two); };
  const bool isOneFlat = FindProjection(one).X < 0;
  const bool isTwoFlat = FindProjection(two).X < 0;
  if (isOneFlat && isTwoFlat)
  {
    return AnyEdge(one,
      [&](const double* a, const double* b)
      {
        return AnyEdge(two,
          [&](const double* c, const double* d) { return SegmentsMeet(a, b, c, d); });
      });
  }
  return (!isOneFlat && AnyEdge(two, meetsOne)) || (!isTwoFlat && AnyEdge(one, meetsTwo));
}

// The triangles whose union is the boundary of the hull, or, for three vertices or fewer, the hull
// itself.
int ListTriangles(const PointList& points, const Hull& hull, std::array<Triangle, 4>& triangles)
{
  const auto at = [&](int corner) { return points.row(hull[corner]).data(); };
  triangles[0] = { { at(0), at(1), at(2) } };
  if (hull[3] == hull[2])
  {
    return 1;
  }
  triangles[1] = { { at(0), at(1), at(3) } };
  triangles[2] = { { at(0), at(2), at(3) } };
  triangles[3] = { { at(1), at(2), at(3) } };
  return 4;
}

} // namespace

bool HullsMeet(const PointList& points, const Hull& one, const Hull& two)
{
  std::array<Triangle, 4> ofOne;
  std::array<Triangle, 4> ofTwo;
  const int numberOfOne = ListTriangles(points, one, ofOne);
  const int numberOfTwo = ListTriangles(points, two, ofTwo);
  for (int first = 0; first < numberOfOne; ++first)
  {
    for (int second = 0; second < numberOfTwo; ++second)
    {
      if (TrianglesMeet(ofOne[first], ofTwo[second]))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace FlipFree
