#include "CommandLine.h"

#include "Failure.h"
#include "HelpFormatter.h"
#include "OptionTable.h"
#include "UsageMessage.h"

#include <memory>
#include <sstream>

namespace Command
{
namespace
{

template <typename Request>
void AddSubcommand(CLI::App& program, const std::string& name,
  const std::function<void(const Request&)>& action)
{
  const auto request = std::make_shared<Request>();
  CLI::App* const command = AddCommand(program, name);
  AddOptions(*command, *request);
  command->callback([request, action]() { action(*request); });
}

/// Points to the help of the subcommand.
std::string HelpFor(const CLI::App& program)
{
  std::string command = "flipfree";
  for (const CLI::App* chosen : program.get_subcommands())
  {
    command += " " + chosen->get_name();
  }
  return " See '" + command + " --help'.";
}

} // namespace

CommandLine::CommandLine(const Actions& actions, const std::string& version)
  : Program(EntryOf("flipfree").Description, EntryOf("flipfree").Name)
{
  CLI::App& program = this->Program;
  program.set_version_flag("--version", "flipfree " + version,
    EntryOf(program.get_name(), "--version").Description);
  program.formatter(std::make_shared<HelpFormatter>()); // the subcommands inherit it
  program.footer(EntryOf(program.get_name()).Footer);
  program.require_subcommand(1);
  AddSubcommand(program, "segment", actions.Segment);
  AddSubcommand(program, "trace", actions.Trace);
  AddSubcommand(program, "surfaces", actions.Surfaces);
  AddSubcommand(program, "evaluate", actions.Evaluate);
  AddSubcommand(program, "series", actions.Series);
  AddSubcommand(program, "phantom", actions.Phantom);
  if (actions.Cohort)
  {
    AddSubcommand(program, "cohort", actions.Cohort);
  }
}

std::string CommandLine::Run(int count, const char* const* words)
{
  try
  {
    this->Program.parse(count, words);
    return {};
  }
  catch (const CLI::Success& wanted) // help or version
  {
    std::ostringstream text;
    this->Program.exit(wanted, text, text);
    return text.str();
  }
  catch (const CLI::ParseError& error)
  {
    const std::string message = UsageMessage(error, this->Program);
    const bool ends = message.empty() || message.back() == '.' || message.back() == '?';
    throw WrongUsage(message + (ends ? "" : ".") + HelpFor(this->Program));
  }
  catch (const WrongUsage& error)
  {
    throw WrongUsage(error.what() + HelpFor(this->Program));
  }
}

} // namespace Command
