/**
 * The subcommands and their options as plain data: what the command parses, the manual page and the
 * shell completions, and the command of the package that pip builds come from here. So this knows
 * neither VTK nor the parser. Parameters are those of the kernels' tables.
 */
#ifndef FlipFreeCommandOptionTable_h
#define FlipFreeCommandOptionTable_h

#include "ParameterTable.h"
#include "QuantityNames.h"

#include <string>
#include <vector>

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
const std::vector<CommandEntry>& OptionTable();

/// Throws std::out_of_range for a name that there is not.
const CommandEntry& EntryOf(const std::string& command);
/// By any of its names, or by what a positional is called.
const OptionEntry& EntryOf(const std::string& command, const std::string& option);

/// The options of a parameter, such as --iterations and --maximum-iterations of MaximumIterations:
/// the last one is its name, the first one is shown.
std::vector<std::string> OptionsOf(const std::string& parameter);

std::string Joined(const std::vector<std::string>& words, const char* separator);

/// What the options are called, by the parameters that they set.
template <typename Settings>
FlipFree::QuantityNames OptionNames(const FlipFree::ParameterTable<Settings>& table)
{
  FlipFree::QuantityNames names;
  for (const FlipFree::Parameter<Settings>& parameter : table)
  {
    names[parameter.Name] = OptionsOf(parameter.Name).front();
  }
  return names;
}

} // namespace Command

#endif
