#include "LabelSurface/LabelColumns.h"

namespace FlipFree
{

const std::vector<TableColumn<LabelMeasures>>& LabelColumns()
{
  using Measures = const LabelMeasures&;
  static const std::vector<TableColumn<LabelMeasures>> columns{
    { "Label", true, [](Measures m) -> double { return m.Label; } },
    { "Milliliters", false, [](Measures m) { return m.Volume / 1000; } },
    { "Voxels", true, [](Measures m) { return static_cast<double>(m.Voxels); } },
    { "VoxelMilliliters", false, [](Measures m) { return m.VoxelVolume / 1000; } },
    { "WrongVoxels", true, [](Measures m) { return static_cast<double>(m.WrongVoxels); } },
    { "Area", false, [](Measures m) { return m.Area; } },
    { "EulerNumber", true, [](Measures m) -> double { return m.EulerNumber; } },
    { "Triangles", true, [](Measures m) -> double { return m.Triangles; } },
  };
  return columns;
}

} // namespace FlipFree
