#include "Exchange/HeaderField.h"

#include "MessageText.h"
#include "TextWords.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <sstream>

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

std::string SizesText(const std::vector<double>& sizes)
{
  std::ostringstream text;
  for (std::size_t axis = 0; axis < sizes.size(); ++axis)
  {
    text << (axis ? " x " : "") << static_cast<long>(sizes[axis]);
  }
  return text.str();
}

/// Files numbered from `first` to `last`. Throws where the pattern has anything but one whole
/// number.
std::vector<std::string> NumberedFiles(const TextFields& fields, const std::string& field,
  const std::string& pattern, long first, long last, long step)
{
  const std::size_t begin = pattern.find('%');
  const std::size_t end = pattern.find_first_not_of("0123456789", begin + 1);
  const bool isNumber = end != std::string::npos && end - begin <= 3 && pattern[end] == 'd' &&
    pattern.find('%', end) == std::string::npos;
  if (!isNumber)
  {
    fields.Refuse(field,
      "is the pattern " + Printable(pattern) + ", which is not one such as %03d");
  }
  constexpr long most = 100000;
  const bool isTowards = last == first || (last < first) == (step < 0);
  if (step == 0 || !isTowards || (last - first) / step >= most)
  {
    fields.Refuse(field, "does not number its files from a first one to a last one");
  }
  const std::size_t digits = std::strtoul(pattern.c_str() + begin + 1, nullptr, 10);
  const char fill = pattern[begin + 1] == '0' ? '0' : ' ';
  std::vector<std::string> files;
  for (long index = 0; index <= (last - first) / step; ++index)
  {
    std::string text = std::to_string(first + index * step);
    text.insert(0, digits > text.size() ? digits - text.size() : 0, fill);
    files.push_back(pattern.substr(0, begin) + text + pattern.substr(end + 1));
  }
  return files;
}

} // namespace

void RefuseField(const std::string& file, const std::string& field, const std::string& what)
{
  throw FileProblem(FileProblem::Kind::Unusable,
    "The header of '" + file + "' cannot be used: " + field + " " + what +
      ". Repair the field, or download or copy the file again.");
}

bool IsLength(double value)
{
  return std::abs(value) <= GreatestLength;
}

std::string WhyNoLength(double value)
{
  return IsLength(value)   ? std::string()
    : std::isfinite(value) ? "is " + TextOf(value) + ", beyond " + TextOf(GreatestLength) + " mm"
                           : "is " + TextOf(value) + ", not a finite number";
}

void RequireLength(const std::string& file, const std::string& field, double value)
{
  const std::string fault = WhyNoLength(value);
  if (!fault.empty())
  {
    RefuseField(file, field, fault);
  }
}

void RequireSpacing(const std::string& file, const std::string& field, double value)
{
  RequireLength(file, field, value);
  // Readers disagree whether a negative spacing mirrors the image; left and right are at stake.
  if (value < 0)
  {
    RefuseField(file, field, "is negative, but a spacing must be positive");
  }
  if (value < LeastSpacing)
  {
    RefuseField(file, field, "is " + TextOf(value) + ", but voxels have a size");
  }
}

std::array<int, 3> VolumeSize(const std::string& file, const std::vector<double>& sizes)
{
  const std::string count = std::to_string(sizes.size());
  if (sizes.size() < 3)
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      "'" + file + "' is an image of " + count + " dimensions (" + SizesText(sizes) +
        "), not a volume. Give a volume, or the folder of the DICOM series that the slice belongs "
        "to.");
  }
  // A fourth axis of one time point is only a way of writing a volume.
  if (std::any_of(sizes.begin() + 3, sizes.end(), [](double size) { return size > 1; }))
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      "'" + file + "' has " + count + " dimensions (" + SizesText(sizes) +
        "). Extract one volume of the series into a file of its own.");
  }
  return { { static_cast<int>(sizes[0]), static_cast<int>(sizes[1]), static_cast<int>(sizes[2]) } };
}

void RefuseComponents(const std::string& file, long count)
{
  throw FileProblem(FileProblem::Kind::Unusable,
    "'" + file + "' has " + std::to_string(count) +
      " components per voxel, but only one is supported. Extract one component, or convert colors "
      "to gray.");
}

ImageGeometry GridOfSteps(const std::string& file, const std::array<int, 3>& size,
  const Eigen::Matrix3d& steps, const Eigen::Vector3d& origin)
{
  ImageGeometry grid;
  grid.Dimensions = size;
  grid.Origin = origin.array() + 0.0; // no minus zero
  grid.Spacing = steps.colwise().norm();
  grid.Direction = (steps * grid.Spacing.cwiseInverse().asDiagonal()).array() + 0.0;
  if (!grid.Origin.allFinite() || !grid.Direction.allFinite() ||
    grid.Spacing.minCoeff() < LeastSpacing ||
    std::abs(grid.Direction.determinant()) < LeastDeterminant)
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      "'" + file + "' has no usable geometry: origin " + TextOf(grid.Origin) + ", spacing " +
        TextOf(grid.Spacing) + ", determinant of the direction matrix " +
        TextOf(grid.Direction.determinant()) +
        ". Spacings must be positive and the directions independent: mend its header.");
  }
  return grid;
}

void RequireLengthOfVoxels(const std::string& file, const std::string& field,
  const VoxelStorage& storage)
{
  if (storage.IsAtEnd && storage.Form != VoxelStorage::Coding::Raw)
  {
    RefuseField(file, field,
      "is -1, for voxels at the end of the file, but only raw ones have a length that is known");
  }
}

void WarnOfUnsaid(const std::string& file, const std::vector<Unsaid>& unsaid,
  std::vector<std::string>& warnings)
{
  const char* const taken[] = { "how large its voxels are (1 mm was taken)",
    "how its axes lie in the patient (left, posterior and superior were taken)",
    ("how its axes lie in the patient other than by names (AnatomicalOrientation), which programs "
     "read differently (left, posterior and superior were taken)"),
    "how its axes lie in its space (along the axes of the space was taken)",
    "where its first voxel is (the origin was taken)",
    "in which order the bytes of its voxels are (the least significant first was taken)" };
  std::string list;
  for (std::size_t index = 0; index < unsaid.size(); ++index)
  {
    const bool isLast = index > 0 && index + 1 == unsaid.size();
    list += isLast ? " and " : (index > 0 ? ", " : "");
    list += taken[static_cast<int>(unsaid[index])];
  }
  if (!list.empty())
  {
    warnings.push_back("'" + file + "' does not say " + list + ".");
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

std::vector<double> TextFields::Numbers(const std::string& field) const
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
  return numbers;
}

std::vector<double> TextFields::Numbers(const std::string& field, std::size_t count) const
{
  std::vector<double> numbers = this->Numbers(field);
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

std::vector<double> TextFields::Sizes(const std::string& field, std::size_t dimension) const
{
  std::vector<double> sizes = this->Numbers(field, dimension);
  for (const double size : sizes)
  {
    if (!(size >= 1) || size > INT_MAX || size != std::floor(size))
    {
      this->Refuse(field, "holds " + TextOf(size) + ", not a number of voxels");
    }
  }
  return sizes;
}

void TextFields::Refuse(const std::string& field, const std::string& what) const
{
  RefuseField(this->File, field, what);
}

bool LineReader::Next(std::string& line)
{
  if (this->Begin >= this->Text.size())
  {
    return false;
  }
  const std::size_t end = std::min(this->Text.find('\n', this->Begin), this->Text.size());
  line = this->Text.substr(this->Begin, end - this->Begin);
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  this->Begin = std::min(end + 1, this->Text.size());
  return true;
}

bool IsFileList(const TextFields& fields, const std::string& field)
{
  const std::vector<std::string> words = Words(fields.Text(field));
  return !words.empty() && words.front() == "LIST";
}

std::vector<std::string> FilesOfField(const TextFields& fields, const std::string& field,
  const std::vector<std::string>& lines, bool needsStep)
{
  const std::string place = fields.Text(field);
  const std::vector<std::string> words = Words(place);
  std::vector<std::string> files{ place };
  if (IsFileList(fields, field))
  {
    files = lines;
  }
  else if (place.find('%') != std::string::npos)
  {
    double numbers[3] = { 1, 1, 1 };
    bool areNumbers = words.size() == 4 || (words.size() == 3 && !needsStep);
    for (std::size_t index = 0; areNumbers && index + 1 < words.size(); ++index)
    {
      areNumbers = ToNumber(words[index + 1], numbers[index]) && std::abs(numbers[index]) < INT_MAX;
    }
    if (!areNumbers)
    {
      fields.Refuse(field, "is not a pattern with its first, its last and a step");
    }
    files = NumberedFiles(fields, field, words.front(), static_cast<long>(numbers[0]),
      static_cast<long>(numbers[1]), static_cast<long>(numbers[2]));
  }
  files.erase(std::remove(files.begin(), files.end(), std::string()), files.end());
  if (files.empty())
  {
    fields.Refuse(field, "names no file");
  }
  return files;
}

} // namespace FlipFree
