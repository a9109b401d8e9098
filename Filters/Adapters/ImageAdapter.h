/**
 * Private to the modules, never installed: a vtkImageData as the voxel grid that kernels know.
 */
#ifndef FlipFreeImageAdapter_h
#define FlipFreeImageAdapter_h

#include "Error.h"
#include "Image/GridCheck.h"
#include "Image/VoxelBox.h"
#include "MessageText.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkSetGet.h"

#include <array>
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
  geometry.Direction = Eigen::Map<const RowMajorMatrix>(direction);
  image->TransformContinuousIndexToPhysicalPoint(extent[0], extent[2], extent[4],
    geometry.Origin.data());
  return geometry;
}

/// An extent as a box counted from the first voxel of the image with the extent `whole`.
inline VoxelBox BoxOf(const int* extent, const int* whole)
{
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.Begin[axis] = extent[2 * axis] - whole[2 * axis];
    box.End[axis] = extent[2 * axis + 1] + 1 - whole[2 * axis];
  }
  return box;
}

/// And back.
inline std::array<int, 6> ExtentOf(const VoxelBox& box, const int* whole)
{
  return { { whole[0] + box.Begin[0], whole[0] + box.End[0] - 1, whole[2] + box.Begin[1],
    whole[2] + box.End[1] - 1, whole[4] + box.Begin[2], whole[4] + box.End[2] - 1 } };
}

/// RequireProperGrid() of the image's geometry.
inline void RequireProperGrid(vtkImageData* image, const std::string& name)
{
  RequireProperGrid(GeometryOf(image), name);
}

/// For the types that vtkTemplateMacro has no case for: bits. Throws Error, naming the array, its
/// type, and the image by `name`.
[[noreturn]] inline void RefuseScalarType(vtkDataArray* scalars, const std::string& name)
{
  throw Error(ErrorCode::InvalidInput,
    "the scalars " + Quoted(scalars->GetName() ? scalars->GetName() : "") + " of " + name +
      " are of type " + scalars->GetDataTypeAsString() +
      "; copy them into an array of another, as unsigned char");
}

/// Returns visit(view) for the scalars of an image, one component each, as an ImageView of their
/// own type.
template <typename Visit>
auto VisitVoxels(vtkImageData* image, const std::string& name, const Visit& visit)
{
  vtkDataArray* const scalars = image->GetPointData()->GetScalars();
  const void* const voxels = scalars->GetVoidPointer(0);
  const ImageGeometry geometry = GeometryOf(image);
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro(
      return visit(ImageView<VTK_TT>{ static_cast<const VTK_TT*>(voxels), geometry }));
    default:
      RefuseScalarType(scalars, name);
  }
}

/// Gives an image a geometry; the extent starts at zero. Scalars are not allocated.
inline void SetGeometry(vtkImageData* image, const ImageGeometry& geometry)
{
  image->SetDimensions(geometry.Dimensions.data());
  image->SetSpacing(geometry.Spacing.data());
  image->SetOrigin(geometry.Origin.data());
  const RowMajorMatrix direction = geometry.Direction;
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
