#include "Image/BlockNetwork.h"

#include "Image/LocalMeans.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace FlipFree
{
namespace
{

// Of the image in which edges attract the cut, in millimeters.
constexpr double EdgeSmoothing = 1;
// The greatest capacity between neighbors; capacities are rounded to a whole number.
constexpr double GreatestCapacity = 1 << 20;
// Differences of more than this many contrasts, squared, do not matter.
constexpr double GreatestJump = 24;

std::vector<float> BlockMeans(const ImagePart& image, const BlockGrid& grid,
  const ParallelFor& parallelFor)
{
  const auto& blocks = grid.Blocks.Dimensions;
  const auto& size = grid.Voxels.Dimensions;
  const std::array<int, 3>& factor = grid.Factor;
  std::vector<float> means(grid.Blocks.NumberOfVoxels(), 0.0F);
  parallelFor(0, blocks[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<int> blockOf(size[0]);
      for (int i = 0; i < size[0]; ++i)
      {
        blockOf[i] = i / factor[0];
      }
      std::vector<float> counts(blocks[0]);
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < blocks[1]; ++j)
        {
          float* const sums = means.data() + grid.Blocks.Offset(0, j, k);
          std::fill(counts.begin(), counts.end(), 0.0F);
          for (int z = k * factor[2]; z < std::min(size[2], (k + 1) * factor[2]); ++z)
          {
            for (int y = j * factor[1]; y < std::min(size[1], (j + 1) * factor[1]); ++y)
            {
              const float* const row = image.Row(y, z);
              for (int i = 0; i < size[0]; ++i)
              {
                sums[blockOf[i]] += row[i];
                counts[blockOf[i]] += 1;
              }
            }
          }
          for (int i = 0; i < blocks[0]; ++i)
          {
            sums[i] /= counts[i];
          }
        }
      }
    });
  return means;
}

} // namespace

std::vector<float> SmoothBlockMeans(const ImagePart& image, const BlockGrid& grid,
  const ParallelFor& parallelFor)
{
  std::vector<float> ones(grid.Blocks.NumberOfVoxels(), 1.0F);
  return LocalMeans({ BlockMeans(image, grid, parallelFor), std::move(ones) }, grid.Blocks,
    EdgeSmoothing, 0, 0, parallelFor);
}

CutNetwork MakeBlockNetwork(const ImageGeometry& blocks, const std::vector<int>& nodes,
  const std::vector<float>& smooth, const BlockLinks& links,
  const std::function<double(std::size_t block)>& unary,
  const std::function<double(std::size_t block)>& side, const ParallelFor& parallelFor)
{
  CutNetwork network(static_cast<std::size_t>(
    std::count_if(nodes.begin(), nodes.end(), [](int node) { return node >= 0; })));
  const auto& size = blocks.Dimensions;
  const double volume = blocks.VoxelVolume();
  const std::array<double, 3> area{ { volume / blocks.Spacing[0], volume / blocks.Spacing[1],
    volume / blocks.Spacing[2] } };
  const double unit =
    links.PerArea * *std::max_element(area.begin(), area.end()) / GreatestCapacity;
  constexpr std::int32_t greatest = CutNode::Infinite / 4;
  const std::array<std::ptrdiff_t, 3> step = StepsOf(blocks);
  const auto capacityOf = [&](std::size_t block, std::size_t other, int axis)
  {
    const double jump = (smooth[block] - smooth[other]) / links.EdgeContrast;
    // Also where a voxel is not a number.
    const double square = jump * jump < GreatestJump ? jump * jump : GreatestJump;
    return links.PerArea * area[axis] / unit * std::exp(-0.5 * square);
  };
  const auto link = [&](std::size_t block, const std::array<int, 3>& index)
  {
    CutNode& own = network[nodes[block]];
    double terminal = unary(block) * volume / unit;
    for (int way = 0; way < 6; ++way)
    {
      const int axis = way / 2;
      const bool up = way % 2 == 1;
      if (up ? index[axis] + 1 >= size[axis] : index[axis] == 0)
      {
        continue;
      }
      const std::size_t other = block + (up ? step[axis] : -step[axis]);
      if (nodes[other] < 0)
      {
        terminal += side(other) * capacityOf(block, other, axis);
        continue;
      }
      own.Neighbors[way] = nodes[other];
      // The same in both directions: the lower block's turn.
      if (up)
      {
        const auto capacity =
          static_cast<std::int32_t>(std::lround(capacityOf(block, other, axis)));
        own.Capacities[way] = capacity;
        network[nodes[other]].Capacities[way - 1] = capacity;
      }
    }
    own.Terminal = static_cast<std::int32_t>(
      std::lround(std::max<double>(-greatest, std::min<double>(greatest, terminal))));
  };
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::size_t block = blocks.Offset(0, 0, static_cast<int>(first));
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          for (int i = 0; i < size[0]; ++i, ++block)
          {
            if (nodes[block] >= 0)
            {
              link(block, { { i, j, k } });
            }
          }
        }
      }
    });
  return network;
}

} // namespace FlipFree
