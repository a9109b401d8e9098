/**
 * The seed sphere in an image: its voxels, their noise, and how far they are of one tissue. Work is
 * done on a box around the seed, so that its cost depends on the organ and not on the volume.
 */
#ifndef FlipFreeSeedRegion_h
#define FlipFreeSeedRegion_h

#include "Image/VoxelBox.h"
#include "KernelTypes.h"

#include <string>
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

/// A part of the image as floats. Reuses the memory of `region`.
template <typename T>
void CropToFloat(const ImageView<T>& image, const VoxelBox& box, const ParallelFor& parallelFor,
  FloatImage& region)
{
  region.Geometry = CropGeometry(image.Geometry, box);
  region.Voxels.resize(region.Geometry.NumberOfVoxels());
  parallelFor(0, region.Geometry.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < region.Geometry.Dimensions[1]; ++j)
        {
          const T* from = &image(box.Begin[0], box.Begin[1] + j, box.Begin[2] + k);
          float* to = region.Voxels.data() + region.Geometry.Offset(0, j, k);
          for (int i = 0; i < region.Geometry.Dimensions[0]; ++i)
          {
            to[i] = static_cast<float>(from[i]);
          }
        }
      }
    });
}

/// In millimeters: the radii to which all front ends limit those of seeds.
constexpr double MinimumSeedRadius = 1e-6;
constexpr double MaximumSeedRadius = 1e6;

/// Throws Error unless the center lies within the image, named by `name`, and the sphere is neither
/// smaller than a voxel nor wider than the image's longest side.
void RequireSeed(const ImageGeometry& geometry, const SeedSphere& seed, const std::string& name);

/// Whether the image, up to the outer faces of its outermost voxels, holds the whole sphere.
bool ContainsSphere(const ImageGeometry& geometry, const SeedSphere& seed);

/// Offsets of the voxels whose centers lie in the sphere, ascending.
std::vector<std::size_t> VoxelsInSphere(const ImageGeometry& geometry, const SeedSphere& seed);

/// As VoxelsInSphere; if there are none, the voxel whose center is nearest to the sphere's.
std::vector<std::size_t> VoxelsAround(const ImageGeometry& geometry, const SeedSphere& seed);

/// The standard deviation of the noise, from the median absolute difference of neighbors in the
/// sphere, which structures larger than a voxel hardly affect. Not negative. Neighbors are taken
/// along the finest axis; of several equally fine axes, the one with the smallest differences
/// counts, since structure can only add to them, and the order of the axes must not matter.
double NoiseStandardDeviation(const ImageView<float>& image, const SeedSphere& seed);

/// How many times as much gray values scatter in the sphere as in its inner half: about 1 within
/// one tissue, and infinite where the inner half has one gray value and the sphere others. Zero
/// where the inner half has too few voxels to tell. Neither the unit nor the origin of gray values
/// matters, nor a tenth of the voxels at either end.
double ScatterOverInnerHalf(const ImageView<float>& image, const SeedSphere& seed);

/// The sphere or, while it reaches out of its tissue, smaller ones around its center, until one
/// does not or has too few voxels to tell.
SeedSphere UniformSphere(const ImageView<float>& image, const SeedSphere& seed);

} // namespace FlipFree

#endif
