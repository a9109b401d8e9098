#include "Deformation/LabelStart.h"

#include "LabelSurface/LabelSurfaces.h"
#include "Mesh/SurfaceTopology.h"

namespace FlipFree
{
namespace
{

LabelGrid GridOfMask(const BitMask& mask)
{
  const VoxelBox box = mask.Bounds();
  if (box.IsEmpty())
  {
    throw Error(ErrorCode::EmptyMask,
      "nothing is left of the label to fill; remove outside points, or give another label");
  }
  LabelGrid grid;
  grid.Values = { 0, 1 };
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.First[axis] = box.Begin[axis] - 1;
    grid.Size[axis] = box.End[axis] - box.Begin[axis] + 2;
  }
  grid.Labels.resize(static_cast<std::size_t>(grid.Size[0]) * grid.Size[1] * grid.Size[2]);
  mask.ForEachRun(box.Begin[2], box.End[2],
    [&grid](int begin, int end, int j, int k)
    {
      const auto first = grid.Labels.begin() +
        static_cast<std::ptrdiff_t>(
          grid.Offset(begin - grid.First[0], j - grid.First[1], k - grid.First[2]));
      std::fill(first, first + (end - begin), 1);
    });
  return grid;
}

} // namespace

DeformableSurface SurfaceOfMask(const BitMask& mask, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  LabelSurfaceSettings settings;
  settings.Exact = true;
  const LabelSurfaces surfaces =
    MakeLabelSurfaces(GridOfMask(mask), mask.GetGeometry(), settings, parallelFor, monitor);
  if (!surfaces.Complete)
  {
    return {};
  }
  const SharedWalls& walls = surfaces.Walls;
  return { BuildMeshAtRest(static_cast<int>(walls.Points.rows()), FacesOf(walls.Triangles)),
    walls.Points };
}

} // namespace FlipFree
