/**
 * Private to the modules, never installed: a vtkImageData of any scalar type as the gray image that
 * kernels smooth and search, with the checks common to all filters.
 */
#ifndef FlipFreeGrayImageAdapter_h
#define FlipFreeGrayImageAdapter_h

#include "Deformation/VolumeSegmentation.h"
#include "Error.h"
#include "ExecutionAdapter.h"
#include "Image/AnisotropicDiffusion.h"
#include "Image/FiniteVoxels.h"
#include "Image/SeedRegion.h"
#include "ImageAdapter.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkSetGet.h"

#include <string>

namespace FlipFree
{

/// Throws Error, naming the image by `name`, unless it has voxels on a proper grid, and scalars of
/// one component for each of them.
inline void RequireGrayImage(vtkImageData* image, const std::string& name)
{
  RequireVoxels(image ? GeometryOf(image) : ImageGeometry(), name);
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars)
  {
    throw Error(ErrorCode::InvalidInput,
      name + " has no point scalars; make the array of its intensities the active scalars");
  }
  if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw Error(ErrorCode::InvalidInput,
      name + " has " + std::to_string(scalars->GetNumberOfTuples()) + " scalars for " +
        std::to_string(image->GetNumberOfPoints()) + " voxels; give it one for each");
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    throw Error(ErrorCode::InvalidInput,
      name + " has " + std::to_string(scalars->GetNumberOfComponents()) +
        " components per voxel; extract one of them by vtkImageExtractComponents");
  }
  if (scalars->GetDataType() == VTK_BIT)
  {
    RefuseScalarType(scalars, name);
  }
}

/// RequireFiniteAs floats for an image that has passed RequireGrayImage, where voxels without data
/// (NoData.h) cannot be left out.
inline bool RequireFinite(vtkImageData* image, const VoxelBox& box, const std::string& name,
  const Monitor& monitor = NeverStop)
{
  return VisitVoxels(image, name,
    [&](const auto& view)
    {
      return RequireFiniteAs<float>(view, box, name, "replace such voxels first", SMPThreading(),
        monitor);
    });
}

/// The image, named by `name`, as the volume that a segmentation reads. It has passed
/// RequireGrayImage and outlives the volume.
inline GrayVolume GrayVolumeOf(vtkImageData* image, const std::string& name)
{
  return VisitVoxels(image, name, [](const auto& view) { return GrayVolumeOf(view); });
}

/// A part of the image as floats; reuses the memory of `region`. The image has passed
/// RequireGrayImage.
inline void GrayRegionOf(vtkImageData* image, const VoxelBox& box, FloatImage& region)
{
  VisitVoxels(image, "the image",
    [&](const auto& view) { CropToFloat(view, box, SMPFor, region); });
}

/// The whole image as floats: its own if it has floats, otherwise those of `copy`, which must
/// outlive the view. The image has passed RequireGrayImage.
inline ImageView<float> GrayViewOf(vtkImageData* image, FloatImage& copy)
{
  if (image->GetPointData()->GetScalars()->GetDataType() == VTK_FLOAT)
  {
    return ViewOf<float>(image);
  }
  GrayRegionOf(image, WholeBox(GeometryOf(image)), copy);
  return copy.View();
}

/// The noise in the seed sphere.
inline double NoiseOf(vtkImageData* image, const SeedSphere& seed)
{
  FloatImage region;
  GrayRegionOf(image, BoxAround(GeometryOf(image), seed.Center, seed.Radius), region);
  return NoiseStandardDeviation(region.View(), seed);
}

/// The voxels of a part of the image, which has passed RequireGrayImage and outlives the reader.
inline VoxelReader GrayReaderOf(vtkImageData* image, const VoxelBox& box)
{
  return VisitVoxels(image, "the image",
    [&box](const auto& view) { return ReaderOf(view, box.Begin); });
}

/// Smooths a part of the image, without a copy of it. Returns false if the monitor stopped it.
inline bool SmoothRegionOf(vtkImageData* image, const VoxelBox& box,
  AnisotropicDiffusionSettings settings, const Monitor& monitor, FloatImage& region)
{
  settings.Threads = NumberOfThreads();
  region.Geometry = CropGeometry(GeometryOf(image), box);
  region.Voxels.resize(region.Geometry.NumberOfVoxels());
  return DiffuseAnisotropically(GrayReaderOf(image, box), region.Geometry, settings, SMPFor,
    monitor, region.Voxels.data());
}

} // namespace FlipFree

#endif
