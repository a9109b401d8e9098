#include "Image/GrayIntervals.h"

#include "Image/FloatOrder.h"
#include "Image/SeedRegion.h"

#include <algorithm>
#include <limits>

namespace FlipFree
{
namespace
{

// Of constant length, so that it is done by vectors in every build.
void Toggle(const float* voxels, float border, MaskBytes& bytes)
{
  for (int voxel = 0; voxel < BitMask::BitsOfWord; ++voxel)
  {
    bytes[voxel] = static_cast<unsigned char>(bytes[voxel] ^ (voxels[voxel] >= border ? 1U : 0U));
  }
}

} // namespace

GrayIntervals::GrayIntervals(bool lowest, std::vector<float> borders)
  : Lowest(lowest)
  , Borders(std::move(borders))
{
}

GrayIntervals GrayIntervals::WherePlaceIs(const std::vector<bool>& isIn,
  const std::function<std::size_t(float)>& place)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<float> borders;
  for (std::size_t at = 1; at < isIn.size() && at <= place(infinity); ++at)
  {
    if (isIn[at] == isIn[at - 1])
    {
      continue;
    }
    // The least float of that place or one behind it.
    std::uint32_t first = OrderOf(-infinity);
    std::uint32_t last = OrderOf(infinity);
    while (first < last)
    {
      const std::uint32_t middle = first + (last - first) / 2;
      if (place(FloatOf(middle)) >= at)
      {
        last = middle;
      }
      else
      {
        first = middle + 1;
      }
    }
    borders.push_back(FloatOf(first));
  }
  return { !isIn.empty() && isIn.front(), std::move(borders) };
}

void GrayIntervals::MarkRow(const float* voxels, int size, BitMask::Word* row) const
{
  const unsigned char lowest = this->Lowest ? 1 : 0;
  MaskBytes bytes{};
  int begin = 0;
  for (; begin + BitMask::BitsOfWord <= size; begin += BitMask::BitsOfWord)
  {
    bytes.fill(lowest);
    for (const float border : this->Borders)
    {
      Toggle(voxels + begin, border, bytes);
    }
    *row++ |= WordOf(bytes);
  }
  if (begin < size)
  {
    bytes.fill(0);
    std::transform(voxels + begin, voxels + size, bytes.begin(),
      [this](float z) { return static_cast<unsigned char>((*this)(z) ? 1 : 0); });
    *row |= WordOf(bytes);
  }
}

BitMask VoxelsIn(const GrayIntervals& values, const ImageView<float>& image, const VoxelBox& box,
  const ParallelFor& parallelFor)
{
  BitMask mask(CropGeometry(image.Geometry, box));
  parallelFor(0, box.Size(2),
    [&, begin = box.Begin](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int slice = static_cast<int>(first); slice < last; ++slice)
      {
        for (int row = 0; row < box.Size(1); ++row)
        {
          values.MarkRow(&image(begin[0], begin[1] + row, begin[2] + slice), box.Size(0),
            mask.Row(row, slice));
        }
      }
    });
  return mask;
}

} // namespace FlipFree
