#include "Measures/VoxelOverlap.h"

#include "Error.h"
#include "Image/GridCheck.h"

#include <atomic>

namespace FlipFree
{
VoxelOverlap MeasureOverlap(const BitMask& segmentation, const BitMask& reference,
  const ParallelFor& parallelFor)
{
  RequireSameGeometry(segmentation.GetGeometry(), reference.GetGeometry(), "the segmentation",
    "the reference");
  std::atomic<std::size_t> inSegmentation{ 0 };
  std::atomic<std::size_t> inReference{ 0 };
  std::atomic<std::size_t> inBoth{ 0 };
  parallelFor(0, static_cast<std::ptrdiff_t>(reference.GetWords().size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      VoxelOverlap part;
      for (std::ptrdiff_t word = first; word < last; ++word)
      {
        const BitMask::Word a = segmentation.GetWords()[word];
        const BitMask::Word b = reference.GetWords()[word];
        if ((a | b) != 0) // most are empty
        {
          part.Segmentation += BitMask::CountBits(a);
          part.Reference += BitMask::CountBits(b);
          part.Intersection += BitMask::CountBits(a & b);
        }
      }
      inSegmentation += part.Segmentation;
      inReference += part.Reference;
      inBoth += part.Intersection;
    });
  if (inSegmentation == 0 || inReference == 0)
  {
    throw Error(ErrorCode::EmptyMask,
      std::string(inReference == 0 ? "the reference" : "the segmentation") +
        " is empty: no voxel is inside; check that it is the intended label map");
  }
  return { inSegmentation, inReference, inBoth };
}

} // namespace FlipFree
