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

struct FieldBox
{
  Eigen::Array3i Low;
  Eigen::Array3i High;
};

FieldBox PositiveBox(const ImageView<float>& field)
{
  const auto& size = field.Geometry.Dimensions;
  FieldBox box{ Eigen::Array3i(size[0], size[1], size[2]), Eigen::Array3i(-1, -1, -1) };
  for (const VoxelRun& run : RunsOfField(field, { { 0, 0, 0 } }))
  {
    box.Low = box.Low.min(Eigen::Array3i(run.Begin, run.J, run.K));
    box.High = box.High.max(Eigen::Array3i(run.End - 1, run.J, run.K));
  }
  return box;
}

// The box and a rim of one voxel, which closes the surface where the grid ends. Points are indices.
// No value is zero: a contour through voxel centers would have triangles without area.
vtkSmartPointer<vtkImageData> CropAndPad(const ImageView<float>& field, const FieldBox& box)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(box.Low[0] - 1, box.High[0] + 1, box.Low[1] - 1, box.High[1] + 1, box.Low[2] - 1,
    box.High[2] + 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* voxel = static_cast<float*>(image->GetScalarPointer());
  for (int k = box.Low[2] - 1; k <= box.High[2] + 1; ++k)
  {
    for (int j = box.Low[1] - 1; j <= box.High[1] + 1; ++j)
    {
      for (int i = box.Low[0] - 1; i <= box.High[0] + 1; ++i, ++voxel)
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
  const FieldBox box = PositiveBox(field);
  if (box.High[0] < 0)
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
      const auto isInside = [](float value) { return value > 0; };
      for (const float* from = std::find_if(row, end, isInside); from != end;)
      {
        const float* const to = std::find_if_not(from, end, isInside);
        runs.push_back({ first[1] + j, first[2] + k, first[0] + static_cast<int>(from - row),
          first[0] + static_cast<int>(to - row) });
        from = std::find_if(to, end, isInside);
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
