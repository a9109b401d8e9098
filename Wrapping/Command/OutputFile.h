/**
 * The files of one run: all of them are written before the first gets its name, so a run that fails
 * or is interrupted leaves none. Should renaming itself fail, the files renamed before stay, and
 * the message names the one that is missing.
 */
#ifndef FlipFreeCommandOutputFile_h
#define FlipFreeCommandOutputFile_h

#include "OutputNames.h"

#include "AtomicFile.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Command
{

/// Makes the folder unless it is there; its parent must be. One that was made and into which
/// nothing came goes again.
class OutputFolder
{
public:
  /// Throws Failure.
  explicit OutputFolder(const std::string& name);
  ~OutputFolder();

  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

private:
  const std::string Name;
  bool IsNew = false;
};

class OutputFiles
{
public:
  /// Announces an option's file before the work is done: its folder must take files, and it must
  /// be neither one of the `inputs` nor another option's file. Throws Failure or WrongUsage.
  void Announce(const std::string& option, const std::string& name,
    const std::vector<std::string>& inputs = {});

  /// The same as a function.
  Command::Announce Announcing();

  /// Lets `write` make the file under the temporary name that it is called with. Throws Failure.
  void Write(const std::string& name, const std::function<void(const std::string&)>& write);

  /// Gives the files their names, in the order in which they were written. Throws Failure at the
  /// first that does not take its name.
  void Commit();

private:
  OutputNames Announced;
  std::vector<std::unique_ptr<FlipFree::AtomicFile>> Files;
};

/// Write a file; throw Failure where not all of it arrives.
void WriteBytes(const std::string& name, const char* bytes, std::size_t count);
void WriteText(const std::string& name, const std::string& text);

} // namespace Command

#endif
