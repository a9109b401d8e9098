/**
 * The subcommands and their options as plain data, from which the manual page and the shell
 * completions are generated, so that they agree with --help.
 */
#ifndef FlipFreeCommandOptionTable_h
#define FlipFreeCommandOptionTable_h

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace Command
{

struct OptionEntry
{
  std::vector<std::string> Names;   // with dashes, short ones first; empty if positional
  std::vector<std::string> Values;  // placeholders such as X, Y, Z; empty for a flag
  std::vector<std::string> Choices; // the only words it accepts; empty if any
  std::string Description;
  std::string Default;
  std::string Group;
  bool Required = false;
  bool Repeats = false; // may be given several times
};

struct CommandEntry
{
  std::string Name;
  std::string Description;
  std::string Footer;
  std::vector<OptionEntry> Positionals;
  std::vector<OptionEntry> Options;
};

/// The program itself, followed by its subcommands.
std::vector<CommandEntry> OptionTable(const CLI::App& program);

} // namespace Command

#endif
