#include "OutputNames.h"

#include "Failure.h"
#include "FileFormats.h"
#include "OptionTable.h"

#include <filesystem>

namespace Command
{
namespace
{

namespace fs = std::filesystem;

bool SameFile(const std::string& a, const std::string& b)
{
  std::error_code ignored;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, ignored), ignored);
  const fs::path second = fs::weakly_canonical(fs::absolute(b, ignored), ignored);
  return first == second || (fs::exists(first, ignored) && fs::equivalent(first, second, ignored));
}

[[noreturn]] void RefuseSameName(const std::string& option, const std::string& other,
  const std::string& name)
{
  throw WrongUsage(
    option + " and " + other + " name the same file, '" + name + "'. Give each one of its own.");
}

} // namespace

void RequireOutputs(const std::vector<RequestedFile>& files)
{
  std::vector<std::string> options;
  bool isRequested = false;
  for (const RequestedFile& file : files)
  {
    options.push_back(file.Option);
    isRequested = isRequested || !file.Name.empty();
  }
  if (!isRequested)
  {
    const std::string last = options.back();
    options.pop_back();
    throw WrongUsage("No output is requested. Give at least one of " + Joined(options, ", ") +
      " and " + last + ".");
  }
  for (const RequestedFile& file : files)
  {
    if (!file.Name.empty())
    {
      RequireEnding(file.Option, file.Name, file.Endings);
    }
  }
}

void AnnounceFiles(const std::vector<RequestedFile>& files, const std::vector<std::string>& inputs,
  const Announce& announce)
{
  for (const RequestedFile& file : files)
  {
    if (!file.Name.empty())
    {
      announce(file.Option, file.Name, inputs);
    }
  }
}

void OutputNames::Add(const std::string& option, const std::string& name,
  const std::vector<std::string>& inputs)
{
  for (const std::string& input : inputs)
  {
    if (SameFile(name, input))
    {
      throw WrongUsage(
        "'" + name + "' is an input, which would be overwritten. Give the result another name.");
    }
  }
  for (const auto& [other, file] : this->Added)
  {
    if (other != option && SameFile(name, file)) // the same option has a file of all organs
    {
      RefuseSameName(other, option, name);
    }
  }
  this->Added.emplace_back(option, name);
}

} // namespace Command
