/**
 * The files that a command is asked to write, as far as their names tell whether it can.
 */
#ifndef FlipFreeCommandOutputNames_h
#define FlipFreeCommandOutputNames_h

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace Command
{

/// A file that an option asks for; without a name, nobody does.
struct RequestedFile
{
  std::string Option;
  std::string Name;
  std::vector<std::string> Endings;
};

/// Throws WrongUsage where no file is asked for, or a name has another ending.
void RequireOutputs(const std::vector<RequestedFile>& files);

/// Takes an option's file, and the inputs that it must not replace.
using Announce = std::function<void(const std::string& option, const std::string& name,
  const std::vector<std::string>& inputs)>;

/// Those that are asked for.
void AnnounceFiles(const std::vector<RequestedFile>& files, const std::vector<std::string>& inputs,
  const Announce& announce);

class OutputNames
{
public:
  /// Throws WrongUsage if it is one of the `inputs`, or another option's file.
  void Add(const std::string& option, const std::string& name,
    const std::vector<std::string>& inputs);

private:
  std::vector<std::pair<std::string, std::string>> Added; // option and name
};

} // namespace Command

#endif
