/**
 * Values as JSON. Numbers have as many digits as it takes to read them back exactly.
 */
#ifndef FlipFreeJsonText_h
#define FlipFreeJsonText_h

#include "MessageText.h"
#include "ParameterTable.h"
#include "TextWords.h"

#include <cstddef>
#include <cstdio>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

namespace FlipFree
{

/// Of a finite one.
inline std::string JsonOf(double number)
{
  return ExactTextOf(number);
}

/// In UTF-8, in quotes.
inline std::string JsonOf(const std::string& text)
{
  std::string quoted = "\"";
  for (const char letter : text)
  {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20)
    {
      char escaped[8];
      std::snprintf(escaped, sizeof(escaped), "\\u%04x", code);
      quoted += escaped;
      continue;
    }
    quoted += letter == '"' || letter == '\\' ? std::string("\\") + letter : std::string(1, letter);
  }
  return quoted + '"';
}

/// A list of numbers, as [1,2.5,-3].
template <typename Number>
std::string JsonOf(const Number* numbers, std::size_t count)
{
  std::string list;
  for (std::size_t index = 0; index < count; ++index)
  {
    list += (index > 0 ? "," : "") + JsonOf(static_cast<double>(numbers[index]));
  }
  return "[" + list + "]";
}

/// A list of values that are JSON already.
inline std::string JsonList(const std::vector<std::string>& values)
{
  std::string list;
  for (const std::string& value : values)
  {
    list += (list.empty() ? "" : ",") + value;
  }
  return "[" + list + "]";
}

/// The parameters of a table as an object, by their names with a small first letter.
template <typename Settings>
std::string JsonOf(const ParameterTable<Settings>& table, const Settings& settings)
{
  std::string object;
  for (const Parameter<Settings>& parameter : table)
  {
    const std::vector<double> values = parameter.Get(settings);
    object += (object.empty() ? "" : ",") + JsonOf(WithSmallFirst(parameter.Name)) + ":";
    object += parameter.Count > 1                ? JsonOf(values.data(), values.size())
      : parameter.Type == ParameterType::Boolean ? (values.front() != 0 ? "true" : "false")
                                                 : JsonOf(values.front());
  }
  return "{" + object + "}";
}

} // namespace FlipFree

#endif
