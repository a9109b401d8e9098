/**
 * Surfaces and images that tests of filters share.
 */
#ifndef FlipFreeExamplePolyData_h
#define FlipFreeExamplePolyData_h

#include "../Kernels/ExampleSurfaces.h"

#include "ImageAdapter.h"
#include "Mesh/SurfaceTopology.h"
#include "MeshAdapter.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

namespace FlipFree
{

inline vtkSmartPointer<vtkPolyData> PolyDataOf(const PointList& points, const FaceList& faces)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(MakePoints(points));
  data->SetPolys(MakePolys(faces));
  return data;
}

inline vtkSmartPointer<vtkPolyData> PolyDataOf(const Surface& surface)
{
  return PolyDataOf(surface.Points, FacesOf(surface.Triangles));
}

/// An image without scalars, centered on a point, whose extent does not start at 0.
inline vtkSmartPointer<vtkImageData> ImageAround(const Eigen::Vector3d& center,
  const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  const Eigen::Matrix3d& direction)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(-3, dimensions[0] - 4, 5, dimensions[1] + 4, 2, dimensions[2] + 1);
  image->SetSpacing(spacing.data());
  const RowMajorMatrix rows = direction;
  image->SetDirectionMatrix(rows.data());
  const Eigen::Vector3d middle(-3 + (dimensions[0] - 1) / 2.0, 5 + (dimensions[1] - 1) / 2.0,
    2 + (dimensions[2] - 1) / 2.0);
  const Eigen::Vector3d origin = center - direction * spacing.cwiseProduct(middle);
  image->SetOrigin(origin.data());
  return image;
}

} // namespace FlipFree

#endif
