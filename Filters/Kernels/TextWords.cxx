#include "TextWords.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>

namespace FlipFree
{
namespace
{

/// Of a valid letter beyond ASCII in UTF-8; 0 where there is none.
std::size_t Utf8LengthAt(const std::string& text, std::size_t at)
{
  const auto byte = [&](std::size_t index)
  { return index < text.size() ? static_cast<unsigned char>(text[index]) : 0; };
  const int first = byte(at);
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  // Second bytes that would make a letter longer than it has to be, or none.
  const int least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const int greatest = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  bool isValid =
    first >= 0xC2 && first <= 0xF4 && byte(at + 1) >= least && byte(at + 1) <= greatest;
  for (std::size_t index = 2; index < length; ++index)
  {
    isValid = isValid && byte(at + index) >= 0x80 && byte(at + index) <= 0xBF;
  }
  return isValid ? length : 0;
}

} // namespace

std::string WithSmallFirst(const std::string& text)
{
  return InSmallLetters(text.substr(0, 1)) + text.substr(std::min<std::size_t>(1, text.size()));
}

std::string InSmallLetters(std::string text)
{
  for (char& letter : text)
  {
    if (letter >= 'A' && letter <= 'Z')
    {
      letter = static_cast<char>(letter - 'A' + 'a');
    }
  }
  return text;
}

std::string Trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos
    ? std::string()
    : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

std::vector<std::string> Words(const std::string& text)
{
  std::istringstream stream(text);
  return { std::istream_iterator<std::string>(stream), {} };
}

bool ToNumber(const std::string& text, double& number)
{
  const std::string small = InSmallLetters(text);
  const bool isNegative = !small.empty() && small[0] == '-';
  const std::string word = small.substr(isNegative || (!small.empty() && small[0] == '+') ? 1 : 0);
  if (word == "nan" || word == "inf" || word == "infinity")
  {
    number = word == "nan" ? std::nan("") : (isNegative ? -HUGE_VAL : HUGE_VAL);
    return true;
  }
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  stream >> number;
  if (stream.fail() && std::abs(number) == std::numeric_limits<double>::max())
  {
    number = number > 0 ? HUGE_VAL : -HUGE_VAL; // more than a number can hold
    stream.clear();
  }
  return !text.empty() && !stream.fail() && stream.peek() == std::istringstream::traits_type::eof();
}

bool IsPrintable(const std::string& line)
{
  return std::none_of(line.begin(), line.end(),
    [](char letter) { return static_cast<unsigned char>(letter) < ' ' && letter != '\t'; });
}

bool IsUtf8(const std::string& text)
{
  for (std::size_t at = 0; at < text.size();)
  {
    const bool isAscii = static_cast<unsigned char>(text[at]) < 0x80;
    const std::size_t length = isAscii ? 1 : Utf8LengthAt(text, at);
    if (length == 0)
    {
      return false;
    }
    at += length;
  }
  return true;
}

std::string TextForPeople(const std::string& original, bool isUtf8, bool isLatin1)
{
  std::string text;
  for (std::size_t at = 0; at < original.size(); ++at)
  {
    const auto code = static_cast<unsigned char>(original[at]);
    const std::size_t length = isUtf8 ? Utf8LengthAt(original, at) : 0;
    if (code < 0x20 || code == 0x7F)
    {
      text += ' ';
    }
    else if (code < 0x80)
    {
      text += original[at];
    }
    else if (length > 0)
    {
      text.append(original, at, length);
      at += length - 1;
    }
    else if (isLatin1)
    {
      text += static_cast<char>(0xC0 | code >> 6);
      text += static_cast<char>(0x80 | (code & 0x3F));
    }
    else
    {
      text += '?';
    }
  }
  return text;
}

} // namespace FlipFree
