/**
 * Options that subcommands share, in the same words.
 */
#ifndef FlipFreeCommandCommonOptions_h
#define FlipFreeCommandCommonOptions_h

#include <string>

namespace CLI
{
class App;
class Option;
}

namespace Command
{

void AddConvergenceOption(CLI::App& command, std::string& file);
void AddSnapshotOption(CLI::App& command, std::string& file);
void AddSaveSessionOption(CLI::App& command, std::string& file);

/// A label: a segment's name or a value (VolumeFile.h).
CLI::Option* AddLabelOption(CLI::App& command, const std::string& name, std::string& label,
  const std::string& description);

void AddThreadsOption(CLI::App& command, int& threads);
void AddQuietOption(CLI::App& command, bool& quiet);

} // namespace Command

#endif
