#include "QuantityNames.h"

namespace FlipFree
{
namespace
{

std::string NameOf(const std::string& quantity, const QuantityNames& names)
{
  const bool isPort = quantity.front() == ' ';
  if (isPort)
  {
    return names.empty() ? quantity : std::string();
  }
  const auto name = names.find(quantity);
  return name == names.end() ? quantity : name->second;
}

} // namespace

std::string WithNames(const std::string& message, const QuantityNames& names)
{
  std::string text;
  for (std::size_t at = 0; at < message.size(); ++at)
  {
    const char c = message[at];
    const bool isBrace = c == '{' || c == '}';
    const bool isDoubled = isBrace && at + 1 < message.size() && message[at + 1] == c;
    const std::size_t end = c == '{' && !isDoubled ? message.find('}', at) : std::string::npos;
    if (end != std::string::npos && end > at + 1)
    {
      text += NameOf(message.substr(at + 1, end - at - 1), names);
      at = end;
      continue;
    }
    text += c;
    at += isDoubled ? 1 : 0;
  }
  return text;
}

std::string Escaped(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped.append(c == '{' || c == '}' ? 2 : 1, c);
  }
  return escaped;
}

} // namespace FlipFree
