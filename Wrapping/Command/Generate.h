/**
 * The manual page and the completion of shells, generated from the options themselves. The build
 * calls `flipfree --generate man`, which the help does not show, and installs what it prints.
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

/// Adds the hidden option, which prints one of them and ends.
void AddGenerateOption(CLI::App& program);

} // namespace Command

#endif
