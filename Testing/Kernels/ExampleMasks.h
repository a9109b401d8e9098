/**
 * Masks for the tests, as bytes (0 or 1) and as bits, boxes, and grids of odd sizes; some are about
 * one or two words of a BitMask wide.
 */
#ifndef ExampleMasks_h
#define ExampleMasks_h

#include "Image/BitMask.h"
#include "Measures/VoxelOverlap.h"

#include <random>
#include <vector>

namespace FlipFree
{

inline ImageGeometry Grid(const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing)
{
  ImageGeometry geometry;
  geometry.Dimensions = dimensions;
  geometry.Spacing = spacing;
  return geometry;
}

inline double Dice(const BitMask& a, const BitMask& b)
{
  return MeasureOverlap(a, b, SerialFor).Dice();
}

template <typename Visit>
void ForEachVoxel(const VoxelBox& box, const Visit& visit)
{
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        visit(i, j, k);
      }
    }
  }
}

template <typename Visit>
void ForEachVoxel(const ImageGeometry& geometry, const Visit& visit)
{
  ForEachVoxel(VoxelBox{ { { 0, 0, 0 } }, geometry.Dimensions }, visit);
}

inline VoxelBox RandomBox(const ImageGeometry& geometry, std::mt19937& random)
{
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::uniform_int_distribution<int> place(0, geometry.Dimensions[axis] - 1);
    const int a = place(random);
    const int b = place(random);
    box.Begin[axis] = std::min(a, b);
    box.End[axis] = std::max(a, b) + 1;
  }
  return box;
}

inline std::vector<ImageGeometry> ExampleGrids()
{
  return { Grid({ { 13, 11, 9 } }, { 1, 1, 1 }), Grid({ { 14, 9, 7 } }, { 0.7, 1.3, 3.1 }),
    Grid({ { 9, 12, 5 } }, { 5, 0.4, 1 }), Grid({ { 1, 20, 1 } }, { 1, 2, 3 }),
    Grid({ { 20, 1, 6 } }, { 2, 1, 0.5 }), Grid({ { 64, 4, 3 } }, { 0.5, 1, 1 }),
    Grid({ { 65, 3, 4 } }, { 1, 1, 2 }), Grid({ { 128, 3, 2 } }, { 0.4, 1, 1 }),
    Grid({ { 130, 4, 2 } }, { 0.05, 1, 1 }) };
}

inline std::vector<unsigned char> RandomMask(const ImageGeometry& geometry, double part,
  std::mt19937& random)
{
  std::vector<unsigned char> mask(geometry.NumberOfVoxels());
  std::bernoulli_distribution coin(part);
  for (unsigned char& voxel : mask)
  {
    voxel = coin(random);
  }
  return mask;
}

inline BitMask BitsOf(const std::vector<unsigned char>& mask, const ImageGeometry& geometry)
{
  return VoxelsWhere(
    ImageView<unsigned char>{ mask.data(), geometry },
    [](unsigned char voxel) { return voxel != 0; }, SerialFor);
}

/// A byte for each voxel of the grid: 1 for those of the set.
inline std::vector<unsigned char> BytesOf(const BitMask& mask)
{
  std::vector<unsigned char> bytes(mask.GetGeometry().NumberOfVoxels(), 0);
  mask.ForEach([&bytes](std::size_t voxel) { bytes[voxel] = 1; });
  return bytes;
}

/// The square of the distance from a voxel to the nearest one of the value `target`.
inline double SquareToNearest(const std::vector<unsigned char>& mask, const ImageGeometry& geometry,
  unsigned char target, const Eigen::Vector3d& index)
{
  double least = 1e20;
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      if (mask[geometry.Offset(i, j, k)] == target)
      {
        const Eigen::Vector3d offset(i - index[0], j - index[1], k - index[2]);
        least = std::min(least, geometry.Spacing.cwiseProduct(offset).squaredNorm());
      }
    });
  return least;
}

} // namespace FlipFree

#endif
