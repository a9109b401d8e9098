/**
 * What the command tells its user on the standard error stream, always one line at a time:
 * `flipfree: error: ...`. VTK's own reports are caught and kept, so that the one that matters can
 * be told in this form and no trace of source files and addresses gets through.
 */
#ifndef FlipFreeCommandMessages_h
#define FlipFreeCommandMessages_h

#include <string>

namespace Command
{

/// From now on VTK writes nothing itself.
void CatchVtkMessages();

/// The first error that VTK has reported since the last call, without its trace; empty if none.
std::string TakeVtkError();

/// While it lives, nothing that libraries write to the standard error stream themselves gets there:
/// those under ITK's readers and writers print what we tell, too, in a form of their own.
class SilentLibraries
{
public:
  SilentLibraries();
  ~SilentLibraries();
  SilentLibraries(const SilentLibraries&) = delete;
  void operator=(const SilentLibraries&) = delete;

private:
  int Original;
};

/// The standard error stream, even while libraries are silent.
void WriteToUser(const std::string& text);

void PrintError(const std::string& message);
void PrintWarning(const std::string& message);

/// A filter's message with the command's options in place of the filter's properties.
std::string WithOptionNames(std::string text);

/// `text` with every `from` replaced, for messages that name a port or a temporary file.
std::string Replaced(std::string text, const std::string& from, const std::string& to);

} // namespace Command

#endif
