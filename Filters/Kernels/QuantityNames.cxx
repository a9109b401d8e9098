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

// The message with escaped() in place of doubled braces, and worded() of the quantity in place of
// others.
template <typename Escape, typename Word>
std::string Transformed(const std::string& message, const Escape& escaped, const Word& worded)
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
      text += worded(message.substr(at + 1, end - at - 1));
      at = end;
    }
    else if (isDoubled)
    {
      text += escaped(c);
      ++at;
    }
    else
    {
      text += c;
    }
  }
  return text;
}

} // namespace

std::string WithNames(const std::string& message, const QuantityNames& names)
{
  return Transformed(
    message, [](char brace) { return std::string(1, brace); },
    [&](const std::string& quantity) { return NameOf(quantity, names); });
}

std::string WithWords(const std::string& message, const QuantityNames& words)
{
  return Transformed(
    message, [](char brace) { return std::string(2, brace); },
    [&](const std::string& quantity)
    {
      const auto word = words.find(quantity);
      return word == words.end() ? "{" + quantity + "}" : Escaped(word->second);
    });
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
