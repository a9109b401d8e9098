#include "Mesh/QuadSphere.h"

#include "Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace FlipFree
{
namespace
{

// Vertex (u, v) of the cube's side `axis`, `sign`; u runs along the next axis, v along the one
// after.
struct SideGrid
{
  int n;

  int operator()(int axis, int sign, int u, int v) const
  {
    return ((2 * axis + sign) * this->n + v) * this->n + u;
  }
};

// Appends the face in the order that makes its normal point away from the center.
void AppendOutward(FaceList& faces, const PointList& cube, std::vector<int> face)
{
  const Eigen::Vector3d a = cube.row(face[0]);
  const Eigen::Vector3d b = cube.row(face[1]);
  const Eigen::Vector3d c = cube.row(face[2]);
  if ((b - a).cross(c - a).dot(a + b + c) < 0)
  {
    std::reverse(face.begin(), face.end());
  }
  faces.Connectivity.insert(faces.Connectivity.end(), face.begin(), face.end());
  faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
}

PointList CubePoints(int n, QuadSphere& sphere)
{
  PointList cube(6 * n * n, 3);
  sphere.Cells.resize(6 * n * n);
  const SideGrid at{ n };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int sign = 0; sign < 2; ++sign)
    {
      for (int v = 0; v < n; ++v)
      {
        for (int u = 0; u < n; ++u)
        {
          const int vertex = at(axis, sign, u, v);
          cube(vertex, axis) = 2 * sign - 1;
          cube(vertex, (axis + 1) % 3) = (2 * u + 1 - n) / static_cast<double>(n);
          cube(vertex, (axis + 2) % 3) = (2 * v + 1 - n) / static_cast<double>(n);
          sphere.Cells[vertex] = { { 2 * axis + sign, u, v } };
        }
      }
    }
  }
  return cube;
}

void AppendSides(FaceList& faces, const PointList& cube, const SideGrid& at)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int sign = 0; sign < 2; ++sign)
    {
      for (int v = 0; v + 1 < at.n; ++v)
      {
        for (int u = 0; u + 1 < at.n; ++u)
        {
          AppendOutward(faces, cube,
            { at(axis, sign, u, v), at(axis, sign, u + 1, v), at(axis, sign, u + 1, v + 1),
              at(axis, sign, u, v + 1) });
        }
      }
    }
  }
}

// Along an edge of the cube parallel to axis c, the sides normal to a and b face each other.
void AppendEdges(FaceList& faces, const PointList& cube, const SideGrid& at)
{
  const int last = at.n - 1;
  for (int c = 0; c < 3; ++c)
  {
    const int a = (c + 1) % 3;
    const int b = (c + 2) % 3;
    for (int signA = 0; signA < 2; ++signA)
    {
      for (int signB = 0; signB < 2; ++signB)
      {
        for (int k = 0; k + 1 < at.n; ++k)
        {
          const int onA = signB * last;
          const int onB = signA * last;
          AppendOutward(faces, cube,
            { at(a, signA, onA, k), at(a, signA, onA, k + 1), at(b, signB, k + 1, onB),
              at(b, signB, k, onB) });
        }
      }
    }
  }
}

void AppendCorners(FaceList& faces, const PointList& cube, const SideGrid& at)
{
  const int last = at.n - 1;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int x = corner & 1;
    const int y = (corner >> 1) & 1;
    const int z = corner >> 2;
    AppendOutward(faces, cube,
      { at(0, x, y * last, z * last), at(1, y, z * last, x * last), at(2, z, x * last, y * last) });
  }
}

} // namespace

QuadSphere MakeQuadSphere(int n, const Eigen::Vector3d& center, double radius,
  QuadSphereSpacing spacing)
{
  if (n < 1)
  {
    throw Error(ErrorCode::OutOfRange,
      "a quad sphere needs at least one vertex along the edge of a side, "
      "not " +
        std::to_string(n));
  }
  QuadSphere sphere;
  const PointList cube = CubePoints(n, sphere);
  const SideGrid at{ n };
  AppendSides(sphere.Faces, cube, at);
  AppendEdges(sphere.Faces, cube, at);
  AppendCorners(sphere.Faces, cube, at);

  sphere.Points.resize(cube.rows(), 3);
  for (Eigen::Index vertex = 0; vertex < cube.rows(); ++vertex)
  {
    Eigen::Vector3d point = cube.row(vertex);
    if (spacing == QuadSphereSpacing::Equiangular)
    {
      const double quarterOfPi = std::atan(1.0);
      point = (quarterOfPi * point.array()).tan().matrix();
    }
    if (spacing != QuadSphereSpacing::Cube)
    {
      point.normalize();
    }
    sphere.Points.row(vertex) = center + radius * point;
  }
  return sphere;
}

std::vector<unsigned char> CheckerboardOf(const QuadSphere& sphere)
{
  constexpr int cells = 4; // along an edge of a field
  std::vector<unsigned char> fields;
  fields.reserve(sphere.Cells.size());
  for (const auto& [side, u, v] : sphere.Cells)
  {
    fields.push_back(static_cast<unsigned char>((u / cells + v / cells) % 2));
  }
  return fields;
}

} // namespace FlipFree
