/**
 * The exceptions that end the command, each with its exit status. Their message becomes the one
 * line that the user reads, so it names the file or the option, and the remedy.
 */
#ifndef FlipFreeCommandFailure_h
#define FlipFreeCommandFailure_h

#include <stdexcept>

namespace Command
{

enum ExitStatus
{
  SUCCESS = 0,
  FAILURE = 1,
  WRONG_USAGE = 2,
  INTERRUPTED = 130
};

/// The work failed: bad data, a file that cannot be read or written.
struct Failure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The command line is wrong; found before any work is done.
struct WrongUsage : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The user stopped the command.
struct Interrupted
{
};

} // namespace Command

#endif
