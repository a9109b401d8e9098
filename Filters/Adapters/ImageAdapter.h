/**
 * Private to the modules, never installed: a vtkImageData as the voxel grid that kernels know.
 */
#ifndef FlipFreeImageAdapter_h
#define FlipFreeImageAdapter_h

#include "KernelTypes.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"

namespace FlipFree
{

/// The geometry of an image; the extent may start anywhere, Origin is that of its first voxel.
inline ImageGeometry GeometryOf(vtkImageData* image)
{
  ImageGeometry geometry;
  int extent[6];
  image->GetExtent(extent);
  image->GetDimensions(geometry.Dimensions.data());
  image->GetSpacing(geometry.Spacing.data());
  const double* direction = image->GetDirectionMatrix()->GetData();
  geometry.Direction = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(direction);
  image->TransformContinuousIndexToPhysicalPoint(extent[0], extent[2], extent[4],
    geometry.Origin.data());
  return geometry;
}

/// Gives an image a geometry; the extent starts at zero. Scalars are not allocated.
inline void SetGeometry(vtkImageData* image, const ImageGeometry& geometry)
{
  image->SetDimensions(geometry.Dimensions.data());
  image->SetSpacing(geometry.Spacing.data());
  image->SetOrigin(geometry.Origin.data());
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> direction = geometry.Direction;
  image->SetDirectionMatrix(direction.data());
}

/// The scalars of an image of type T, without a copy; the caller has checked type and components.
template <typename T>
ImageView<T> ViewOf(vtkImageData* image)
{
  return { static_cast<const T*>(image->GetScalarPointer()), GeometryOf(image) };
}

} // namespace FlipFree

#endif
