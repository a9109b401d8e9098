/**
 * Private to the modules, never installed: one label of a label map as the mask that kernels
 * measure, and the voxels inside a surface as a label map.
 */
#ifndef FlipFreeLabelAdapter_h
#define FlipFreeLabelAdapter_h

#include "ImageAdapter.h"
#include "SurfaceVoxelisation.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace FlipFree
{

struct LabelMask
{
  std::vector<unsigned char> Voxels; ///< 1 inside, 0 outside
  ImageGeometry Geometry;

  ImageView<unsigned char> View() const { return { this->Voxels.data(), this->Geometry }; }
};

/// The voxels with a label, or all that are not 0 for a negative one. Throws std::invalid_argument,
/// naming the image by `name`, when it has no voxels or no proper grid, no scalars of one
/// component, scalars of bits, or a voxel that is not a finite number.
inline LabelMask MaskOf(vtkImageData* image, int label, const std::string& name)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (image->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument(name + " has no voxels; connect a label map");
  }
  if (!scalars || scalars->GetNumberOfComponents() != 1 ||
    scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw std::invalid_argument(
      name + " has no scalars of one component per voxel; make its label array the active scalars");
  }
  RequireProperGrid(image, name);
  LabelMask mask;
  mask.Geometry = GeometryOf(image);
  mask.Voxels.resize(mask.Geometry.NumberOfVoxels());
  const auto select = [&](auto* values)
  {
    for (std::size_t voxel = 0; voxel < mask.Voxels.size(); ++voxel)
    {
      const double value = static_cast<double>(values[voxel]);
      if (!std::isfinite(value))
      {
        throw std::invalid_argument("voxel " + std::to_string(voxel) + " of " + name +
          " is not a finite number; a label map holds whole numbers");
      }
      mask.Voxels[voxel] = label < 0 ? value != 0 : value == label;
    }
  };
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro(select(static_cast<VTK_TT*>(scalars->GetVoidPointer(0))));
    default:
      RefuseScalarType(scalars, name);
  }
  return mask;
}

/// Makes `labelMap` a label map with the geometry of `image`: scalars `Labels`, unsigned char, the
/// label in the runs' voxels and 0 in all others.
inline void MakeLabelMap(const std::vector<VoxelRun>& runs, unsigned char label,
  vtkImageData* image, vtkImageData* labelMap)
{
  vtkNew<vtkUnsignedCharArray> labels;
  labels->SetName("Labels");
  labels->SetNumberOfValues(image->GetNumberOfPoints());
  labels->FillValue(0);
  FillRuns(runs, label, GeometryOf(image), labels->GetPointer(0));
  labelMap->CopyStructure(image);
  labelMap->GetPointData()->SetScalars(labels);
}

} // namespace FlipFree

#endif
