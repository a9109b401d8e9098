#include "OutputFile.h"

#include "Failure.h"
#include "Interrupt.h"
#include "Run.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace Command
{
namespace
{

namespace fs = std::filesystem;

std::string Replaced(std::string text, const std::string& from, const std::string& to)
{
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
  {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Does what works with a FlipFree::AtomicFile, whose errors become failures.
template <typename Work>
auto WithFile(const Work& work)
{
  try
  {
    return work();
  }
  catch (const FlipFree::FileError& error)
  {
    throw Failure(error.what());
  }
}

/// Its folder goes even where the command is ended in the middle.
std::unique_ptr<FlipFree::AtomicFile> MakeFile(const std::string& name)
{
  const Uninterrupted whole;
  auto file = std::make_unique<FlipFree::AtomicFile>(name);
  AddTemporaryFolder(fs::path(file->TemporaryName()).parent_path().string());
  return file;
}

} // namespace

OutputFolder::OutputFolder(const std::string& name)
  : Name(name)
{
  std::error_code failure;
  this->IsNew = fs::create_directory(name, failure);
  if (fs::exists(name) && !fs::is_directory(name))
  {
    throw Failure("'" + name + "' is not a folder. Choose another name.");
  }
  if (!fs::is_directory(name))
  {
    throw Failure("The folder '" + name + "' cannot be created (" + failure.message() +
      "). Check the name and the permissions of its parent folder.");
  }
}

OutputFolder::~OutputFolder()
{
  if (this->IsNew)
  {
    std::error_code isNotEmpty;
    fs::remove(this->Name, isNotEmpty);
  }
}

void OutputFiles::Announce(const std::string& option, const std::string& name,
  const std::vector<std::string>& inputs)
{
  this->Announced.Add(option, name, inputs);
  const Uninterrupted whole;
  WithFile([&name]() { FlipFree::AtomicFile probe(name); });
}

Announce OutputFiles::Announcing()
{
  return [this](const std::string& option, const std::string& name,
           const std::vector<std::string>& inputs) { this->Announce(option, name, inputs); };
}

void OutputFiles::Write(const std::string& name,
  const std::function<void(const std::string&)>& write)
{
  StopIfInterrupted();
  WithFile(
    [&]()
    {
      auto file = MakeFile(name);
      try
      {
        write(file->TemporaryName());
      }
      catch (const Failure& failure)
      {
        throw Failure(Replaced(failure.what(), file->TemporaryName(), name));
      }
      file->Flush();
      this->Files.push_back(std::move(file));
    });
}

void OutputFiles::Commit()
{
  const Uninterrupted whole;
  StopIfInterrupted();
  for (const auto& file : this->Files)
  {
    WithFile([&file]() { file->Publish(); });
  }
  this->Files.clear();
}

void WriteBytes(const std::string& name, const char* bytes, std::size_t count)
{
  std::ofstream stream(name, std::ios::binary);
  stream.write(bytes, static_cast<std::streamsize>(count));
  stream.close();
  if (!stream)
  {
    throw Failure("'" + name + "' cannot be written: " + std::strerror(errno) +
      ". Free some disk space, or write elsewhere.");
  }
}

void WriteText(const std::string& name, const std::string& text)
{
  WriteBytes(name, text.data(), text.size());
}

} // namespace Command
