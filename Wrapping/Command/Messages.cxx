#include "Messages.h"

#include "Failure.h"
#include "ProgressBar.h"

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
std::mutex Lock; // filters may report from their threads
std::string FirstError;

/// `ERROR: In file, line n\nvtkClass (0x1234): what happened\n\n` without all that is VTK's.
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

/// As one line.
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

class MessageCollector : public vtkOutputWindow
{
public:
  static MessageCollector* New();
  vtkTypeMacro(MessageCollector, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override
  {
    const std::lock_guard<std::mutex> guard(Lock);
    if (FirstError.empty()) // what follows is other filters' complaint about the first
    {
      FirstError = InOneLine(WithoutTrace(text));
    }
  }
  void DisplayWarningText(const char* text) override
  {
    const std::lock_guard<std::mutex> guard(Lock);
    PrintWarning(WithOptionNames(WithoutTrace(text)));
  }
  void DisplayGenericWarningText(const char* text) override
  {
    // VTK's reader of PLY files would go on beyond the end of a truncated one, and crash.
    if (std::string(text).find("PLY error") != std::string::npos)
    {
      throw Failure(WithoutTrace(text));
    }
    this->DisplayWarningText(text);
  }
};

vtkStandardNewMacro(MessageCollector);

} // namespace

void CatchVtkMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<MessageCollector> collector;
  vtkOutputWindow::SetInstance(collector);
}

std::string TakeVtkError()
{
  const std::lock_guard<std::mutex> guard(Lock);
  std::string error;
  error.swap(FirstError);
  return error;
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
      return; // nobody is there to be told
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

std::string Replaced(std::string text, const std::string& from, const std::string& to)
{
  for (std::string::size_type at = 0; (at = text.find(from, at)) != std::string::npos;
       at += to.size())
  {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string WithOptionNames(std::string text)
{
  const std::pair<const char*, const char*> names[] = { { "FeatureThreshold", "--threshold" },
    { "ForegroundMass", "--foreground-mass" }, { "NoiseWidening", "--noise-widening" },
    { "SearchDistance", "--search-distance" }, { "MaximumDisplacement", "--maximum-displacement" },
    { "raise Reach", "raise --reach" }, { "lower Levels", "lower --levels" },
    { " (port 1) has the ", " has the " }, { "SegmentationLabel", "--segmentation-label" },
    { "ReferenceLabel", "--reference-label" }, { "lower SeedRadius", "lower --radius" },
    { "move SeedCenter", "move --seed" } };
  for (const auto& name : names)
  {
    text = Replaced(text, name.first, name.second);
  }
  return text;
}

} // namespace Command
