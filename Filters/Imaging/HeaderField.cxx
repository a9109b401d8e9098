#include "HeaderField.h"

#include "MessageText.h"
#include "VolumeHeader.h"

#include "vtkErrorCode.h"

#include <climits>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace FlipFree
{
namespace
{

/// Values go into messages, which are one line of text.
std::string Printable(const std::string& text)
{
  constexpr std::size_t enough = 40;
  std::string shown = text.substr(0, enough);
  for (char& letter : shown)
  {
    if (letter < ' ' || letter > '~')
    {
      letter = '?';
    }
  }
  return "'" + shown + (text.size() > enough ? "...'" : "'");
}

} // namespace

void RefuseField(const std::string& file, const std::string& field, const std::string& what)
{
  throw ImageFileError(vtkErrorCode::FileFormatError,
    "The header of '" + file + "' cannot be used: " + field + " " + what +
      ". Repair the field, or download or copy the file again.");
}

void RequireLength(const std::string& file, const std::string& field, double value)
{
  constexpr double greatest = 1e9; // mm
  if (!std::isfinite(value))
  {
    RefuseField(file, field, "is " + TextOf(value) + ", not a finite number");
  }
  if (std::abs(value) > greatest)
  {
    RefuseField(file, field, "is " + TextOf(value) + ", beyond 1e9 mm");
  }
}

void RequireSpacing(const std::string& file, const std::string& field, double value)
{
  RequireLength(file, field, value);
  constexpr double least = 1e-9; // mm
  if (std::abs(value) < least)
  {
    RefuseField(file, field, "is " + TextOf(value) + ", but voxels have a size");
  }
}

void TextFields::Add(const std::string& field, const std::string& value)
{
  if (!this->Values.emplace(field, value).second)
  {
    this->Refuse(field, "stands there twice");
  }
}

std::string TextFields::Text(const std::string& field) const
{
  const auto found = this->Values.find(field);
  return found == this->Values.end() ? std::string() : found->second;
}

std::vector<double> TextFields::Numbers(const std::string& field, std::size_t count) const
{
  std::vector<double> numbers;
  for (const std::string& word : Words(this->Text(field)))
  {
    double number = 0;
    if (!ToNumber(word, number))
    {
      this->Refuse(field, "holds " + Printable(word) + ", which is not a number");
    }
    numbers.push_back(number);
  }
  if (numbers.size() != count)
  {
    this->Refuse(field,
      "holds " + std::to_string(numbers.size()) + " numbers, where " + std::to_string(count) +
        " are wanted");
  }
  return numbers;
}

long TextFields::Integer(const std::string& field, long least, long greatest, long otherwise) const
{
  if (!this->Has(field))
  {
    return otherwise;
  }
  const double value = this->Numbers(field, 1).front();
  if (!(value >= static_cast<double>(least)) || !(value <= static_cast<double>(greatest)) ||
    value != std::floor(value))
  {
    this->Refuse(field,
      "is " + TextOf(value) + ", not a whole number from " + std::to_string(least) + " to " +
        std::to_string(greatest));
  }
  return static_cast<long>(value);
}

double TextFields::Voxels(const std::string& field, std::size_t dimension) const
{
  double product = 1;
  for (const double size : this->Numbers(field, dimension))
  {
    if (!(size >= 1) || size > INT_MAX || size != std::floor(size))
    {
      this->Refuse(field, "holds " + TextOf(size) + ", not a number of voxels");
    }
    product *= size;
  }
  return product;
}

void TextFields::Refuse(const std::string& field, const std::string& what) const
{
  RefuseField(this->File, field, what);
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
  char* end = nullptr;
  number = std::strtod(text.c_str(), &end);
  return !text.empty() && end == text.c_str() + text.size();
}

std::vector<std::string> NumberedFiles(const TextFields& fields, const std::string& field,
  const std::string& pattern, long first, long last, long step)
{
  // It becomes the format of a printf: anything but one whole number of few digits would read or
  // write where it must not.
  const std::size_t begin = pattern.find('%');
  std::size_t end = pattern.find_first_not_of("0123456789", begin + 1);
  const bool isNumber = end != std::string::npos && end - begin <= 3 && pattern[end] == 'd' &&
    pattern.find('%', end) == std::string::npos;
  if (!isNumber)
  {
    fields.Refuse(field,
      "is the pattern " + Printable(pattern) + ", which is not one such as %03d");
  }
  constexpr long most = 100000;
  if (step < 1 || last < first || (last - first) / step >= most)
  {
    fields.Refuse(field, "does not number its files from a first one to a last one");
  }
  const std::size_t digits = std::strtoul(pattern.c_str() + begin + 1, nullptr, 10);
  const char fill = pattern[begin + 1] == '0' ? '0' : ' ';
  std::vector<std::string> files;
  for (long number = first; number <= last; number += step)
  {
    std::string text = std::to_string(number);
    text.insert(0, digits > text.size() ? digits - text.size() : 0, fill);
    files.push_back(pattern.substr(0, begin) + text + pattern.substr(end + 1));
  }
  return files;
}

} // namespace FlipFree
