#include "Exchange/DicomAttributes.h"

#include <cmath>
#include <locale>
#include <sstream>

namespace FlipFree
{
namespace
{

/// Numbers as DICOM writes them, whatever the locale of the program.
bool ToDicomNumber(const std::string& text, double& number)
{
  std::istringstream stream(WithoutDicomPadding(text));
  stream.imbue(std::locale::classic());
  return stream >> number && stream.peek() == std::istringstream::traits_type::eof() &&
    std::isfinite(number);
}

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

std::string WithoutDicomPadding(const std::string& text)
{
  const std::string padding(" \0\t\r\n", 5);
  const std::size_t first = text.find_first_not_of(padding);
  return first == std::string::npos
    ? std::string()
    : text.substr(first, text.find_last_not_of(padding) + 1 - first);
}

const std::string& DicomAttributes::Text(std::uint32_t tag) const
{
  static const std::string none;
  const auto found = this->Values.find(tag);
  return found == this->Values.end() ? none : found->second;
}

std::vector<double> DicomAttributes::Numbers(std::uint32_t tag) const
{
  std::vector<double> numbers;
  std::istringstream stream(this->Text(tag));
  for (std::string part; std::getline(stream, part, '\\');)
  {
    double number = 0;
    if (!ToDicomNumber(part, number))
    {
      return {};
    }
    numbers.push_back(number);
  }
  return numbers;
}

int DicomAttributes::Integer(std::uint32_t tag, int least, int greatest, int otherwise) const
{
  const std::vector<double> numbers = this->Numbers(tag);
  const bool isGood = numbers.size() == 1 && numbers[0] >= least && numbers[0] <= greatest &&
    numbers[0] == std::floor(numbers[0]);
  return isGood ? static_cast<int>(numbers[0]) : otherwise;
}

std::string DicomTextForPeople(const DicomAttributes& attributes, std::uint32_t tag)
{
  const std::string& set = attributes.Text(DicomTag::SpecificCharacterSet);
  const bool isUtf8 = set.find("192") != std::string::npos;
  const bool isLatin1 = set.find("100") != std::string::npos;
  const std::string& original = attributes.Text(tag);
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
