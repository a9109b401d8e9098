#include "Coordinates.h"

#include "Failure.h"

#include <algorithm>
#include <cmath>

namespace Command
{

void RequireCoordinates(const std::string& option, const std::vector<double>& values)
{
  if (values.size() % 3 != 0)
  {
    throw WrongUsage(option + ": a coordinate is missing. Give three numbers each time.");
  }
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
  {
    throw WrongUsage(
      option + ": a coordinate is not a finite number. Give three numbers, in millimeters.");
  }
}

} // namespace Command
