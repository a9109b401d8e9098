/**
 * Private to the modules, never installed: a vtkImageData of any scalar type as the grey image that
 * kernels smooth and search, with the checks that all filters make of it.
 */
#ifndef FlipFreeGreyImageAdapter_h
#define FlipFreeGreyImageAdapter_h

#include "ExecutionAdapter.h"
#include "ImageAdapter.h"
#include "MessageText.h"
#include "SeedRegion.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkSetGet.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace FlipFree
{

/// Throws std::invalid_argument, naming the image by `name`, unless it has voxels on a proper grid,
/// and scalars of one component for each of them.
inline void RequireGreyImage(vtkImageData* image, const std::string& name)
{
  if (!image || image->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument(name + " has no voxels; connect an image");
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (!scalars)
  {
    throw std::invalid_argument(
      name + " has no point scalars; make the array of its intensities the active scalars");
  }
  if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw std::invalid_argument(name + " has " + std::to_string(scalars->GetNumberOfTuples()) +
      " scalars for " + std::to_string(image->GetNumberOfPoints()) +
      " voxels; give it one for each");
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(name + " has " + std::to_string(scalars->GetNumberOfComponents()) +
      " components per voxel; extract one of them by vtkImageExtractComponents");
  }
  if (scalars->GetDataType() == VTK_BIT)
  {
    RefuseScalarType(scalars, name);
  }
  RequireProperGrid(image, name);
}

/// Throws std::invalid_argument unless the centre lies within the image and the radius is a voxel
/// or more.
inline void RequireSeed(const ImageGeometry& geometry, const SeedSphere& seed,
  const std::string& name)
{
  const Eigen::Vector3d index = geometry.ToIndex(seed.Center);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(index[axis] >= -0.5 && index[axis] <= geometry.Dimensions[axis] - 0.5))
    {
      const Eigen::Vector3d first = geometry.ToPhysical(Eigen::Vector3d::Zero());
      const Eigen::Vector3d last = geometry.ToPhysical(Eigen::Vector3d(geometry.Dimensions[0] - 1,
        geometry.Dimensions[1] - 1, geometry.Dimensions[2] - 1));
      throw std::invalid_argument("the seed's centre " + TextOf(seed.Center) + " mm lies outside " +
        name + ", which reaches from " + TextOf(first) + " to " + TextOf(last) +
        " mm; give it in the image's physical coordinates");
    }
  }
  if (!(seed.Radius >= geometry.Spacing.minCoeff()))
  {
    std::ostringstream message;
    message << "the seed's radius of " << seed.Radius << " mm is below a voxel of " << name << " ("
            << geometry.Spacing.minCoeff() << " mm); enlarge it";
    throw std::invalid_argument(message.str());
  }
}

/// Throws std::invalid_argument, naming the first bad voxel, unless all are finite numbers.
inline void RequireFinite(const FloatImage& image, const std::string& name)
{
  for (std::size_t voxel = 0; voxel < image.Voxels.size(); ++voxel)
  {
    if (!std::isfinite(image.Voxels[voxel]))
    {
      const std::size_t row = image.Geometry.Dimensions[0];
      const std::size_t rows = image.Geometry.Dimensions[1];
      const Eigen::Matrix<std::size_t, 3, 1> index(voxel % row, voxel / row % rows,
        voxel / row / rows);
      throw std::invalid_argument("a voxel of " + name + ", at " +
        TextOf(image.Geometry.ToPhysical(index.cast<double>())) +
        " mm, is not a finite number; replace such voxels first");
    }
  }
}

/// A part of the image as floats. The image has passed RequireGreyImage.
inline FloatImage GreyRegionOf(vtkImageData* image, const Extent& extent)
{
  const ImageGeometry geometry = GeometryOf(image);
  FloatImage region;
  void* voxels = image->GetPointData()->GetScalars()->GetVoidPointer(0);
  switch (image->GetPointData()->GetScalars()->GetDataType())
  {
    vtkTemplateMacro(region = CropToFloat<VTK_TT>({ static_cast<const VTK_TT*>(voxels), geometry },
                       extent, SMPFor));
    default:
      RefuseScalarType(image->GetPointData()->GetScalars(), "the image");
  }
  return region;
}

inline Extent WholeExtent(const ImageGeometry& geometry)
{
  return { { 0, geometry.Dimensions[0] - 1, 0, geometry.Dimensions[1] - 1, 0,
    geometry.Dimensions[2] - 1 } };
}

} // namespace FlipFree

#endif
