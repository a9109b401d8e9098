/**
 * Generates the manual page and the shell completions from the options themselves. The build
 * installs what the hidden option `flipfree --generate man` (or bash, zsh) prints.
 */
#ifndef FlipFreeCommandGenerate_h
#define FlipFreeCommandGenerate_h

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace Command
{

struct CommandEntry;

std::string ManualPage(const std::vector<CommandEntry>& table, const std::string& version);
std::string BashCompletion(const std::vector<CommandEntry>& table);
std::string ZshCompletion(const std::vector<CommandEntry>& table);

/// Adds the hidden option.
void AddGenerateOption(CLI::App& program);

} // namespace Command

#endif
