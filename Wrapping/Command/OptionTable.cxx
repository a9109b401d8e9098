#include "OptionTable.h"

#include <CLI/CLI.hpp>

#include <sstream>

namespace Command
{
namespace
{

std::vector<std::string> Split(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
  {
    parts.push_back(part);
  }
  return parts;
}

OptionEntry EntryOf(const CLI::Option& option)
{
  OptionEntry entry;
  for (const std::string& name : option.get_snames())
  {
    entry.Names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames())
  {
    entry.Names.push_back("--" + name);
  }
  // CLI11 appends the choices of checks: NAME:{default,published,naive}
  const std::string type = option.get_type_name();
  const std::size_t brace = type.find('{');
  if (brace != std::string::npos)
  {
    entry.Choices = Split(type.substr(brace + 1, type.find('}') - brace - 1), ',');
  }
  if (option.get_positional())
  {
    entry.Values = { option.get_name(true) };
  }
  else if (option.get_type_size() != 0)
  {
    entry.Values = Split(type.substr(0, type.find(':')), ' ');
  }
  entry.Description = option.get_description();
  entry.Default = option.get_default_str();
  entry.Group = option.get_group();
  entry.Required = option.get_required();
  entry.Repeats = !option.get_allow_extra_args() &&
    option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  return entry;
}

CommandEntry EntryOf(const CLI::App& command)
{
  CommandEntry entry{ command.get_name(), command.get_description(), command.get_footer(), {}, {} };
  for (const CLI::Option* option : command.get_options())
  {
    if (!option->get_group().empty()) // options without a group are hidden
    {
      (option->get_positional() ? entry.Positionals : entry.Options).push_back(EntryOf(*option));
    }
  }
  return entry;
}

} // namespace

std::vector<CommandEntry> OptionTable(const CLI::App& program)
{
  std::vector<CommandEntry> table{ EntryOf(program) };
  for (const CLI::App* command : program.get_subcommands({}))
  {
    table.push_back(EntryOf(*command));
  }
  return table;
}

} // namespace Command
