/**
 * Private to the modules, never installed: a vtkImageData as the label map that kernels read, and
 * the voxels inside a surface as a label map.
 */
#ifndef FlipFreeLabelAdapter_h
#define FlipFreeLabelAdapter_h

#include "Error.h"
#include "ExecutionAdapter.h"
#include "Image/LabelValues.h"
#include "ImageAdapter.h"
#include "Mesh/SurfaceVoxelization.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

namespace FlipFree
{

/// Throws Error, naming the image by `name`, when it has no voxels or no proper grid, or no scalars
/// of one component.
inline void RequireLabelMap(vtkImageData* image, const std::string& name)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (image->GetNumberOfPoints() == 0)
  {
    throw Error(ErrorCode::InvalidGeometry, name + " has no voxels; connect a label map");
  }
  if (!scalars || scalars->GetNumberOfComponents() != 1 ||
    scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw Error(ErrorCode::InvalidInput,
      name + " has no scalars of one component per voxel; make its label array the active scalars");
  }
  RequireProperGrid(image, name);
}

/// The image, named by `name`, as the label map that kernels read. It outlives the volume. Throws
/// Error as RequireLabelMap() does, and when the scalars are bits.
inline LabelVolume LabelVolumeOf(vtkImageData* image, const std::string& name)
{
  RequireLabelMap(image, name);
  return VisitVoxels(image, name,
    [&name](const auto& view) { return LabelVolumeOf(view, name, SMPThreading()); });
}

/// Makes `labelMap` a label map with the geometry of `image`: scalars `Labels`, unsigned char, the
/// label in the runs' voxels and 0 in all others.
inline void MakeLabelMap(const std::vector<VoxelRun>& runs, unsigned char label,
  vtkImageData* image, vtkImageData* labelMap)
{
  // The system provides large blocks cleared, page by page on first use; most of a volume is never
  // touched.
  const auto size = static_cast<std::size_t>(image->GetNumberOfPoints());
  auto* const voxels = static_cast<unsigned char*>(std::calloc(std::max<std::size_t>(size, 1), 1));
  if (!voxels)
  {
    throw std::bad_alloc();
  }
  vtkNew<vtkUnsignedCharArray> labels;
  labels->SetName("Labels");
  labels->SetArray(voxels, image->GetNumberOfPoints(), 0,
    vtkUnsignedCharArray::VTK_DATA_ARRAY_FREE);
  FillRuns(runs, label, GeometryOf(image), voxels);
  labelMap->CopyStructure(image);
  labelMap->GetPointData()->SetScalars(labels);
}

/// Makes `map` an image of the box of a grid that holds the voxels of the runs, of which there are
/// some: unsigned char scalars called `name`, 1 in these voxels and 0 in all others.
inline void MakeCroppedMap(const std::vector<VoxelRun>& runs, const char* name,
  const ImageGeometry& grid, vtkImageData* map)
{
  VoxelBox box;
  for (const VoxelRun& run : runs)
  {
    box = box.Joined({ { run.Begin, run.J, run.K }, { run.End, run.J + 1, run.K + 1 } });
  }
  SetGeometry(map, CropGeometry(grid, box));
  map->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* const voxels = static_cast<unsigned char*>(map->GetScalarPointer());
  std::fill_n(voxels, map->GetNumberOfPoints(), static_cast<unsigned char>(0));
  std::vector<VoxelRun> within = runs;
  for (VoxelRun& run : within)
  {
    run = { run.J - box.Begin[1], run.K - box.Begin[2], run.Begin - box.Begin[0],
      run.End - box.Begin[0] };
  }
  FillRuns(within, static_cast<unsigned char>(1), GeometryOf(map), voxels);
  map->GetPointData()->GetScalars()->SetName(name);
}

} // namespace FlipFree

#endif
