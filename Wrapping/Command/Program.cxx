#include "Program.h"

#include "Failure.h"
#include "Generate.h"
#include "HelpFormatter.h"
#include "Interrupt.h"
#include "Messages.h"
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

const char* const Description =
  "Segments soft organs (liver, spleen, kidney) in CT and MR volumes. A sphere inside the organ "
  "grows into the organ's surface, which is closed and does not intersect itself.";

const char* const ProgramFooter =
  "Examples:\n"
  "  flipfree phantom abdomen -o try                  # a volume to try, and its seeds\n"
  "  flipfree segment try/abdomen.nii.gz --seed 99.75 83.75 167 --radius 28 -o liver.ply\n"
  "  flipfree evaluate liver.ply try/abdomen-truth.nii.gz --reference-label 6\n"
  "\n"
  "Each subcommand has its own --help, with units, defaults and examples. Coordinates are LPS\n"
  "millimeters: x to the patient's left, y to the back, z to the head. Viewers that use RAS, "
  "such\n"
  "as 3D Slicer, show x and y with opposite signs.\n"
  "Exit status: 0 success, 1 failure, 2 wrong usage, 130 interrupted.\n";

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

    CLI::App program(Description, "flipfree");
    program.set_version_flag("--version", "flipfree " FLIPFREE_VERSION,
      "Print the version and exit");
    program.formatter(std::make_shared<HelpFormatter>()); // the subcommands inherit it
    program.footer(ProgramFooter);
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
