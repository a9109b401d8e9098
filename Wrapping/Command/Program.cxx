#include "Program.h"

#include "CommandLine.h"
#include "Failure.h"
#include "Generate.h"
#include "Interrupt.h"
#include "Messages.h"
#include "Subcommands.h"
#include "Warning.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <string>

namespace Command
{
namespace
{

void RequireOutputArrived()
{
  errno = 0;
  if (!std::cout.flush() || std::ferror(stdout))
  {
    throw Failure(std::string("Writing to the standard output failed (") +
      (errno ? std::strerror(errno) : "closed") + "). Check where it is redirected to.");
  }
}

} // namespace

int RunCommand(int argc, char* argv[])
{
  try
  {
    CatchSignals();
    CatchVtkMessages();
    SendWarningsTo(&PrintWarning);

    CommandLine line({ &Segment, &Trace, &MakeSurfaces, &Evaluate, &ListSeries, &MakePhantom, {} },
      FLIPFREE_VERSION);
    AddGenerateOption(line.Parser());
    std::cout << line.Run(argc, argv);
    RequireOutputArrived();
    return SUCCESS;
  }
  catch (const WrongUsage& error)
  {
    PrintError(error.what());
    return WRONG_USAGE;
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
