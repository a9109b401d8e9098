#include "FileFormats.h"

#include "Failure.h"
#include "UnreadableFile.h"

#include "Exchange/DicomReading.h"
#include "TextWords.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace Command
{

const std::vector<std::string>& SurfaceEndings()
{
  static const std::vector<std::string> endings{ ".vtp", ".stl", ".ply", ".obj" };
  return endings;
}

const std::vector<std::string>& VolumeEndings()
{
  static const std::vector<std::string> endings{ ".nii.gz", ".nii", ".nrrd", ".mha" };
  return endings;
}

const std::vector<std::string>& PointEndings()
{
  static const std::vector<std::string> endings{ ".csv", ".mrk.json" };
  return endings;
}

bool HasEnding(const std::string& name, const std::vector<std::string>& endings)
{
  const std::string small = FlipFree::InSmallLetters(name);
  return std::any_of(endings.begin(), endings.end(),
    [&small](const std::string& ending)
    {
      return small.size() > ending.size() &&
        small.compare(small.size() - ending.size(), ending.size(), ending) == 0;
    });
}

void RequireEnding(const std::string& option, const std::string& name,
  const std::vector<std::string>& endings)
{
  if (HasEnding(name, endings))
  {
    return;
  }
  std::string list;
  for (const std::string& ending : endings)
  {
    list += (list.empty() ? "" : ending == endings.back() ? " or " : ", ") + ending;
  }
  throw WrongUsage(
    option + ": the file extension of '" + name + "' is not supported. Use " + list + ".");
}

bool MayHoldSeries(const std::string& name)
{
  std::error_code ignored;
  return std::filesystem::is_directory(name, ignored) || !FlipFree::DicomFilesOf(name).empty();
}

void RequireVolume(const std::string& name, const std::string& seriesUID)
{
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored))
  {
    throw UnreadableFile(name);
  }
  if (!seriesUID.empty() && !MayHoldSeries(name))
  {
    throw WrongUsage("--series selects a series of a DICOM folder, but '" + name +
      "' is a file. Omit the option, or give the folder.");
  }
}

std::string InputTitle(const std::string& name, const std::string& seriesUID)
{
  return name + (seriesUID.empty() ? "" : ", series " + seriesUID);
}

bool IsLabel(const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool isNumber = *end == '\0';
  const bool isValue = text.find_first_not_of("0123456789") == std::string::npos &&
    number <= std::numeric_limits<int>::max();
  return !text.empty() && (!isNumber || isValue);
}

} // namespace Command
