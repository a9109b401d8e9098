#include "UsageMessage.h"

#include "Suggestion.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <regex>
#include <vector>

namespace Command
{
namespace
{

std::vector<std::string> OptionNamesOf(const CLI::App& command)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      names.push_back("--" + name);
    }
  }
  return names;
}

std::vector<std::string> SubcommandNamesOf(const CLI::App& program)
{
  std::vector<std::string> names;
  for (const CLI::App* subcommand : program.get_subcommands({}))
  {
    names.push_back(subcommand->get_name());
  }
  return names;
}

/// Empty if all words are known. CLI11 reports a mistyped subcommand as a missing one.
std::string UnknownWordMessage(const CLI::App& program)
{
  const std::vector<CLI::App*> subcommands = program.get_subcommands();
  const CLI::App& command = subcommands.empty() ? program : *subcommands.front();
  const std::vector<std::string> unknown = command.remaining();
  if (subcommands.empty() && !unknown.empty() && unknown.front() == "cohort")
  {
    return "'cohort' is a subcommand of the Python package only: run pip install "
           "'.[cohort]' in the source folder, in a virtual environment, and use its command.";
  }
  if (subcommands.empty() && !unknown.empty() && unknown.front().rfind('-', 0) != 0)
  {
    return "There is no subcommand '" + unknown.front() + "'." +
      FlipFree::Suggestion(unknown.front(), SubcommandNamesOf(program));
  }
  // The word after an unknown option may be its value, so the option is named first.
  const auto option = std::find_if(unknown.begin(), unknown.end(),
    [](const std::string& word) { return word.rfind('-', 0) == 0; });
  if (option != unknown.end())
  {
    return "There is no option '" + *option + "'." +
      FlipFree::Suggestion(option->substr(0, option->find('=')), OptionNamesOf(command));
  }
  if (unknown.empty())
  {
    return {};
  }
  return "Unexpected argument '" + unknown.front() + "'.";
}

/// The option that CLI11's message names; null if it names none.
const CLI::Option* OptionIn(const std::string& message, const CLI::App& program)
{
  const std::vector<CLI::App*> subcommands = program.get_subcommands();
  const CLI::App& command = subcommands.empty() ? program : *subcommands.front();
  // The first word that is an option's name: after it there may be another's, or values.
  std::smatch word;
  static const std::regex name("--[a-z-]*[a-z]");
  return std::regex_search(message, word, name) ? command.get_option_no_throw(word.str()) : nullptr;
}

/// Such as `--seed X Y Z`. CLI11 appends the choices of checks to the values.
std::string UseOf(const CLI::Option& option)
{
  const std::string type = option.get_type_name();
  return option.get_name() + " " + type.substr(0, type.find(':'));
}

std::string NotANumberMessage(const CLI::Option& option)
{
  double number = 0;
  std::string wrong;
  std::string kind = "a number";
  for (const std::string& value : option.results())
  {
    if (!CLI::detail::lexical_cast(value, number))
    {
      wrong = value;
      break;
    }
  }
  if (wrong.empty()) // it is one, but the option takes integers
  {
    wrong = option.results().empty() ? "" : option.results().front();
    kind = "a whole number, or is too large";
  }
  return option.get_name() + ": '" + wrong + "' is not " + kind + ". Give " + UseOf(option) + ".";
}

std::string CountMessage(const CLI::Option& option)
{
  const bool tooMany = static_cast<int>(option.results().size()) > option.get_items_expected_max();
  return option.get_name() +
    (tooMany ? ": it is given more than once. Give it once: " : ": a value is missing. Give ") +
    UseOf(option) + ".";
}

std::string RefusedValueMessage(const CLI::Option& option, const std::string& text)
{
  const std::string name = option.get_name();
  std::smatch found;
  static const std::regex choices(R"(^\S+: (.*) not in \{(.*)\}$)");
  // "0 to 1024" of CLI11 2.1, "[0 - 1024]" of 2.4.
  static const std::regex range(
    R"(^\S+: Value (.*) not in range \[?(\S+) (?:to|-) ([^\s\]]+)\]?$)");
  if (std::regex_match(text, found, range))
  {
    const bool bounded = found[3].str().size() < 12; // not the greatest double
    static const std::regex whole(R"([-+]?\d+)");
    const std::string value = found[1].str();
    return name + ": " +
      (std::regex_match(value, whole) ? value + " is out of range"
                                      : "'" + value + "' is not a whole number") +
      ". Give " + (bounded ? found[2].str() + " to " + found[3].str() : "0 or more") + ".";
  }
  if (std::regex_match(text, found, choices))
  {
    const std::string list = std::regex_replace(found[2].str(), std::regex(","), ", ");
    return name + ": there is no '" + found[1].str() + "'. Choose one of " + list + ".";
  }
  return text;
}

} // namespace

std::string UsageMessage(const CLI::ParseError& error, const CLI::App& program)
{
  std::string unknown = UnknownWordMessage(program);
  if (!unknown.empty())
  {
    return unknown;
  }
  std::string text = error.what();
  const CLI::Option* const option = OptionIn(text, program);
  if (!option)
  {
    return text;
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
  {
    return CountMessage(*option);
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error))
  {
    return option->get_expected_max() == 0
      ? option->get_name() + ": it takes no value. Leave it out."
      : NotANumberMessage(*option);
  }
  if (dynamic_cast<const CLI::ValidationError*>(&error))
  {
    return RefusedValueMessage(*option, text);
  }
  if (dynamic_cast<const CLI::RequiresError*>(&error))
  {
    return text + ". Give both, or none.";
  }
  return text;
}

} // namespace Command
