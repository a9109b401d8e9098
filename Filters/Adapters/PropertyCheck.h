/**
 * Private to the modules, never installed: VTK's clamping setters let NaN pass, and every
 * comparison with it is false.
 */
#ifndef FlipFreePropertyCheck_h
#define FlipFreePropertyCheck_h

#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace FlipFree
{

struct NamedProperty
{
  const char* Name;
  double Value;
};

/// Throws std::invalid_argument, naming the first property that is NaN.
inline void RequireNumbers(std::initializer_list<NamedProperty> properties)
{
  for (const NamedProperty& property : properties)
  {
    if (std::isnan(property.Value))
    {
      throw std::invalid_argument(
        std::string("the property ") + property.Name + " is not a number (NaN); set it");
    }
  }
}

} // namespace FlipFree

#endif
