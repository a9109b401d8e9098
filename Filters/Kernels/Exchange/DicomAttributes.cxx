#include "Exchange/DicomAttributes.h"

#include "TextWords.h"

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
  return TextForPeople(attributes.Text(tag), isUtf8, isLatin1);
}

} // namespace FlipFree
