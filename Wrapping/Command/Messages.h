/**
 * Messages to the user on the standard error stream, each a single line such as
 * `flipfree: error: ...`. VTK's own reports are collected, so that the first error can be printed
 * in this form, without source files and addresses.
 */
#ifndef FlipFreeCommandMessages_h
#define FlipFreeCommandMessages_h

#include "QuantityNames.h"

#include "vtkNew.h"

#include <string>

class vtkAlgorithm;

namespace Command
{

class ReportListener;

/// From now on VTK prints nothing itself.
void CatchVtkMessages();

/// Collects what a filter and its pipeline report while this object lives. Warnings are printed at
/// once. `names` are the options that set the filter's properties.
class FilterReports
{
public:
  FilterReports(vtkAlgorithm* filter, const FlipFree::QuantityNames& names);
  ~FilterReports();
  FilterReports(const FilterReports&) = delete;
  void operator=(const FilterReports&) = delete;

  /// The first error so far; empty if there is none.
  std::string Error() const;

private:
  vtkAlgorithm* Filter;
  vtkNew<ReportListener> Listener;
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
