/**
 * Files of text: tables, markups.
 */
#ifndef FlipFreeCommandTextFile_h
#define FlipFreeCommandTextFile_h

#include <string>

namespace Command
{

/// Without the mark that some programs put in front of UTF-8. Throws Failure.
std::string ReadText(const std::string& name);

} // namespace Command

#endif
