/**
 * What the program's subcommands take, as plain data: the source of the manual page and of the
 * shells' completion, which therefore say the same as --help.
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
  std::vector<std::string> Names;   // with their dashes, short ones first; empty if positional
  std::vector<std::string> Values;  // what it takes, such as X, Y, Z; empty if nothing
  std::vector<std::string> Choices; // the words it takes, where there are no others
  std::string Description;
  std::string Default;
  std::string Group;
  bool Required = false;
};

struct CommandEntry
{
  std::string Name;
  std::string Description;
  std::string Footer;
  std::vector<OptionEntry> Positionals;
  std::vector<OptionEntry> Options;
};

/// The program itself, and then its subcommands.
std::vector<CommandEntry> OptionTable(const CLI::App& program);

} // namespace Command

#endif
