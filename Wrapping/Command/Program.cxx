#include "Program.h"

#include "Failure.h"
#include "Generate.h"
#include "HelpFormatter.h"
#include "Interrupt.h"
#include "Messages.h"
#include "OptionTable.h"
#include "Subcommands.h"
#include "UsageMessage.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>
#include <new>
#include <string>

namespace Command
{
namespace
{

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

void RequireOutputArrived()
{
  errno = 0;
  if (!std::cout.flush() || std::ferror(stdout))
  {
    throw Failure(std::string("Writing to the standard output failed (") +
      (errno ? std::strerror(errno) : "closed") + "). Check where it is redirected to.");
  }
}

ExitStatus RunProgram(CLI::App& program, int argc, char* argv[])
{
  try
  {
    program.parse(argc, argv);
    RequireOutputArrived();
    return SUCCESS;
  }
  catch (const CLI::Success& wanted) // help or version
  {
    program.exit(wanted);
    RequireOutputArrived();
    return SUCCESS;
  }
  catch (const CLI::ParseError& error)
  {
    const std::string message = UsageMessage(error, program);
    const bool ends = message.empty() || message.back() == '.' || message.back() == '?';
    PrintError(message + (ends ? "" : ".") + HelpFor(program));
  }
  catch (const WrongUsage& error)
  {
    PrintError(error.what() + HelpFor(program));
  }
  return WRONG_USAGE;
}

} // namespace

int RunCommand(int argc, char* argv[])
{
  try
  {
    CatchSignals();
    CatchVtkMessages();

    const CommandEntry& entry = EntryOf("flipfree");
    CLI::App program(entry.Description, entry.Name);
    program.set_version_flag("--version", "flipfree " FLIPFREE_VERSION,
      EntryOf(entry.Name, "--version").Description);
    program.formatter(std::make_shared<HelpFormatter>()); // the subcommands inherit it
    program.footer(entry.Footer);
    program.require_subcommand(1);
    AddSegmentCommand(program);
    AddTraceCommand(program);
    AddSurfacesCommand(program);
    AddEvaluateCommand(program);
    AddSeriesCommand(program);
    AddPhantomCommand(program);
    AddGenerateOption(program);

    return RunProgram(program, argc, argv);
  }
  catch (const Interrupted&)
  {
    EndInterrupted();
  }
  catch (const std::bad_alloc&)
  {
    PrintError("Out of memory. Crop the volume, or use a machine with more memory.");
  }
  catch (const std::exception& error)
  {
    if (WasInterrupted()) // while what cannot be aborted went on, such as reading
    {
      EndInterrupted();
    }
    PrintError(error.what());
  }
  return FAILURE;
}

} // namespace Command
