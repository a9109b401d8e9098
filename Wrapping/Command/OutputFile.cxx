#include "OutputFile.h"

#include "Failure.h"
#include "Messages.h"
#include "Run.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

namespace Command
{
namespace
{

namespace fs = std::filesystem;

/// What a name leads to, through symbolic links: the link stays, its target is replaced.
fs::path Destination(const std::string& name)
{
  std::error_code ignored;
  const fs::path path(name);
  return fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
}

/// In the same folder, hence on the same disk, and with the same ending.
std::string TemporaryName(const fs::path& destination)
{
  static std::random_device random;
  const std::string name =
    ".flipfree-" + std::to_string(random()) + "-" + destination.filename().string();
  return (destination.parent_path() / name).string();
}

bool SameFile(const std::string& a, const std::string& b)
{
  std::error_code ignored;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, ignored), ignored);
  const fs::path second = fs::weakly_canonical(fs::absolute(b, ignored), ignored);
  return first == second || (fs::exists(first, ignored) && fs::equivalent(first, second, ignored));
}

void RequireFolderTakesFiles(const std::string& name)
{
  const fs::path destination = Destination(name);
  const fs::path folder = destination.has_parent_path() ? destination.parent_path() : ".";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
  {
    throw Failure("'" + name + "' cannot be written: there is no folder '" + folder.string() +
      "'. Make it first.");
  }
  if (fs::is_directory(destination, ignored))
  {
    throw Failure(
      "'" + name + "' cannot be written: it is a folder. Give the name of a file in it.");
  }
  const std::string probe = TemporaryName(destination);
  const bool works = std::ofstream(probe).is_open();
  const int reason = errno;
  fs::remove(probe, ignored);
  if (!works)
  {
    throw Failure("'" + name + "' cannot be written: its folder '" + folder.string() +
      "' does not take files (" + std::strerror(reason) +
      "). Check its permissions, or write elsewhere.");
  }
}

} // namespace

bool HasEnding(const std::string& name, const std::vector<std::string>& endings)
{
  std::string small = name;
  std::transform(small.begin(), small.end(), small.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(endings.begin(), endings.end(),
    [&small](const std::string& ending)
    {
      return small.size() > ending.size() &&
        small.compare(small.size() - ending.size(), ending.size(), ending) == 0;
    });
}

void RequireEnding(const std::string& option, const std::string& name,
  const std::vector<std::string>& endings)
{
  if (!HasEnding(name, endings))
  {
    std::string list;
    for (const std::string& ending : endings)
    {
      list += (list.empty() ? "" : ending == endings.back() ? " or " : ", ") + ending;
    }
    throw WrongUsage(
      option + ": the ending of '" + name + "' stands for no format known here. Use " + list + ".");
  }
}

void OutputFiles::Announce(const std::string& name, const std::vector<std::string>& inputs)
{
  for (const std::string& input : inputs)
  {
    if (SameFile(name, input))
    {
      throw WrongUsage(
        "'" + name + "' is an input, which would be overwritten. Give the result another name.");
    }
  }
  RequireFolderTakesFiles(name);
  this->Files.push_back({ name, std::string() });
}

void OutputFiles::Write(const std::string& name,
  const std::function<void(const std::string&)>& write)
{
  StopIfInterrupted();
  const auto file = std::find_if(this->Files.begin(), this->Files.end(),
    [&name](const File& f) { return f.Name == name; });
  if (file == this->Files.end())
  {
    throw std::logic_error("'" + name + "' was not announced");
  }
  file->Temporary = TemporaryName(Destination(name));
  try
  {
    write(file->Temporary);
  }
  catch (const Failure& failure)
  {
    throw Failure(Replaced(failure.what(), file->Temporary, name));
  }
}

void OutputFiles::Commit()
{
  StopIfInterrupted();
  for (File& file : this->Files)
  {
    std::error_code failure;
    if (!file.Temporary.empty())
    {
      fs::rename(file.Temporary, Destination(file.Name), failure);
    }
    if (failure)
    {
      throw Failure("'" + file.Name + "' cannot be written: " + failure.message() +
        ". Check whether something else of that name is in the way.");
    }
    file.Temporary.clear();
  }
}

OutputFiles::~OutputFiles()
{
  for (const File& file : this->Files)
  {
    std::error_code ignored;
    if (!file.Temporary.empty())
    {
      fs::remove(file.Temporary, ignored);
    }
  }
}

void WriteBytes(const std::string& name, const char* bytes, std::size_t count)
{
  std::ofstream stream(name, std::ios::binary);
  stream.write(bytes, static_cast<std::streamsize>(count));
  stream.close();
  if (!stream)
  {
    throw Failure("'" + name + "' cannot be written: " + std::strerror(errno) +
      ". Make room on the disk, or write elsewhere.");
  }
}

} // namespace Command
