/**
 * Coordinates of the patient: LPS millimeters are the toolkit's; some viewers and files have RAS.
 */
#ifndef FlipFreeCommandCoordinates_h
#define FlipFreeCommandCoordinates_h

#include <array>
#include <string>
#include <vector>

namespace Command
{

/// An LPS point as RAS, or the other way.
inline std::array<double, 3> SwapLpsRas(const std::array<double, 3>& point)
{
  return { { -point[0], -point[1], point[2] } };
}

/// Checks the values of an option that takes a point each time. Throws WrongUsage unless they are
/// finite and three of each.
void RequireCoordinates(const std::string& option, const std::vector<double>& values);

} // namespace Command

#endif
