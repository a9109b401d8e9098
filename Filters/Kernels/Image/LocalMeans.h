/**
 * Local means over the voxels of a mask, on a grid of blocks: Gaussian averages of what the blocks
 * hold, over those of how much they hold (normalized convolution).
 */
#ifndef FlipFreeLocalMeans_h
#define FlipFreeLocalMeans_h

#include "Image/BlockGrid.h"
#include "Image/ImagePart.h"

#include <vector>

namespace FlipFree
{

/// Per block.
struct BlockSums
{
  std::vector<float> Values;
  std::vector<float> Weights; ///< numbers of voxels with data

  /// Of all blocks; zero where there are no voxels.
  float Mean() const;
};

/// Calls add(block, begin, end, j, k, sum) for the runs of the mask's voxels in each block, which
/// adds the values of those with data to the block's sum and returns how many these are.
template <typename Add>
BlockSums SumInBlocks(const BitMask& mask, const BlockGrid& grid, const ParallelFor& parallelFor,
  const Add& add)
{
  const std::size_t count = grid.Blocks.NumberOfVoxels();
  BlockSums sums{ std::vector<float>(count, 0.0F), std::vector<float>(count, 0.0F) };
  grid.ForEachRun(mask, parallelFor,
    [&](std::size_t block, int begin, int end, int j, int k) {
      sums.Weights[block] += static_cast<float>(add(block, begin, end, j, k, sums.Values[block]));
    });
  return sums;
}

/// Of the gray values.
BlockSums SumInBlocks(const ImagePart& image, const BitMask& mask, const BlockGrid& grid,
  const ParallelFor& parallelFor);

/// The local means per block, by a Gaussian of this standard deviation (mm); `elsewhere` where the
/// weight is not above the least.
std::vector<float> LocalMeans(BlockSums sums, const ImageGeometry& blocks, double deviation,
  float leastWeight, float elsewhere, const ParallelFor& parallelFor);

/// By how much the mask's voxels with data differ from the local means, which are interpolated.
std::vector<float> DifferencesFrom(const std::vector<float>& means, const BlockGrid& grid,
  const ImagePart& image, const BitMask& mask);

} // namespace FlipFree

#endif
