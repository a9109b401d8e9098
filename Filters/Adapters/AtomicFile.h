/**
 * Private to the project, never installed: a file that is written whole or not at all.
 *
 * The file is written under its own name in a temporary folder beside its destination, so on the
 * same disk; flushed; and renamed. Until then a former file of that name is untouched. The folder
 * goes with the object, so a failure or an interrupt that unwinds leaves nothing behind; a process
 * that is killed leaves at most that folder, whose name begins with ".flipfree-".
 */
#ifndef FlipFreeAtomicFile_h
#define FlipFreeAtomicFile_h

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace FlipFree
{

/// Says which file cannot be written, why, and what to do.
struct FileError : std::runtime_error
{
  FileError(const std::string& name, const std::string& why)
    : std::runtime_error("'" + name + "' cannot be written: " + why)
  {
  }
};

class AtomicFile
{
public:
  /// Creates the temporary folder. A symbolic link is followed: its target will be replaced. Throws
  /// FileError if the folder is missing or takes no files, or if the name belongs to something that
  /// is not a regular file.
  explicit AtomicFile(const std::string& name)
    : Name(name)
    , Destination(FollowLinks(name))
  {
    const std::filesystem::path parent = this->Parent();
    std::error_code ignored;
    if (!std::filesystem::is_directory(parent, ignored))
    {
      throw FileError(name,
        std::filesystem::exists(parent, ignored)
          ? "'" + parent.string() + "' is not a folder. Write elsewhere."
          : "there is no folder '" + parent.string() + "'. Create it first.");
    }
    const auto status = std::filesystem::status(this->Destination, ignored);
    if (std::filesystem::is_directory(status))
    {
      throw FileError(name, "it is a folder. Give the name of a file in it.");
    }
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    {
      throw FileError(name, "it is not a regular file. Give another name.");
    }
    std::string folder = (parent / ".flipfree-XXXXXX").string();
    if (!mkdtemp(&folder[0]))
    {
      throw FileError(name,
        "its folder '" + parent.string() + "' does not take files (" +
          std::generic_category().message(errno) +
          "). Check its permissions and the space on the disk, or write elsewhere.");
    }
    this->Folder = folder;
  }
  ~AtomicFile() { this->Discard(); }
  AtomicFile(const AtomicFile&) = delete;
  void operator=(const AtomicFile&) = delete;

  /// Where to write. Further files in the same folder go with this one.
  std::string TemporaryName() const
  {
    return (this->Folder / this->Destination.filename()).string();
  }

  /// Waits until what was written is on the disk. Throws FileError if the disk refuses it.
  void Flush() const
  {
    for (const std::filesystem::path& written : this->WrittenFiles())
    {
      const int file = open(written.c_str(), O_RDONLY | O_CLOEXEC);
      // EINVAL: the file system cannot be asked.
      const bool flushed = file >= 0 && (fsync(file) == 0 || errno == EINVAL);
      const int reason = errno;
      if (file >= 0)
      {
        close(file);
      }
      if (!flushed)
      {
        throw FileError(this->Name,
          std::generic_category().message(reason) + ". Free some disk space, or write elsewhere.");
      }
    }
  }

  /// Gives the files their names, the one that was asked for last, since it may refer to the
  /// others. Each keeps the permissions of the file that it replaces. Throws FileError.
  void Publish()
  {
    for (const std::filesystem::path& written : this->WrittenFiles())
    {
      if (written != this->TemporaryName())
      {
        this->Rename(written, this->Parent() / written.filename());
      }
    }
    this->Rename(this->TemporaryName(), this->Destination);
    this->Discard();
    const int parent = open(this->Parent().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (parent >= 0)
    {
      fsync(parent); // where that fails, the new names may be lost with the power, but no content
      close(parent);
    }
  }

  /// Removes what has been written and not published.
  void Discard() const
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Folder, ignored);
  }

private:
  static std::filesystem::path FollowLinks(std::filesystem::path path)
  {
    constexpr int maximumLinks = 40; // as Linux has it; then they go round in a circle
    std::error_code failure;
    for (int links = 0; links < maximumLinks && std::filesystem::is_symlink(path, failure); ++links)
    {
      path = path.parent_path() / std::filesystem::read_symlink(path, failure);
    }
    return path;
  }

  std::filesystem::path Parent() const
  {
    return this->Destination.has_parent_path() ? this->Destination.parent_path() : ".";
  }

  std::vector<std::filesystem::path> WrittenFiles() const
  {
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (std::filesystem::directory_iterator entry(this->Folder, ignored), end; entry != end;
         entry.increment(ignored))
    {
      files.push_back(entry->path());
    }
    return files;
  }

  void Rename(const std::filesystem::path& from, const std::filesystem::path& to) const
  {
    std::error_code failure;
    const auto former = std::filesystem::status(to, failure);
    if (std::filesystem::is_regular_file(former))
    {
      std::filesystem::permissions(from, former.permissions(), failure); // where there are any
    }
    std::filesystem::rename(from, to, failure);
    if (failure)
    {
      throw FileError(this->Name,
        failure.message() + ". Check whether something else of that name is in the way.");
    }
  }

  std::string Name;
  std::filesystem::path Destination;
  std::filesystem::path Folder;
};

} // namespace FlipFree

#endif
