/**
 * Floats as whole numbers of the same order, to count them, or to halve a range of them until two
 * neighbors are left; and the float next to a double.
 */
#ifndef FlipFreeFloatOrder_h
#define FlipFreeFloatOrder_h

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace FlipFree
{

/// Ascends with the value; those that are no numbers lie beyond the infinite ones. -0 and 0 are
/// equal, but have places of their own, one behind the other.
inline std::uint32_t OrderOf(float value)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits >> 31U ? ~bits : bits | 0x80000000U;
}

/// The float of that place in the order, bit for bit.
inline float FloatOf(std::uint32_t order)
{
  const std::uint32_t bits = order >> 31U ? order & 0x7fffffffU : ~order;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// The least float that is not below the number, so that it is not below it as a double either.
inline float MinimumFloatFrom(double number)
{
  const auto nearest = static_cast<float>(number);
  return nearest < number ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                          : nearest;
}

} // namespace FlipFree

#endif
