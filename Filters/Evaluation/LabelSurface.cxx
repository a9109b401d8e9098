#include "LabelSurface.h"

#include "MeshAdapter.h"

#include "vtkDiscreteFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkWindowedSincPolyDataFilter.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace FlipFree
{
namespace
{

// The part of the mask that is not empty, with a rim of zeros that closes the surface. Its points
// are the mask's voxel indices.
vtkSmartPointer<vtkImageData> CropAndPad(const LabelMask& mask)
{
  const auto& size = mask.Geometry.Dimensions;
  Eigen::Array3i low(size[0], size[1], size[2]);
  Eigen::Array3i high(-1, -1, -1);
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      const unsigned char* const row = mask.Voxels.get() + mask.Geometry.Offset(0, j, k);
      const unsigned char* const end = row + size[0];
      const void* const found = std::memchr(row, 1, size[0]);
      if (found)
      {
        const auto first = static_cast<int>(static_cast<const unsigned char*>(found) - row);
        const auto last = static_cast<int>(
          std::find(std::reverse_iterator(end), std::reverse_iterator(row), 1).base() - row - 1);
        low = low.min(Eigen::Array3i(first, j, k));
        high = high.max(Eigen::Array3i(last, j, k));
      }
    }
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(low[0] - 1, high[0] + 1, low[1] - 1, high[1] + 1, low[2] - 1, high[2] + 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* padded = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(padded, image->GetNumberOfPoints(), 0);
  for (int k = low[2]; k <= high[2]; ++k)
  {
    for (int j = low[1]; j <= high[1]; ++j)
    {
      const unsigned char* row = mask.Voxels.get() + mask.Geometry.Offset(low[0], j, k);
      std::copy_n(row, high[0] - low[0] + 1,
        static_cast<unsigned char*>(image->GetScalarPointer(low[0], j, k)));
    }
  }
  return image;
}

} // namespace

LabelSurface SurfaceOf(const LabelMask& mask, int smoothingIterations)
{
  vtkNew<vtkDiscreteFlyingEdges3D> contour;
  contour->SetInputData(CropAndPad(mask));
  contour->SetValue(0, 1);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkSmartPointer<vtkPolyData> contours = contour->GetOutput();
  if (smoothingIterations > 0)
  {
    vtkNew<vtkWindowedSincPolyDataFilter> smooth;
    smooth->SetInputData(contours);
    smooth->SetNumberOfIterations(smoothingIterations);
    smooth->SetPassBand(0.1);
    smooth->NormalizeCoordinatesOn();
    smooth->FeatureEdgeSmoothingOff();
    smooth->NonManifoldSmoothingOn();
    smooth->Update();
    contours = smooth->GetOutput();
  }

  // Contoured and smoothed in index space (the smoothing is linear, so that this is the same),
  // where single precision does no harm, and moved here: versions of VTK differ in what they make
  // of direction matrices.
  LabelSurface surface;
  surface.Points = CopyPoints(contours);
  surface.Triangles = Triangulate(CopyPolys(contours));
  const Eigen::Matrix3d toPhysical = mask.Geometry.Direction * mask.Geometry.Spacing.asDiagonal();
  surface.Points =
    ((surface.Points * toPhysical.transpose()).rowwise() + mask.Geometry.Origin.transpose()).eval();
  if (toPhysical.determinant() < 0)
  {
    surface.Triangles.col(1).swap(surface.Triangles.col(2));
  }
  return surface;
}

} // namespace FlipFree
