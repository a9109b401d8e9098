/**
 * A grid of blocks of voxels, for quantities that vary too slowly to need a value per voxel.
 */
#ifndef FlipFreeBlockGrid_h
#define FlipFreeBlockGrid_h

#include "Image/BitMask.h"
#include "Image/VoxelOffsets.h"

namespace FlipFree
{

struct BlockGrid
{
  ImageGeometry Voxels;
  std::array<int, 3> Factor{ { 1, 1, 1 } }; ///< voxels of a block along each axis
  ImageGeometry Blocks;                     ///< the last ones may reach beyond the image

  /// Blocks of at most `size` millimeters along each axis, and of a voxel at least.
  BlockGrid(const ImageGeometry& voxels, double size)
    : Voxels(voxels)
    , Blocks(voxels)
  {
    Eigen::Vector3d center;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int factor = std::max(1, static_cast<int>(size / voxels.Spacing[axis] + 1e-6));
      this->Factor[axis] = factor;
      this->Blocks.Dimensions[axis] = (voxels.Dimensions[axis] + factor - 1) / factor;
      this->Blocks.Spacing[axis] = factor * voxels.Spacing[axis];
      center[axis] = 0.5 * (factor - 1);
    }
    this->Blocks.Origin = voxels.ToPhysical(center);
  }

  /// How many voxels of a mask each block holds.
  std::vector<std::size_t> CountVoxels(const BitMask& mask, const ParallelFor& parallelFor) const
  {
    std::vector<std::size_t> counts(this->Blocks.NumberOfVoxels(), 0);
    this->ForEachRun(mask, parallelFor,
      [&](std::size_t block, int begin, int end, int, int) { counts[block] += end - begin; });
    return counts;
  }

  /// The blocks that hold at least so many voxels of a mask.
  BitMask BlocksWith(std::size_t least, const BitMask& mask, const ParallelFor& parallelFor) const
  {
    const std::vector<std::size_t> counts = this->CountVoxels(mask, parallelFor);
    BitMask blocks(this->Blocks);
    for (std::size_t block = 0; block < counts.size(); ++block)
    {
      if (counts[block] >= least)
      {
        blocks.Insert(block);
      }
    }
    return blocks;
  }

  /// The voxels of the blocks of a mask.
  BitMask VoxelsOf(const BitMask& blocks, const ParallelFor& parallelFor) const
  {
    BitMask voxels(this->Voxels);
    parallelFor(0, this->Blocks.Dimensions[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        blocks.ForEachRun(first, last,
          [&](int begin, int end, int j, int k)
          { this->SetBlocks(true, begin, end, j, k, voxels); });
      });
    return voxels;
  }

  /// Calls visit(block, begin, end, j, k) for the runs of the mask's voxels in each block, in
  /// parallel over slices of blocks.
  template <typename Visit>
  void ForEachRun(const BitMask& mask, const ParallelFor& parallelFor, const Visit& visit) const
  {
    parallelFor(0, this->Blocks.Dimensions[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        const std::ptrdiff_t end =
          std::min<std::ptrdiff_t>(last * this->Factor[2], this->Voxels.Dimensions[2]);
        mask.ForEachRun(first * this->Factor[2], end,
          [&](int begin, int stop, int j, int k)
          {
            const std::size_t row =
              this->Blocks.Offset(0, j / this->Factor[1], k / this->Factor[2]);
            for (int i = begin; i < stop;)
            {
              const int block = i / this->Factor[0];
              const int next = std::min(stop, (block + 1) * this->Factor[0]);
              visit(row + block, i, next, j, k);
              i = next;
            }
          });
      });
  }

  /// The block of the voxel next to a point.
  std::size_t BlockAt(const Eigen::Vector3d& point) const
  {
    const std::array<int, 3> voxel = NearestVoxel(this->Voxels, point);
    return this->Blocks.Offset(voxel[0] / this->Factor[0], voxel[1] / this->Factor[1],
      voxel[2] / this->Factor[2]);
  }

  Eigen::Vector3d CenterOf(std::size_t block) const
  {
    return FlipFree::CenterOf(block, this->Blocks);
  }

  /// Inserts the voxels of the blocks (i, j, k) with begin <= i < end into a mask of the voxels, or
  /// removes them.
  void SetBlocks(bool inside, int begin, int end, int j, int k, BitMask& mask) const
  {
    const std::array<int, 3>& size = this->Voxels.Dimensions;
    const std::array<int, 3>& factor = this->Factor;
    const int stop = std::min(size[0], end * factor[0]);
    for (int z = k * factor[2]; z < std::min(size[2], (k + 1) * factor[2]); ++z)
    {
      for (int y = j * factor[1]; y < std::min(size[1], (j + 1) * factor[1]); ++y)
      {
        mask.SetRun(inside, begin * factor[0], stop, y, z);
      }
    }
  }

  void SetBlock(bool inside, std::size_t block, BitMask& mask) const
  {
    const std::array<int, 3> index = IndexOf(block, this->Blocks);
    this->SetBlocks(inside, index[0], index[0] + 1, index[1], index[2], mask);
  }

  std::size_t VoxelsPerBlock() const
  {
    return static_cast<std::size_t>(this->Factor[0]) * this->Factor[1] * this->Factor[2];
  }

  std::size_t HalfOfBlock() const { return (this->VoxelsPerBlock() + 1) / 2; }

  /// Whether so many voxels are half of a block.
  bool AreHalf(std::size_t voxels) const { return voxels >= this->HalfOfBlock(); }
};

/// Values on the blocks, interpolated along one row of voxels.
class BlockRow
{
public:
  explicit BlockRow(const BlockGrid& grid)
    : Grid(grid)
    , Low(grid.Voxels.Dimensions[0])
    , Part(grid.Voxels.Dimensions[0])
    , Blended(grid.Blocks.Dimensions[0] + 1)
  {
    for (int i = 0; i < grid.Voxels.Dimensions[0]; ++i)
    {
      double part = 0;
      this->Low[i] = this->Place(0, i, part);
      this->Part[i] = static_cast<float>(part);
    }
  }

  /// The values at the voxels begin <= i < end of the row (j, k).
  void Read(const std::vector<float>& blocks, int begin, int end, int j, int k, float* values)
  {
    double partJ = 0;
    double partK = 0;
    const int lowJ = this->Place(1, j, partJ);
    const int lowK = this->Place(2, k, partK);
    const auto& size = this->Grid.Blocks.Dimensions;
    const int highJ = std::min(lowJ + 1, size[1] - 1);
    const int highK = std::min(lowK + 1, size[2] - 1);
    const float* const rows[4] = { blocks.data() + this->Grid.Blocks.Offset(0, lowJ, lowK),
      blocks.data() + this->Grid.Blocks.Offset(0, highJ, lowK),
      blocks.data() + this->Grid.Blocks.Offset(0, lowJ, highK),
      blocks.data() + this->Grid.Blocks.Offset(0, highJ, highK) };
    const auto a = static_cast<float>((1 - partJ) * (1 - partK));
    const auto b = static_cast<float>(partJ * (1 - partK));
    const auto c = static_cast<float>((1 - partJ) * partK);
    const auto d = static_cast<float>(partJ * partK);
    const int firstBlock = this->Low[begin];
    const int lastBlock = std::min(this->Low[end - 1] + 1, size[0] - 1);
    for (int block = firstBlock; block <= lastBlock; ++block)
    {
      this->Blended[block] =
        a * rows[0][block] + b * rows[1][block] + c * rows[2][block] + d * rows[3][block];
    }
    this->Blended[lastBlock + 1] = this->Blended[lastBlock];
    for (int i = begin; i < end; ++i)
    {
      const float low = this->Blended[this->Low[i]];
      values[i - begin] = low + this->Part[i] * (this->Blended[this->Low[i] + 1] - low);
    }
  }

private:
  // The block before a voxel's center, and how far it is to the next.
  int Place(int axis, int voxel, double& part) const
  {
    const int factor = this->Grid.Factor[axis];
    const double place = (voxel - 0.5 * (factor - 1)) / factor;
    const double clamped = std::max(0.0, std::min(place, this->Grid.Blocks.Dimensions[axis] - 1.0));
    const int low = static_cast<int>(clamped);
    part = clamped - low;
    return low;
  }

  const BlockGrid& Grid;
  std::vector<int> Low;
  std::vector<float> Part;
  std::vector<float> Blended;
};

} // namespace FlipFree

#endif
