#include "Messages.h"

#include "FilterReport.h"
#include "ProgressBar.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"

#include <cstdio>
#include <mutex>

#include <fcntl.h>
#include <unistd.h>

namespace Command
{
namespace
{

int UserStream = STDERR_FILENO;
std::mutex ReportLock; // filters may report from several threads
std::string FirstError;

/// Strips VTK's frame from `ERROR: In file, line n\nvtkClass (0x1234): what happened\n\n`.
std::string WithoutTrace(const std::string& report)
{
  std::string text = report;
  const std::string::size_type address = text.find(" (0x");
  const std::string::size_type end = text.find("): ", address);
  if (address != std::string::npos && end != std::string::npos)
  {
    text.erase(0, end + 3);
  }
  else if (text.find("In ") != std::string::npos && text.find('\n') != std::string::npos)
  {
    text.erase(0, text.find('\n') + 1);
  }
  return text;
}

std::string InOneLine(const std::string& text)
{
  std::string line;
  bool gap = false;
  for (const char c : text)
  {
    const bool space = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (!space)
    {
      line += (gap && !line.empty() ? " " : "");
      line += c;
    }
    gap = space;
  }
  return line;
}

void Print(const char* kind, const std::string& message)
{
  ProgressBar::Clear();
  WriteToUser(std::string("flipfree: ") + kind + ": " + InOneLine(message) + "\n");
}

/// Later ones are complaints of other filters about the first.
void KeepFirstError(const std::string& text)
{
  const std::lock_guard<std::mutex> guard(ReportLock);
  if (FirstError.empty())
  {
    FirstError = InOneLine(text);
  }
}

/// What no FilterReports hears of.
class MessageCollector : public vtkOutputWindow
{
public:
  static MessageCollector* New();
  vtkTypeMacro(MessageCollector, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override { KeepFirstError(WithoutTrace(text)); }
  void DisplayWarningText(const char* text) override
  {
    const std::lock_guard<std::mutex> guard(ReportLock);
    PrintWarning(WithoutTrace(text));
  }
  void DisplayGenericWarningText(const char* text) override { this->DisplayWarningText(text); }
};

vtkStandardNewMacro(MessageCollector);

} // namespace

class ReportListener : public vtkCommand
{
public:
  static ReportListener* New() { return new ReportListener; }

  void Execute(vtkObject* caller, unsigned long event, void* text) override
  {
    const char* const message = FlipFree::ReportOf(caller);
    const std::string report = message ? FlipFree::WithNames(message, this->Names)
                                       : WithoutTrace(static_cast<const char*>(text));
    if (event == vtkCommand::ErrorEvent)
    {
      KeepFirstError(report);
      return;
    }
    const std::lock_guard<std::mutex> guard(ReportLock);
    PrintWarning(report);
  }

  FlipFree::QuantityNames Names;
};

void CatchVtkMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<MessageCollector> collector;
  vtkOutputWindow::SetInstance(collector);
}

FilterReports::FilterReports(vtkAlgorithm* filter, const FlipFree::QuantityNames& names)
  : Filter(filter)
{
  const std::lock_guard<std::mutex> guard(ReportLock);
  FirstError.clear();
  this->Listener->Names = names;
  filter->AddObserver(vtkCommand::ErrorEvent, this->Listener);
  filter->AddObserver(vtkCommand::WarningEvent, this->Listener);
}

FilterReports::~FilterReports()
{
  this->Filter->RemoveObserver(this->Listener);
}

std::string FilterReports::Error() const
{
  const std::lock_guard<std::mutex> guard(ReportLock);
  return FirstError;
}

SilentLibraries::SilentLibraries()
  : Original(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3))
{
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (this->Original >= 0 && nowhere >= 0)
  {
    std::fflush(stderr);
    dup2(nowhere, STDERR_FILENO);
    UserStream = this->Original;
  }
  close(nowhere);
}

SilentLibraries::~SilentLibraries()
{
  if (this->Original >= 0)
  {
    std::fflush(stderr);
    dup2(this->Original, STDERR_FILENO);
    UserStream = STDERR_FILENO;
    close(this->Original);
  }
}

void WriteToUser(const std::string& text)
{
  std::string::size_type done = 0;
  while (done < text.size())
  {
    const ssize_t count = write(UserStream, text.data() + done, text.size() - done);
    if (count <= 0)
    {
      return; // nobody is listening
    }
    done += static_cast<std::string::size_type>(count);
  }
}

void PrintError(const std::string& message)
{
  Print("error", message);
}

void PrintWarning(const std::string& message)
{
  Print("warning", message);
}

} // namespace Command
