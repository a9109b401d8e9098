/**
 * The seed sphere, and the part of an image that a surface grown from it can reach: all later work
 * is done on that box alone, so that its cost follows the organ and not the volume.
 */
#ifndef FlipFreeSeedRegion_h
#define FlipFreeSeedRegion_h

#include "Image/VoxelBox.h"
#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

struct SeedSphere
{
  Eigen::Vector3d Center = Eigen::Vector3d::Zero(); ///< millimeters
  double Radius = 10;                               ///< millimeters
};

/// Gray values or features on a grid of their own.
struct FloatImage
{
  ImageGeometry Geometry;
  std::vector<float> Voxels;

  ImageView<float> View() const { return { this->Voxels.data(), this->Geometry }; }
};

/// First and last voxel on each axis.
using Extent = std::array<int, 6>;

/// The box of voxels that holds all within `reach` millimeters of a point, whatever the angles
/// between the image's axes. Never empty: of a point outside it holds the rim that is next to it.
Extent ReachableExtent(const ImageGeometry& geometry, const Eigen::Vector3d& center, double reach);

/// The geometry of that part of the image.
ImageGeometry CropGeometry(const ImageGeometry& geometry, const Extent& extent);
ImageGeometry CropGeometry(const ImageGeometry& geometry, const VoxelBox& box);

/// A part of the image as floats. The memory that `region` has is used again.
template <typename T>
void CropToFloat(const ImageView<T>& image, const Extent& extent, const ParallelFor& parallelFor,
  FloatImage& region)
{
  region.Geometry = CropGeometry(image.Geometry, extent);
  region.Voxels.resize(region.Geometry.NumberOfVoxels());
  parallelFor(0, region.Geometry.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < region.Geometry.Dimensions[1]; ++j)
        {
          const T* from = &image(extent[0], extent[2] + j, extent[4] + k);
          float* to = region.Voxels.data() + region.Geometry.Offset(0, j, k);
          for (int i = 0; i < region.Geometry.Dimensions[0]; ++i)
          {
            to[i] = static_cast<float>(from[i]);
          }
        }
      }
    });
}

/// Whether the image, to the rims of its outermost voxels, holds the whole sphere.
bool ContainsSphere(const ImageGeometry& geometry, const SeedSphere& seed);

/// Offsets of the voxels whose centers lie in the sphere, ascending.
std::vector<std::size_t> VoxelsInSphere(const ImageGeometry& geometry, const SeedSphere& seed);

/// The standard deviation of the noise: from the median absolute difference of neighbors within
/// the sphere, which structures larger than a voxel hardly touch. Not negative. Neighbors are
/// those along the finest axis; of several as fine the one with the least differences counts, since
/// structure can only add to them, and the order in which axes are stored does not matter.
double NoiseStandardDeviation(const ImageView<float>& image, const SeedSphere& seed);

} // namespace FlipFree

#endif
