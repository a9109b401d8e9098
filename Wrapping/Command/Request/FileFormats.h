/**
 * Which files the command reads and writes, by the endings of their names.
 */
#ifndef FlipFreeCommandFileFormats_h
#define FlipFreeCommandFileFormats_h

#include <string>
#include <vector>

namespace Command
{

/// The endings of surfaces that can be read and written.
const std::vector<std::string>& SurfaceEndings();

/// The endings of label maps that can be written.
const std::vector<std::string>& VolumeEndings();

/// The endings of files of points.
const std::vector<std::string>& PointEndings();

/// Whether a file's name has one of these endings, in small or capital letters.
bool HasEnding(const std::string& name, const std::vector<std::string>& endings);

/// Throws WrongUsage, naming the option, unless the name has one of the endings.
void RequireEnding(const std::string& option, const std::string& name,
  const std::vector<std::string>& endings);

/// Whether it is a folder, or a DICOM file of several frames.
bool MayHoldSeries(const std::string& name);

/// Throws Failure where there is no such volume, and WrongUsage for a series of a file.
void RequireVolume(const std::string& name, const std::string& seriesUID);

/// What a summary calls a volume: the file, or the folder and the series in it.
std::string InputTitle(const std::string& name, const std::string& seriesUID);

/// Whether a text can choose a label: whatever is not a number other than a value.
bool IsLabel(const std::string& text);

} // namespace Command

#endif
