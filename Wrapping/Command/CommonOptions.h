/**
 * Options that subcommands share, in the same words.
 */
#ifndef FlipFreeCommandCommonOptions_h
#define FlipFreeCommandCommonOptions_h

#include <string>

namespace CLI
{
class App;
}

namespace Command
{

void AddConvergenceOption(CLI::App& command, std::string& file);
void AddSnapshotOption(CLI::App& command, std::string& file);
void AddSaveSessionOption(CLI::App& command, std::string& file);

void AddThreadsOption(CLI::App& command, int& threads);
void AddQuietOption(CLI::App& command, bool& quiet);

} // namespace Command

#endif
