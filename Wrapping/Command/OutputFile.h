/**
 * Files that the command leaves: never a part of one. Each is written under a temporary name in its
 * own folder; only once all of a run are there are they renamed, one after the other. So a run that
 * fails or is interrupted before leaves none of them. Should a renaming itself fail, files renamed
 * before it stay, and the message names the one that is missing.
 */
#ifndef FlipFreeCommandOutputFile_h
#define FlipFreeCommandOutputFile_h

#include <functional>
#include <string>
#include <vector>

namespace Command
{

/// Whether a file's name has one of these endings, in small or capital letters.
bool HasEnding(const std::string& name, const std::vector<std::string>& endings);

/// Throws WrongUsage, naming the option, unless the name has one of the endings.
void RequireEnding(const std::string& option, const std::string& name,
  const std::vector<std::string>& endings);

class OutputFiles
{
public:
  OutputFiles() = default;
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  void operator=(const OutputFiles&) = delete;

  /// Announces a file before the work is done: its folder must take files, and it may be none
  /// of the `inputs`.
  void Announce(const std::string& name, const std::vector<std::string>& inputs = {});

  /// Lets `write` make the file under the temporary name that it is called with. Throws Failure.
  void Write(const std::string& name, const std::function<void(const std::string&)>& write);

  /// Gives the files their names, in the order in which they were announced. Throws Failure at the
  /// first that does not take its name; those before it are in place, those behind it are not made.
  void Commit();

private:
  struct File
  {
    std::string Name;
    std::string Temporary;
  };
  std::vector<File> Files;
};

/// Writes bytes into a file; throws Failure where they do not all arrive.
void WriteBytes(const std::string& name, const char* bytes, std::size_t count);

} // namespace Command

#endif
