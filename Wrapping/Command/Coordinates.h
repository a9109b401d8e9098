/**
 * Coordinates of the patient: LPS millimeters are the toolkit's; some viewers and files have RAS.
 */
#ifndef FlipFreeCommandCoordinates_h
#define FlipFreeCommandCoordinates_h

#include <array>

namespace Command
{

/// An LPS point as RAS, or the other way.
inline std::array<double, 3> SwapLpsRas(const std::array<double, 3>& point)
{
  return { { -point[0], -point[1], point[2] } };
}

} // namespace Command

#endif
