/**
 * Floats as whole numbers of the same order, to count them, or to halve a range of them until two
 * neighbours are left.
 */
#ifndef FlipFreeFloatOrder_h
#define FlipFreeFloatOrder_h

#include <cstdint>
#include <cstring>

namespace FlipFree
{

/// Ascends with the value; those that are no numbers lie beyond the infinite ones.
inline std::uint32_t OrderOf(float value)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits >> 31U ? ~bits : bits | 0x80000000U;
}

/// The float of that place in the order.
inline float FloatOf(std::uint32_t order)
{
  const std::uint32_t bits = order >> 31U ? order & 0x7fffffffU : ~order;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

} // namespace FlipFree

#endif
