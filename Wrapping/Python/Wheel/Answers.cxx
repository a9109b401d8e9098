#include "Answers.h"

#include "ThreadPool.h"

#include "Deformation/ConvergenceColumns.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace FlipFree
{

GrayVolume GrayVolumeOf(const Voxels& voxels, const ImageGeometry& geometry)
{
  return VisitVoxels(voxels, geometry, [](const auto& view) { return GrayVolumeOf(view); });
}

LabelVolume LabelVolumeOf(const LabelMap& labels, const std::string& name)
{
  const auto& [voxels, spacing, origin, direction] = labels;
  return VisitVoxels(voxels, GeometryOf(voxels, spacing, origin, direction),
    [&name](const auto& view) { return LabelVolumeOf(view, name, PoolThreading()); });
}

nb::dict SurfaceDict(FaceList faces, PointList points, CorrespondenceField field)
{
  const auto size = static_cast<std::size_t>(points.rows());
  // Of no iteration: nothing is wanted.
  if (field.States.size() != size)
  {
    field.Displacements = PointList::Zero(points.rows(), 3);
    field.States.assign(size, VertexState::Solitary);
  }
  std::vector<std::uint8_t> states(size);
  std::transform(field.States.begin(), field.States.end(), states.begin(),
    [](VertexState state) { return static_cast<std::uint8_t>(state); });
  const std::size_t corners = faces.Connectivity.size();
  const std::size_t offsets = faces.Offsets.size();
  nb::dict surface;
  surface["points"] = ArrayOf<double>(std::move(points), { size, 3 });
  surface["corners"] = ArrayOf<int>(std::move(faces.Connectivity), { corners });
  surface["offsets"] = ArrayOf<int>(std::move(faces.Offsets), { offsets });
  surface["displacements"] = ArrayOf<double>(std::move(field.Displacements), { size, 3 });
  surface["correspondence"] = ArrayOf<std::uint8_t>(std::move(states), { size });
  return surface;
}

nb::dict ColumnsOf(const std::vector<IterationRecord>& records)
{
  return ColumnsOf(ConvergenceColumns(), records);
}

nb::object LabelsOf(const std::vector<VoxelRun>& runs, int label, const ImageGeometry& geometry)
{
  return LabelsOf(std::vector<std::vector<VoxelRun>>{ runs }, label, geometry);
}

nb::object LabelsOf(const std::vector<std::vector<VoxelRun>>& organs, int first,
  const ImageGeometry& geometry)
{
  // The system provides large blocks cleared, page by page on first use; most of a volume is never
  // touched.
  auto* const voxels =
    static_cast<std::uint8_t*>(std::calloc(std::max<std::size_t>(1, geometry.NumberOfVoxels()), 1));
  if (!voxels)
  {
    throw std::bad_alloc();
  }
  const nb::capsule owner(voxels, [](void* p) noexcept { std::free(p); });
  int label = first;
  for (const std::vector<VoxelRun>& runs : organs)
  {
    FillRuns(runs, static_cast<std::uint8_t>(label++), geometry, voxels);
  }
  const auto& size = geometry.Dimensions;
  return nb::cast(nb::ndarray<nb::numpy, std::uint8_t>(voxels,
    { static_cast<std::size_t>(size[2]), static_cast<std::size_t>(size[1]),
      static_cast<std::size_t>(size[0]) },
    owner));
}

} // namespace FlipFree
