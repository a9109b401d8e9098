/**
 * The types of voxels in files, whatever a format calls them.
 */
#ifndef FlipFreeVoxelType_h
#define FlipFreeVoxelType_h

#include <cstddef>
#include <cstdint>

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

/// Calls visit with a null pointer of the type.
template <typename Visit>
void WithVoxelType(VoxelType type, const Visit& visit)
{
  switch (type)
  {
    case VoxelType::Int8:
      return visit(static_cast<std::int8_t*>(nullptr));
    case VoxelType::UInt8:
      return visit(static_cast<std::uint8_t*>(nullptr));
    case VoxelType::Int16:
      return visit(static_cast<std::int16_t*>(nullptr));
    case VoxelType::UInt16:
      return visit(static_cast<std::uint16_t*>(nullptr));
    case VoxelType::Int32:
      return visit(static_cast<std::int32_t*>(nullptr));
    case VoxelType::UInt32:
      return visit(static_cast<std::uint32_t*>(nullptr));
    case VoxelType::Int64:
      return visit(static_cast<std::int64_t*>(nullptr));
    case VoxelType::UInt64:
      return visit(static_cast<std::uint64_t*>(nullptr));
    case VoxelType::Float32:
      return visit(static_cast<float*>(nullptr));
    case VoxelType::Float64:
      return visit(static_cast<double*>(nullptr));
  }
}

} // namespace FlipFree

#endif
