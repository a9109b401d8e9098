/**
 * Private to the modules, never installed: a vtkImageData of any scalar type as the gray image that
 * kernels smooth and search, with the checks that all filters make of it.
 */
#ifndef FlipFreeGrayImageAdapter_h
#define FlipFreeGrayImageAdapter_h

#include "ExecutionAdapter.h"
#include "FiniteVoxels.h"
#include "Image/AnisotropicDiffusion.h"
#include "Image/SeedRegion.h"
#include "ImageAdapter.h"
#include "MessageText.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkSetGet.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace FlipFree
{

/// Throws std::invalid_argument, naming the image by `name`, unless it has voxels on a proper grid,
/// and scalars of one component for each of them.
inline void RequireGrayImage(vtkImageData* image, const std::string& name)
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

/// Throws std::invalid_argument unless the center lies within the image and the radius is a voxel
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
      throw std::invalid_argument("the seed's center " + TextOf(seed.Center) + " mm lies outside " +
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

/// Throws std::invalid_argument, naming the first bad voxel, unless all of a part of the image,
/// which has passed RequireGrayImage, are finite as floats. Whole numbers are not looked at.
/// Returns false if the monitor, asked every few slices, stopped it.
inline bool RequireFinite(vtkImageData* image, const Extent& extent, const std::string& name,
  const Monitor& monitor = NeverStop)
{
  const ImageGeometry geometry = GeometryOf(image);
  const void* voxels = image->GetPointData()->GetScalars()->GetVoidPointer(0);
  switch (image->GetPointData()->GetScalars()->GetDataType())
  {
    vtkTemplateMacro(return RequireFiniteAs<float>(
      ImageView<VTK_TT>{ static_cast<const VTK_TT*>(voxels), geometry }, extent, name,
      "replace such voxels first", monitor));
    default:
      RefuseScalarType(image->GetPointData()->GetScalars(), name);
  }
}

/// A part of the image as floats, in memory that is used again. The image has passed
/// RequireGrayImage.
inline void GrayRegionOf(vtkImageData* image, const Extent& extent, FloatImage& region)
{
  const ImageGeometry geometry = GeometryOf(image);
  const void* voxels = image->GetPointData()->GetScalars()->GetVoidPointer(0);
  switch (image->GetPointData()->GetScalars()->GetDataType())
  {
    vtkTemplateMacro(CropToFloat<VTK_TT>({ static_cast<const VTK_TT*>(voxels), geometry }, extent,
      SMPFor, region));
    default:
      RefuseScalarType(image->GetPointData()->GetScalars(), "the image");
  }
}

/// The whole image as floats: its own where it has floats, and else those of `copy`, which must
/// outlive the view. The image has passed RequireGrayImage.
inline ImageView<float> GrayViewOf(vtkImageData* image, FloatImage& copy)
{
  const ImageGeometry geometry = GeometryOf(image);
  if (image->GetPointData()->GetScalars()->GetDataType() == VTK_FLOAT)
  {
    const void* const voxels = image->GetPointData()->GetScalars()->GetVoidPointer(0);
    return { static_cast<const float*>(voxels), geometry };
  }
  GrayRegionOf(image, WholeExtent(geometry), copy);
  return copy.View();
}

/// The noise in the seed sphere.
inline double NoiseOf(vtkImageData* image, const SeedSphere& seed)
{
  FloatImage region;
  GrayRegionOf(image, ReachableExtent(GeometryOf(image), seed.Center, seed.Radius), region);
  return NoiseStandardDeviation(region.View(), seed);
}

/// The voxels of a part of the image, which has passed RequireGrayImage and outlives the reader.
inline VoxelReader GrayReaderOf(vtkImageData* image, const Extent& extent)
{
  const ImageGeometry geometry = GeometryOf(image);
  const void* voxels = image->GetPointData()->GetScalars()->GetVoidPointer(0);
  switch (image->GetPointData()->GetScalars()->GetDataType())
  {
    vtkTemplateMacro(return ReaderOf<VTK_TT>({ static_cast<const VTK_TT*>(voxels), geometry },
      { { extent[0], extent[2], extent[4] } }));
    default:
      RefuseScalarType(image->GetPointData()->GetScalars(), "the image");
  }
}

/// Smooths a part of the image, which is not copied before. Returns false if the monitor stopped
/// it.
inline bool SmoothRegionOf(vtkImageData* image, const Extent& extent,
  AnisotropicDiffusionSettings settings, const Monitor& monitor, FloatImage& region)
{
  settings.Threads = NumberOfThreads();
  region.Geometry = CropGeometry(GeometryOf(image), extent);
  region.Voxels.resize(region.Geometry.NumberOfVoxels());
  return DiffuseAnisotropically(GrayReaderOf(image, extent), region.Geometry, settings, SMPFor,
    monitor, region.Voxels.data());
}

} // namespace FlipFree

#endif
