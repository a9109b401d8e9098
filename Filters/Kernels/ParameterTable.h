/**
 * The parameters of a settings struct by name, for front ends that take them as they come: a table
 * with an entry for each, numbers of any type as doubles. What a parameter is called, means and
 * allows is said nowhere else; its default is that of the settings.
 */
#ifndef FlipFreeParameterTable_h
#define FlipFreeParameterTable_h

#include "PropertyCheck.h"

#include <algorithm>
#include <cmath>
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

/// What people read about a parameter.
struct ParameterWords
{
  const char* Unit = "";  ///< MM, VOXELS, or what else its values are called; none of booleans
  const char* Help = "";  ///< what it does; other parameters are in braces (QuantityNames.h)
  const char* Group = ""; ///< with which others it is shown; none: those that most users set
};

template <typename Settings>
struct Parameter
{
  std::string Name; ///< of the filters' property, as in messages
  ParameterType Type;
  int Count; ///< of its numbers
  std::function<std::vector<double>(const Settings&)> Get;
  /// Takes `Count` numbers and clamps each to its range; NaN, which only reals may be given,
  /// passes.
  std::function<void(Settings&, const std::vector<double>&)> Set;
  double Minimum;
  double Maximum;
  ParameterWords Words;

  /// Sets it; whether the number was in its range. Of several, any will do. What is not `Count`
  /// numbers, or NaN for a Boolean or an Integer, is not set.
  bool Take(Settings& settings, const std::vector<double>& values) const
  {
    const auto isNaN = [](double value) { return std::isnan(value); };
    if (static_cast<int>(values.size()) != this->Count ||
      (this->Type != ParameterType::Real && std::any_of(values.begin(), values.end(), isNaN)))
    {
      return false;
    }
    this->Set(settings, values);
    return this->Count > 1 || this->Get(settings) == values;
  }
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
  double maximum, const ParameterWords& words = {})
{
  return { name, ParameterTypeOf<T>(), 1,
    [field](const Settings& settings)
    { return std::vector<double>{ static_cast<double>(field(settings)) }; },
    [field, minimum, maximum](Settings& settings, const std::vector<double>& values)
    {
      const double value = values.front();
      field(settings) =
        static_cast<T>(value < minimum ? minimum : (value > maximum ? maximum : value));
    },
    minimum, maximum, words };
}

/// `first(settings)` points to the first of `count` numbers, which may be any.
template <typename T, typename Settings, typename First>
Parameter<Settings> VectorParameter(const std::string& name, const First& first, int count,
  const ParameterWords& words = {})
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
    },
    -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), words };
}

template <typename Settings>
const Parameter<Settings>* FindParameter(const ParameterTable<Settings>& table,
  const std::string& name)
{
  for (const Parameter<Settings>& parameter : table)
  {
    if (parameter.Name == name)
    {
      return &parameter;
    }
  }
  return nullptr;
}

} // namespace FlipFree

/// An entry of a table of `Settings` from a row of a list (SegmentationParameters.h).
#define FLIPFREE_PARAMETER(Name, type, field, minimum, maximum, ...)                               \
  FlipFree::NumberParameter<type, Settings>(#Name, [](auto& settings) -> auto& { return field; },  \
    minimum, maximum, { __VA_ARGS__ }),

#endif
