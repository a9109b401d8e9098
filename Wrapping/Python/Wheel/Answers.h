/**
 * What segmentations of organs and of vessels, and measures of them, have in common on their way
 * from and to Python.
 */
#ifndef FlipFreeAnswers_h
#define FlipFreeAnswers_h

#include "Numpy.h"

#include "Deformation/VolumeSegmentation.h"
#include "Image/LabelValues.h"
#include "Mesh/SurfaceVoxelization.h"
#include "TableColumn.h"

#include <string>
#include <tuple>
#include <vector>

namespace FlipFree
{

/// How messages call the volume.
inline const char* const ImageName = "the image";

/// The volume as runs read it; numpy's array outlives them.
GrayVolume GrayVolumeOf(const Voxels& voxels, const ImageGeometry& geometry);

/// A label map as it comes: voxels, spacing, origin and direction.
using LabelMap = std::tuple<Voxels, Triple, Triple, Nine>;

/// The same as kernels read it; numpy's array outlives them.
LabelVolume LabelVolumeOf(const LabelMap& labels, const std::string& name);

/// A surface: points, corners, offsets, displacements, correspondence.
nb::dict SurfaceDict(FaceList faces, PointList points, CorrespondenceField field);

/// The columns of a table by their names.
template <typename Record>
nb::dict ColumnsOf(const std::vector<TableColumn<Record>>& columns,
  const std::vector<Record>& records)
{
  nb::dict table;
  for (const TableColumn<Record>& column : columns)
  {
    const auto read = [&](auto zero)
    {
      std::vector<decltype(zero)> values;
      for (const Record& record : records)
      {
        values.push_back(static_cast<decltype(zero)>(column.Read(record)));
      }
      return ArrayOf<decltype(zero)>(std::move(values), { records.size() });
    };
    table[column.Name] = column.IsCount ? read(int()) : read(double());
  }
  return table;
}

/// The convergence table.
nb::dict ColumnsOf(const std::vector<IterationRecord>& records);

/// The label map: an array [k, j, i].
nb::object LabelsOf(const std::vector<VoxelRun>& runs, int label, const ImageGeometry& geometry);
/// The same of several organs, with consecutive labels.
nb::object LabelsOf(const std::vector<std::vector<VoxelRun>>& organs, int first,
  const ImageGeometry& geometry);

} // namespace FlipFree

#endif
