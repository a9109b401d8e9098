/**
 * The check that properties are numbers: clamping lets NaN pass, since every comparison with it is
 * false; and what is not clamped may be infinite.
 */
#ifndef FlipFreePropertyCheck_h
#define FlipFreePropertyCheck_h

#include "Error.h"

#include <cmath>
#include <initializer_list>
#include <string>

namespace FlipFree
{

struct NamedProperty
{
  const char* Name;
  double Value;
};

/// Throws Error, naming the first property that is not a finite number.
inline void RequireNumbers(std::initializer_list<NamedProperty> properties)
{
  for (const NamedProperty& property : properties)
  {
    if (!std::isfinite(property.Value))
    {
      throw Error(ErrorCode::NonFiniteValue,
        std::string("the value of {") + property.Name + "} is " +
          (std::isnan(property.Value) ? "not a number (NaN)" : "infinite") +
          "; set it to a number");
    }
  }
}

} // namespace FlipFree

#endif
