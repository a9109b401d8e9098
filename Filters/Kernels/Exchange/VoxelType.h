/**
 * The types of voxels in files, whatever a format calls them.
 */
#ifndef FlipFreeVoxelType_h
#define FlipFreeVoxelType_h

#include <cstddef>

namespace FlipFree
{

enum class VoxelType
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

/// In bytes.
inline std::size_t SizeOf(VoxelType type)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8 };
  return sizes[static_cast<int>(type)];
}

inline bool IsFloatingPoint(VoxelType type)
{
  return type == VoxelType::Float32 || type == VoxelType::Float64;
}

/// The name that numpy has for it, which front ends translate.
inline const char* NameOf(VoxelType type)
{
  constexpr const char* names[] = { "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64",
    "uint64", "float32", "float64" };
  return names[static_cast<int>(type)];
}

} // namespace FlipFree

#endif
