/**
 * What the user reads where a file does not open, whatever it was to hold.
 */
#ifndef FlipFreeCommandUnreadableFile_h
#define FlipFreeCommandUnreadableFile_h

#include "Failure.h"

#include <filesystem>
#include <string>

namespace Command
{

inline Failure UnreadableFile(const std::string& name)
{
  std::error_code ignored;
  return Failure(std::filesystem::exists(name, ignored)
      ? "'" + name + "' cannot be read. Check the name and the permissions."
      : "There is no file '" + name + "'. Check the name and the folder.");
}

} // namespace Command

#endif
