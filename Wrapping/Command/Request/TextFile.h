/**
 * Whole files, and those of text: tables, markups.
 */
#ifndef FlipFreeCommandTextFile_h
#define FlipFreeCommandTextFile_h

#include <string>

namespace Command
{

/// Throws Failure where there is no such file, or it cannot be read.
std::string ReadBytes(const std::string& name);

/// Without the mark that some programs put in front of UTF-8. Throws Failure.
std::string ReadText(const std::string& name);

} // namespace Command

#endif
