#include "FieldSurface.h"

#include "Mesh/SurfaceTopology.h"
#include "MeshAdapter.h"

#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

bool IsPositive(float value)
{
  return value > 0;
}

// The box and a rim of one voxel, which closes the surface where the grid ends. Points are indices.
// No value is zero: a contour through voxel centers would have triangles without area.
vtkSmartPointer<vtkImageData> CropAndPad(const ImageView<float>& field, const VoxelBox& box)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(box.Begin[0] - 1, box.End[0], box.Begin[1] - 1, box.End[1], box.Begin[2] - 1,
    box.End[2]);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* voxel = static_cast<float*>(image->GetScalarPointer());
  for (int k = box.Begin[2] - 1; k <= box.End[2]; ++k)
  {
    for (int j = box.Begin[1] - 1; j <= box.End[1]; ++j)
    {
      for (int i = box.Begin[0] - 1; i <= box.End[0]; ++i, ++voxel)
      {
        const float value = field.Geometry.Contains(i, j, k) ? field(i, j, k) : -1.0F;
        *voxel = value > 0 ? std::max(value, 1e-3F) : std::min(value, -1e-3F);
      }
    }
  }
  return image;
}

} // namespace

FieldSurface SurfaceOfField(const ImageView<float>& field)
{
  FieldSurface surface;
  const VoxelBox box = VoxelsWhere(field, IsPositive, SerialFor).Bounds();
  if (box.IsEmpty())
  {
    return surface;
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(CropAndPad(field, box));
  contour->SetValue(0, 0);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();

  // Contoured in index space, and moved here: versions of VTK differ in what they make of direction
  // matrices.
  surface.Points = CopyPoints(contour->GetOutput());
  surface.Triangles = Triangulate(CopyPolys(contour->GetOutput(), "the contour"));
  const Eigen::Matrix3d toPhysical = field.Geometry.Direction * field.Geometry.Spacing.asDiagonal();
  surface.Points =
    ((surface.Points * toPhysical.transpose()).rowwise() + field.Geometry.Origin.transpose())
      .eval();
  if (toPhysical.determinant() < 0)
  {
    surface.Triangles.col(1).swap(surface.Triangles.col(2));
  }
  return surface;
}

std::vector<VoxelRun> RunsOfField(const ImageView<float>& field, const std::array<int, 3>& first)
{
  std::vector<VoxelRun> runs;
  const auto& size = field.Geometry.Dimensions;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      const float* row = field.Data + field.Geometry.Offset(0, j, k);
      const float* const end = row + size[0];
      for (const float* from = std::find_if(row, end, IsPositive); from != end;)
      {
        const float* const to = std::find_if_not(from, end, IsPositive);
        runs.push_back({ first[1] + j, first[2] + k, first[0] + static_cast<int>(from - row),
          first[0] + static_cast<int>(to - row) });
        from = std::find_if(to, end, IsPositive);
      }
    }
  }
  return runs;
}

std::vector<float> FieldOfMask(const BitMask& mask)
{
  std::vector<float> field(mask.GetGeometry().NumberOfVoxels(), -1.0F);
  mask.ForEach([&field](std::size_t voxel) { field[voxel] = 1; });
  return field;
}

} // namespace FlipFree
