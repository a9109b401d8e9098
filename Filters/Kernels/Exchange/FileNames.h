/**
 * Names of files in messages, whatever the system's separator is.
 */
#ifndef FlipFreeFileNames_h
#define FlipFreeFileNames_h

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
  const std::string wanted = "dicomdir";
  const std::string name = FileNameOf(path);
  return std::equal(name.begin(), name.end(), wanted.begin(), wanted.end(),
    [](unsigned char letter, unsigned char small) { return std::tolower(letter) == small; });
}

/// In small letters, with its period.
inline std::string ExtensionOf(const std::string& path)
{
  const std::string name = FileNameOf(path);
  const std::size_t period = name.find_last_of('.');
  std::string extension = period == std::string::npos ? "" : name.substr(period);
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

} // namespace FlipFree

#endif
