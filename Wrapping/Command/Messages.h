/**
 * Messages to the user on the standard error stream, each a single line such as
 * `flipfree: error: ...`. VTK's own reports are collected, so that the first error can be printed
 * in this form, without source files and addresses.
 */
#ifndef FlipFreeCommandMessages_h
#define FlipFreeCommandMessages_h

#include <map>
#include <string>

namespace Command
{

/// What the command calls a filter's properties: options by property.
using OptionNames = std::map<std::string, std::string>;

/// From now on VTK prints nothing itself.
void CatchVtkMessages();

/// Collects what a filter reports while this object lives. Warnings are printed at once. In both,
/// properties are called by their options, and ports are left out, if `names` is not empty.
class FilterReports
{
public:
  explicit FilterReports(const OptionNames& names);
  ~FilterReports();
  FilterReports(const FilterReports&) = delete;
  void operator=(const FilterReports&) = delete;

  /// The first error so far; empty if there is none.
  std::string Error() const;
};

/// While this object lives, libraries that write to the standard error stream themselves write
/// nowhere: those below ITK's readers and writers would repeat our messages in their own form.
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

/// Writes to the standard error stream, even while libraries are silent.
void WriteToUser(const std::string& text);

void PrintError(const std::string& message);
void PrintWarning(const std::string& message);

} // namespace Command

#endif
