#include "Vessel/VesselStart.h"

#include "Error.h"
#include "Geometry/WindingNumber.h"
#include "Image/PointConstraint.h"
#include "Image/VoxelTraversal.h"
#include "Vessel/CellSurface.h"
#include "Vessel/TreeDepth.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

constexpr double LeastEdge = 0.8; // of cells, mm

// Of a vessel of that radius: four cells across, in thin ones three, whose time is that of their
// surface.
double CellEdge(double radius)
{
  constexpr double thinEdge = 2; // mm
  return std::max({ LeastEdge, radius / 2, std::min(thinEdge, radius / 1.5) });
}

// The cells that a line passes, each sharing a side with the next.
void InsertLine(const PointList& line, BitMask& cells)
{
  const VoxelGrid grid(cells.GetGeometry());
  for (Eigen::Index point = 0; point + 1 < line.rows(); ++point)
  {
    const Eigen::Vector3d step = (line.row(point + 1) - line.row(point)).transpose();
    VoxelTraversal walk(grid, line.row(point).transpose(), step.normalized());
    for (; walk.GetEntry() <= step.norm(); walk.Advance())
    {
      if (walk.IsInside())
      {
        const auto& voxel = walk.GetVoxel();
        cells.Insert(voxel[0], voxel[1], voxel[2]);
      }
    }
  }
}

// Calls `body` with the indices of the cells that hold a point or touch it.
template <typename Body>
void ForEachCellAt(const ImageGeometry& grid, const Eigen::Vector3d& point, const Body& body)
{
  const VoxelBox box = BoxAround(grid, point, 0.51 * grid.Spacing[0]);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        body(i, j, k);
      }
    }
  }
}

// The cells of a start surface: a ball within the outline and along the path. They hold a point of
// `outside` only where the path is.
BitMask StartCells(const VesselTree& tree, const PointList& outside, double edge,
  const ParallelFor& parallelFor)
{
  // Cells along the path may lie without, but not far.
  FloatImage depth = DepthOnGrid(tree, edge, 2 + 3 * edge, parallelFor);
  for (Eigen::Index point = 0; point < outside.rows(); ++point)
  {
    ForEachCellAt(depth.Geometry, outside.row(point).transpose(),
      [&](int i, int j, int k) { depth.Voxels[depth.Geometry.Offset(i, j, k)] = -1; });
  }
  BitMask cells = VoxelsWhere(
    depth.View(), [&](float value) { return value > 0.25 * edge; }, parallelFor);
  for (const VesselBranch& branch : tree.Branches)
  {
    PointList line(static_cast<Eigen::Index>(branch.Sections.Frames.size()), 3);
    for (Eigen::Index section = 0; section < line.rows(); ++section)
    {
      line.row(section) = branch.Sections.Frames[section].Origin;
    }
    InsertLine(line, cells);
  }
  // The deepest cell, of equals the first.
  const auto deepest = static_cast<std::size_t>(
    std::max_element(depth.Voxels.begin(), depth.Voxels.end()) - depth.Voxels.begin());
  return GrowBall(cells, depth.Voxels, deepest);
}

bool HoldsOne(const BitMask& cells, const PointList& outside)
{
  bool isHeld = false;
  for (Eigen::Index point = 0; point < outside.rows(); ++point)
  {
    ForEachCellAt(cells.GetGeometry(), outside.row(point).transpose(),
      [&](int i, int j, int k) { isHeld = isHeld || cells(i, j, k); });
  }
  return isHeld;
}

void RequireOutside(const DeformableSurface& surface, const PointList& outside)
{
  for (Eigen::Index point = 0; point < outside.rows(); ++point)
  {
    if (WindingNumber(surface.Points, surface.Mesh.Triangles, outside.row(point).transpose()) != 0)
    {
      throw Error(ErrorCode::UnreachablePoint,
        NameOf({ ConstraintKind::Outside, outside.row(point).transpose(), 0 }) +
          " lies on the vessel's path or beside it; move it away from the path, or give more "
          "points along the vessel");
    }
  }
}

} // namespace

DeformableSurface MakeStart(const VesselTree& tree, const PointList& outside,
  const ParallelFor& parallelFor)
{
  constexpr double finer = 0.7;
  double edge = CellEdge(SmallestRadius(tree));
  const BitMask coarse = StartCells(tree, outside, edge, parallelFor);
  BitMask cells = coarse;
  while (edge > LeastEdge && HoldsOne(cells, outside))
  {
    edge = std::max(LeastEdge, finer * edge);
    cells = StartCells(tree, outside, edge, parallelFor);
  }
  // Cells that a point touches are not always cells around it: then the coarse ones will do.
  const CellSurface surface = MakeCellSurface(HoldsOne(cells, outside) ? coarse : cells);
  DeformableSurface start{ BuildContourMesh(static_cast<int>(surface.Points.rows()), surface.Faces),
    surface.Points };
  RequireOutside(start, outside);
  return start;
}

} // namespace FlipFree
