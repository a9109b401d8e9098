/**
 * Private to the modules, never installed: a vtkImageData as the voxel grid that kernels know.
 */
#ifndef FlipFreeImageAdapter_h
#define FlipFreeImageAdapter_h

#include "KernelTypes.h"
#include "MessageText.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"

#include <cmath>
#include <stdexcept>
#include <string>

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

/// Throws std::invalid_argument, naming the image by `name`, unless its voxels lie apart on three
/// independent axes.
inline void RequireProperGrid(vtkImageData* image, const std::string& name)
{
  const ImageGeometry geometry = GeometryOf(image);
  if (!(geometry.Spacing.minCoeff() > 0) || !geometry.Spacing.allFinite())
  {
    throw std::invalid_argument(name + " has a spacing of " + TextOf(geometry.Spacing) +
      " mm; make it positive on every axis, and turn axes by the direction matrix");
  }
  if (!(std::abs(geometry.Direction.determinant()) > 1e-6) || !geometry.Direction.allFinite() ||
    !geometry.Origin.allFinite())
  {
    throw std::invalid_argument(name +
      " has a direction matrix that cannot be inverted, or an origin that is not finite; correct "
      "them");
  }
}

/// For the types that vtkTemplateMacro has no case for: bits. Throws std::invalid_argument, naming
/// the array, its type, and the image by `name`.
[[noreturn]] inline void RefuseScalarType(vtkDataArray* scalars, const std::string& name)
{
  throw std::invalid_argument("the scalars '" +
    std::string(scalars->GetName() ? scalars->GetName() : "") + "' of " + name + " are of type " +
    scalars->GetDataTypeAsString() + "; copy them into an array of another, as unsigned char");
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
