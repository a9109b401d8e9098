#include "Options.h"

#include "Failure.h"
#include "FileFormats.h"
#include "MessageText.h"

#include <cstdint>

namespace Command
{
namespace
{

std::string RequireLabel(const std::string& text)
{
  return IsLabel(text)
    ? std::string()
    : "'" + text + "' is no label: give a segment's name, or a whole number from 0 on";
}

} // namespace

CLI::App* AddCommand(CLI::App& program, const std::string& name)
{
  const CommandEntry& entry = EntryOf(name);
  CLI::App* command = program.add_subcommand(name, entry.Description);
  command->footer(entry.Footer);
  return command;
}

std::string ParserNames(const OptionEntry& entry)
{
  std::string names;
  for (const std::string& name : entry.Names.empty() ? entry.Values : entry.Names)
  {
    names +=
      (names.empty() ? "" : ",") + std::string(name.rfind("--no-", 0) == 0 ? "!" : "") + name;
  }
  return names;
}

CLI::Option* Describe(CLI::Option* option, const OptionEntry& entry)
{
  option->default_str(entry.Default)->group(entry.Group)->required(entry.Required);
  if (entry.Names.empty() || entry.Values.empty())
  {
    return option; // without values, or with one that has the option's name
  }
  option->type_name(Joined(entry.Values, " "));
  if (entry.Repeats)
  {
    option->expected(static_cast<int>(entry.Values.size()), CLI::detail::expected_max_vector_size)
      ->allow_extra_args(false); // of the values that each time has
  }
  if (!entry.Choices.empty())
  {
    option->check(CLI::IsMember(entry.Choices));
  }
  return entry.Values.front() == "LABEL" ? option->check(RequireLabel) : option;
}

void AddThreadsOption(CLI::App& command, int& threads)
{
  AddOption(command, "--threads", threads)->check(CLI::Range(0, 1024));
}

void AddNumbers(CLI::App& command, const OptionEntry& entry, FlipFree::ParameterType type,
  const std::function<void(const std::vector<double>&)>& keep)
{
  const std::string names = ParserNames(entry);
  const auto keepOne = [keep](double value) { keep({ value }); };
  if (type == FlipFree::ParameterType::Boolean)
  {
    Describe(
      command.add_flag_function(
        names, [keepOne](std::int64_t count) { keepOne(count > 0 ? 1 : 0); }, entry.Description),
      entry);
  }
  else if (entry.Values.size() > 1)
  {
    Describe(command.add_option_function(names, keep, entry.Description), entry)
      ->expected(static_cast<int>(entry.Values.size()));
  }
  else if (type == FlipFree::ParameterType::Integer)
  {
    Describe(command.add_option_function<int>(names, keepOne, entry.Description), entry);
  }
  else
  {
    Describe(command.add_option_function<double>(names, keepOne, entry.Description), entry);
  }
}

void RefuseNumber(const std::string& parameter, double value, double minimum, double maximum)
{
  throw WrongUsage(OptionsOf(parameter).front() + ": " + FlipFree::TextOf(value) +
    " is out of range. Give " + FlipFree::TextOf(minimum) + " to " + FlipFree::TextOf(maximum) +
    ".");
}

} // namespace Command
