/**
 * Masks and images of shapes that are given by their points, for the tests of carving.
 */
#ifndef ExampleVolumes_h
#define ExampleVolumes_h

#include "ExampleMasks.h"
#include "Image/GaussianSmoothing.h"
#include "Image/SeedRegion.h"

#include <functional>
#include <random>

namespace FlipFree
{

using Shape = std::function<bool(const Eigen::Vector3d&)>;

inline Shape BallShape(const Eigen::Vector3d& center, double radius)
{
  return [=](const Eigen::Vector3d& point) { return (point - center).norm() < radius; };
}

inline BitMask MaskOf(const ImageGeometry& geometry, const Shape& shape)
{
  BitMask mask(geometry);
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      if (shape(geometry.ToPhysical(Eigen::Vector3d(i, j, k))))
      {
        mask.Insert(i, j, k);
      }
    });
  return mask;
}

/// `inside` in the shape, `outside` around it, blurred by a Gaussian.
inline FloatImage ImageOf(const ImageGeometry& geometry, const Shape& shape, float inside,
  float outside, double blur, double noise)
{
  FloatImage image{ geometry, {} };
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      const bool is = shape(geometry.ToPhysical(Eigen::Vector3d(i, j, k)));
      image.Voxels.push_back(is ? inside - outside : 0);
    });
  if (blur > 0)
  {
    SmoothGaussian(image.Voxels, geometry, blur, SerialFor);
  }
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, noise);
  for (float& voxel : image.Voxels)
  {
    voxel += outside + static_cast<float>(normal(random));
  }
  return image;
}

} // namespace FlipFree

#endif
