/**
 * The parameters of a settings struct by name, for front ends that take them as they come: a table
 * with an entry for each, numbers of any type as doubles.
 */
#ifndef FlipFreeParameterTable_h
#define FlipFreeParameterTable_h

#include "PropertyCheck.h"

#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace FlipFree
{

enum class ParameterType
{
  Boolean,
  Integer,
  Real
};

template <typename Settings>
struct Parameter
{
  std::string Name; ///< of the filters' property, as in messages
  ParameterType Type;
  int Count; ///< of its numbers
  std::function<std::vector<double>(const Settings&)> Get;
  /// Takes `Count` numbers and clamps each to its range; NaN passes.
  std::function<void(Settings&, const std::vector<double>&)> Set;
};

template <typename Settings>
using ParameterTable = std::vector<Parameter<Settings>>;

/// Throws, naming the first parameter that is not a finite number.
template <typename Settings>
void RequireNumbers(const ParameterTable<Settings>& table, const Settings& settings)
{
  for (const Parameter<Settings>& parameter : table)
  {
    for (const double value : parameter.Get(settings))
    {
      RequireNumbers({ { parameter.Name.c_str(), value } });
    }
  }
}

template <typename T>
constexpr ParameterType ParameterTypeOf()
{
  if (std::is_same_v<T, bool>)
  {
    return ParameterType::Boolean;
  }
  return std::is_integral_v<T> || std::is_enum_v<T> ? ParameterType::Integer : ParameterType::Real;
}

/// `field(settings)` is a reference to the number. Enumerations are numbered without gaps.
template <typename T, typename Settings, typename Field>
Parameter<Settings> NumberParameter(const std::string& name, const Field& field, double minimum,
  double maximum)
{
  return { name, ParameterTypeOf<T>(), 1,
    [field](const Settings& settings)
    { return std::vector<double>{ static_cast<double>(field(settings)) }; },
    [field, minimum, maximum](Settings& settings, const std::vector<double>& values)
    {
      const double value = values.front();
      field(settings) =
        static_cast<T>(value < minimum ? minimum : (value > maximum ? maximum : value));
    } };
}

/// `first(settings)` points to the first of `count` numbers.
template <typename T, typename Settings, typename First>
Parameter<Settings> VectorParameter(const std::string& name, const First& first, int count)
{
  return { name, ParameterTypeOf<T>(), count,
    [first, count](const Settings& settings)
    {
      const auto* const numbers = first(settings);
      return std::vector<double>(numbers, numbers + count);
    },
    [first](Settings& settings, const std::vector<double>& values)
    {
      T* number = first(settings);
      for (const double value : values)
      {
        *number++ = static_cast<T>(value);
      }
    } };
}

} // namespace FlipFree

#endif
