#include "LabelSurface.h"

#include "MeshAdapter.h"

#include "vtkDiscreteFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkWindowedSincPolyDataFilter.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// The bounding box of the mask with a margin of zeros, which closes the surface; points are voxel
// indices.
vtkSmartPointer<vtkImageData> CropAndPad(const BitMask& mask)
{
  const auto [low, end] = mask.Bounds();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(low[0] - 1, end[0], low[1] - 1, end[1], low[2] - 1, end[2]);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* const padded = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(padded, image->GetNumberOfPoints(), static_cast<unsigned char>(0));
  mask.ForEachRun(low[2], end[2],
    [&image](int first, int last, int j, int k)
    {
      std::fill_n(static_cast<unsigned char*>(image->GetScalarPointer(first, j, k)), last - first,
        static_cast<unsigned char>(1));
    });
  return image;
}

} // namespace

LabelSurface SurfaceOf(const BitMask& mask, int smoothingIterations)
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

  // Contouring and (linear) smoothing work in index space, where single precision is sufficient.
  // Versions of VTK treat direction matrices differently.
  LabelSurface surface;
  surface.Points = CopyPoints(contours);
  surface.Triangles = Triangulate(CopyPolys(contours, "the surface of a label"));
  const ImageGeometry& geometry = mask.GetGeometry();
  const Eigen::Matrix3d toPhysical = geometry.Direction * geometry.Spacing.asDiagonal();
  surface.Points =
    ((surface.Points * toPhysical.transpose()).rowwise() + geometry.Origin.transpose()).eval();
  if (toPhysical.determinant() < 0)
  {
    surface.Triangles.col(1).swap(surface.Triangles.col(2));
  }
  return surface;
}

} // namespace FlipFree
