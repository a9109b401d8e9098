#include "Messages.h"

#include "ProgressBar.h"

#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"

#include <cstdio>
#include <mutex>
#include <regex>

#include <fcntl.h>
#include <unistd.h>

namespace Command
{
namespace
{

int UserStream = STDERR_FILENO;
std::mutex ReportLock; // filters may report from several threads
std::string FirstError;
OptionNames Names;

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

/// Word by word, so that the names of properties do not depend on the phrases they stand in. What
/// is quoted is the user's and stays: an organ may have the name of a property. Quotes begin where
/// no word ends and end where none begins, so they are no apostrophes.
std::string WithOptionNames(const std::string& text)
{
  if (Names.empty())
  {
    return text;
  }
  static const std::regex part(
    R"('[\s\S]*?'(?![A-Za-z0-9])|( on port [0-9]| \(port [0-9]\))|([A-Za-z0-9]+)'*)");
  std::string result;
  std::string::const_iterator rest = text.begin();
  for (std::sregex_iterator match(text.begin(), text.end(), part), end; match != end; ++match)
  {
    result.append(rest, (*match)[0].first);
    rest = (*match)[0].second;
    const auto name = Names.find((*match)[2].str());
    if (name != Names.end())
    {
      result.append(name->second).append((*match)[2].second, rest);
    }
    else if (!(*match)[1].matched) // a port
    {
      result.append(match->str());
    }
  }
  return result.append(rest, text.end());
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
    const std::lock_guard<std::mutex> guard(ReportLock);
    if (FirstError.empty()) // later ones are complaints of other filters about the first
    {
      FirstError = InOneLine(WithOptionNames(WithoutTrace(text)));
    }
  }
  void DisplayWarningText(const char* text) override
  {
    const std::lock_guard<std::mutex> guard(ReportLock);
    PrintWarning(WithOptionNames(WithoutTrace(text)));
  }
  void DisplayGenericWarningText(const char* text) override { this->DisplayWarningText(text); }
};

vtkStandardNewMacro(MessageCollector);

} // namespace

void CatchVtkMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<MessageCollector> collector;
  vtkOutputWindow::SetInstance(collector);
}

FilterReports::FilterReports(const OptionNames& names)
{
  const std::lock_guard<std::mutex> guard(ReportLock);
  FirstError.clear();
  Names = names;
}

FilterReports::~FilterReports()
{
  const std::lock_guard<std::mutex> guard(ReportLock);
  Names.clear();
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
