/**
 * The parts of the module, and what they share: how errors, settings, progress and arrays pass
 * between JavaScript and the kernels. The module is private to the package, whose layer in
 * TypeScript checks arguments and words messages.
 */
#ifndef FlipFreeBindings_h
#define FlipFreeBindings_h

#include "Error.h"
#include "KernelTypes.h"
#include "MessageText.h"
#include "ParameterTable.h"

#include <emscripten/val.h>

#include <exception>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace FlipFree
{

using emscripten::val;

void BindSegmentation();
void BindVessels();
void BindEvaluation();
void BindDicom();
void BindExchange();
void BindLabelSurfaces();
void BindPhantoms();
void BindVolumes();

/// Exceptions of C++ are opaque to JavaScript. Returns make(), or { error: message } with
/// quantities in braces, or { error: "", outOfMemory: true }.
template <typename Make>
val Guarded(const Make& make)
{
  val failure = val::object();
  try
  {
    return make();
  }
  catch (const std::bad_alloc&)
  {
    failure.set("error", std::string());
    failure.set("outOfMemory", true);
  }
  catch (const std::length_error&) // more than a vector could hold
  {
    failure.set("error", std::string());
    failure.set("outOfMemory", true);
  }
  catch (const std::exception& error)
  {
    failure.set("error", MessageOf(error));
  }
  return failure;
}

/// A function that takes the fraction done and returns whether to go on.
inline Monitor MonitorOf(const val& report, double first = 0, double last = 1)
{
  return [report, first, last](double fraction)
  { return report(first + fraction * (last - first)).as<bool>(); };
}

/// A typed array of its own.
template <typename T>
val ArrayOf(const T* data, std::size_t size)
{
  return val(emscripten::typed_memory_view(size, data)).call<val>("slice");
}

template <typename Container>
val ArrayOf(const Container& container)
{
  return ArrayOf(container.data(), static_cast<std::size_t>(container.size()));
}

/// The parameters of some settings: [{ name, type, values }].
template <typename Settings>
val ParametersOf(const ParameterTable<Settings>& table, const Settings& settings)
{
  const char* const types[] = { "boolean", "integer", "real" };
  val parameters = val::array();
  for (const Parameter<Settings>& parameter : table)
  {
    val entry = val::object();
    entry.set("name", parameter.Name);
    entry.set("type", std::string(types[static_cast<int>(parameter.Type)]));
    entry.set("values", val::array(parameter.Get(settings)));
    parameters.call<void>("push", entry);
  }
  return parameters;
}

/// Throws for a number that is not in a parameter's range, or not whole where it has to be.
template <typename Settings>
[[noreturn]] void RefuseNumber(const Parameter<Settings>& parameter, double value)
{
  const bool isInteger = parameter.Type == ParameterType::Integer;
  const bool isUnlimited = parameter.Maximum >= std::numeric_limits<int>::max();
  throw Error(ErrorCode::OutOfRange,
    "the value of {" + parameter.Name + "} is " + TextOf(value) + "; choose " +
      (isInteger ? "a whole number, " : "") + TextOf(parameter.Minimum) +
      (isUnlimited ? " or more" : " to " + TextOf(parameter.Maximum)));
}

/// Sets those of which `values` has an array of numbers. The package has checked names and counts.
template <typename Settings>
void SetParameters(const ParameterTable<Settings>& table, const val& values, Settings& settings)
{
  for (const Parameter<Settings>& parameter : table)
  {
    const val value = values[parameter.Name];
    if (!value.isUndefined())
    {
      const auto numbers = emscripten::vecFromJSArray<double>(value);
      if (!parameter.Take(settings, numbers))
      {
        RefuseNumber(parameter, numbers.front());
      }
    }
  }
}

} // namespace FlipFree

#endif
