#include "Mesh/SurfaceVoxelization.h"

#include "Error.h"
#include "Mesh/SurfaceTopology.h"
#include "MessageText.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace FlipFree
{
namespace
{

// A row of voxels crosses the surface. Windings of +1 and -1 are entries and exits or, if the
// surface is inside out, exits and entries.
struct RowCrossing
{
  int Row;
  int Winding;
  double Position;

  bool operator<(const RowCrossing& other) const
  {
    return this->Row != other.Row ? this->Row < other.Row : this->Position < other.Position;
  }
};

// The first integer not below the value, within [0, size].
int FirstAtOrAbove(double value, int size)
{
  return value <= 0 ? 0 : value >= size ? size : static_cast<int>(std::ceil(value));
}

PointList IndexCoordinates(const PointList& points, const ImageGeometry& geometry)
{
  const Eigen::Matrix3d toPhysical = geometry.Direction * geometry.Spacing.asDiagonal();
  if (!(std::abs(toPhysical.determinant()) > 0) || !toPhysical.allFinite() ||
    !geometry.Origin.allFinite())
  {
    throw Error(ErrorCode::InvalidGeometry,
      "the image's geometry is singular: spacing must not be zero, and "
      "the direction matrix must be invertible");
  }
  const Eigen::Matrix3d toIndex = toPhysical.inverse();
  return (points.rowwise() - geometry.Origin.transpose()) * toIndex.transpose();
}

// Throws if a vertex of the surface is so far from the image that doubles cannot resolve voxels
// there. Unused points do not matter.
void RequireNear(const PointList& index, const PointList& points, const TriangleList& triangles)
{
  constexpr double farthest = 1e15;
  if ((index.array().abs() <= farthest).all())
  {
    return;
  }
  for (Eigen::Index corner = 0; corner < triangles.size(); ++corner)
  {
    const int point = triangles.data()[corner];
    if (!(index.row(point).array().abs() <= farthest).all())
    {
      throw Error(ErrorCode::OutOfRange,
        "point " + std::to_string(point) + " of the surface, at " + TextOf(points.row(point)) +
          " mm, lies more than 1e15 voxels away from the image; remove or repair it");
    }
  }
}

// For each plane of voxels, the triangles that cross it.
std::vector<std::vector<int>> TrianglesByPlane(const PointList& index,
  const TriangleList& triangles, int numberOfPlanes)
{
  std::vector<std::vector<int>> planes(numberOfPlanes);
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const double a = index(triangles(triangle, 0), 2);
    const double b = index(triangles(triangle, 1), 2);
    const double c = index(triangles(triangle, 2), 2);
    const int last = FirstAtOrAbove(std::max({ a, b, c }), numberOfPlanes);
    for (int k = FirstAtOrAbove(std::min({ a, b, c }), numberOfPlanes); k < last; ++k)
    {
      planes[k].push_back(triangle);
    }
  }
  return planes;
}

// The intersection of an edge, from its lower to its upper end, with plane k: the same bits for
// both triangles of the edge.
Eigen::Vector2d CrossPlane(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, int k)
{
  const double t = (k - lower.z()) / (upper.z() - lower.z());
  return lower.head<2>() + t * (upper.head<2>() - lower.head<2>());
}

// The crossings of voxel rows with one side, from `start` to `end`, of the polygon in their plane.
void CrossRows(const Eigen::Vector2d& start, const Eigen::Vector2d& end, int numberOfRows,
  std::vector<RowCrossing>& crossings)
{
  const bool rising = start.y() <= end.y();
  const Eigen::Vector2d& lower = rising ? start : end;
  const Eigen::Vector2d& upper = rising ? end : start;
  const int last = FirstAtOrAbove(upper.y(), numberOfRows);
  for (int j = FirstAtOrAbove(lower.y(), numberOfRows); j < last; ++j)
  {
    const double t = (j - lower.y()) / (upper.y() - lower.y());
    crossings.push_back({ j, rising ? 1 : -1, lower.x() + t * (upper.x() - lower.x()) });
  }
}

void CrossTriangle(const PointList& index, const int* triangle, int k, int numberOfRows,
  std::vector<RowCrossing>& crossings)
{
  // A triangle that straddles the plane passes it once upwards and once downwards.
  Eigen::Vector2d up = Eigen::Vector2d::Zero();
  Eigen::Vector2d down = Eigen::Vector2d::Zero();
  for (int corner = 0; corner < 3; ++corner)
  {
    const Eigen::Vector3d a = index.row(triangle[corner]);
    const Eigen::Vector3d b = index.row(triangle[(corner + 1) % 3]);
    const bool isBelowA = a.z() <= k;
    const bool isBelowB = b.z() <= k;
    if (isBelowA != isBelowB)
    {
      (isBelowA ? up : down) = CrossPlane(isBelowA ? a : b, isBelowA ? b : a, k);
    }
  }
  CrossRows(up, down, numberOfRows, crossings);
}

void AppendRuns(const std::vector<RowCrossing>& crossings, int k, int rowLength,
  std::vector<VoxelRun>& runs)
{
  int winding = 0;
  int begin = 0;
  for (const RowCrossing& crossing : crossings)
  {
    const int voxel = FirstAtOrAbove(crossing.Position, rowLength);
    if (winding == 0)
    {
      begin = voxel;
    }
    winding += crossing.Winding;
    if (winding != 0 || begin == voxel)
    {
      continue;
    }
    if (!runs.empty() && runs.back().J == crossing.Row && runs.back().End == begin)
    {
      runs.back().End = voxel;
    }
    else
    {
      runs.push_back({ crossing.Row, k, begin, voxel });
    }
  }
}

} // namespace

bool VoxelizeSurface(const PointList& points, const TriangleList& triangles,
  const ImageGeometry& geometry, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<VoxelRun>& runs)
{
  RequireValidFaces(points, FacesOf(triangles), "the surface");
  RequireClosed(static_cast<int>(points.rows()), triangles, "the surface");
  const PointList index = IndexCoordinates(points, geometry);
  RequireNear(index, points, triangles);
  const int numberOfPlanes = geometry.Dimensions[2];
  const auto trianglesByPlane = TrianglesByPlane(index, triangles, numberOfPlanes);
  if (!monitor(0.5))
  {
    return false;
  }

  std::vector<std::vector<VoxelRun>> planeRuns(numberOfPlanes);
  parallelFor(0, numberOfPlanes,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<RowCrossing> crossings;
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        crossings.clear();
        for (const int triangle : trianglesByPlane[k])
        {
          CrossTriangle(index, triangles.row(triangle).data(), k, geometry.Dimensions[1],
            crossings);
        }
        std::sort(crossings.begin(), crossings.end());
        AppendRuns(crossings, k, geometry.Dimensions[0], planeRuns[k]);
      }
    });

  runs.clear();
  for (const auto& plane : planeRuns)
  {
    runs.insert(runs.end(), plane.begin(), plane.end());
  }
  return true;
}

std::vector<VoxelRun> VoxelizeSurface(const PointList& points, const TriangleList& triangles,
  const ImageGeometry& geometry, const ParallelFor& parallelFor)
{
  std::vector<VoxelRun> runs;
  VoxelizeSurface(points, triangles, geometry, parallelFor, NeverStop, runs);
  return runs;
}

bool HasVoxel(const std::vector<VoxelRun>& runs, const std::array<int, 3>& voxel)
{
  return std::any_of(runs.begin(), runs.end(),
    [&voxel](const VoxelRun& run) {
      return run.K == voxel[2] && run.J == voxel[1] && run.Begin <= voxel[0] && voxel[0] < run.End;
    });
}

std::size_t CountVoxels(const std::vector<VoxelRun>& runs)
{
  std::size_t count = 0;
  for (const VoxelRun& run : runs)
  {
    count += run.End - run.Begin;
  }
  return count;
}

} // namespace FlipFree
