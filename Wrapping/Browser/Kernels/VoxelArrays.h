/**
 * Voxels of a type that only a file tells, as typed arrays of JavaScript.
 */
#ifndef FlipFreeVoxelArrays_h
#define FlipFreeVoxelArrays_h

#include "Bindings.h"

#include "Exchange/VoxelType.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace FlipFree
{

template <typename T, typename Fill>
val FilledArrayOf(std::size_t count, const Fill& fill)
{
  std::vector<T> values(count);
  fill(static_cast<void*>(values.data()));
  return ArrayOf(values);
}

/// A typed array of so many values, which `fill(values)` writes.
template <typename Fill>
val FilledArray(VoxelType type, std::size_t count, const Fill& fill)
{
  switch (type)
  {
    case VoxelType::Int8:
      return FilledArrayOf<std::int8_t>(count, fill);
    case VoxelType::UInt8:
      return FilledArrayOf<std::uint8_t>(count, fill);
    case VoxelType::Int16:
      return FilledArrayOf<std::int16_t>(count, fill);
    case VoxelType::UInt16:
      return FilledArrayOf<std::uint16_t>(count, fill);
    case VoxelType::Int32:
      return FilledArrayOf<std::int32_t>(count, fill);
    case VoxelType::UInt32:
      return FilledArrayOf<std::uint32_t>(count, fill);
    case VoxelType::Float32:
      return FilledArrayOf<float>(count, fill);
    case VoxelType::Float64:
      return FilledArrayOf<double>(count, fill);
    case VoxelType::Int64:
    case VoxelType::UInt64:
      break;
  }
  throw std::invalid_argument("The voxels are 64-bit integers, for which a browser has no numbers; "
                              "save them with 32 bits");
}

/// { size, spacing, origin, direction } of a grid.
inline void SetGrid(val& fields, const ImageGeometry& grid)
{
  const RowMajorMatrix direction = grid.Direction;
  fields.set("size", ArrayOf(grid.Dimensions));
  fields.set("spacing", ArrayOf(grid.Spacing));
  fields.set("origin", ArrayOf(grid.Origin));
  fields.set("direction", ArrayOf(direction));
}

} // namespace FlipFree

#endif
