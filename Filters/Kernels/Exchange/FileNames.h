/**
 * Names of files in messages, whatever the system's separator is.
 */
#ifndef FlipFreeFileNames_h
#define FlipFreeFileNames_h

#include "TextWords.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace FlipFree
{

inline std::string InQuotes(const std::string& name)
{
  return "'" + name + "'";
}

/// Without its folder.
inline std::string FileNameOf(const std::string& path)
{
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// Whether a file has the name of those that list the other files of a medium (DICOM PS3.10).
inline bool IsDicomDirectory(const std::string& path)
{
  return InSmallLetters(FileNameOf(path)) == "dicomdir";
}

/// In small letters, with its period.
inline std::string ExtensionOf(const std::string& path)
{
  const std::string name = FileNameOf(path);
  const std::size_t period = name.find_last_of('.');
  return period == std::string::npos ? "" : InSmallLetters(name.substr(period));
}

/// A part of a name: what is no letter, digit, dot or hyphen becomes an underscore. Letters beyond
/// ASCII stay.
inline std::string FileNamePart(std::string text)
{
  std::replace_if(
    text.begin(), text.end(),
    [](unsigned char code)
    { return code < 0x80 && !std::isalnum(code) && code != '.' && code != '-'; },
    '_');
  return text;
}

/// Of a label's surface: LABEL.ending, or LABEL-NAME.ending.
inline std::string LabelFileName(int label, const std::string& name, const std::string& ending)
{
  const std::string part = FileNamePart(name);
  return std::to_string(label) + (part.empty() ? "" : "-" + part) + "." + ending;
}

} // namespace FlipFree

#endif
