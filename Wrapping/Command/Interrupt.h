/**
 * Ctrl-C and SIGTERM. The first one asks the running filter to abort. Libraries that read, write or
 * draw do not listen: where the command has not ended in less than a second, or at the second
 * signal, it is ended from a thread that waits for nothing else, and temporary files go with it.
 */
#ifndef FlipFreeCommandInterrupt_h
#define FlipFreeCommandInterrupt_h

#include <mutex>
#include <string>

namespace Command
{

/// From now on these signals no longer end the process by themselves; WasInterrupted() reports
/// them. Exceeding the limit on file sizes fails the write instead of ending the process.
void CatchSignals();

bool WasInterrupted();

/// While it lives, the command is not ended; for what is short and must be done wholly or not at
/// all.
class Uninterrupted
{
public:
  Uninterrupted();

private:
  std::unique_lock<std::timed_mutex> Lock;
};

/// The folder goes when the command is ended early.
void AddTemporaryFolder(const std::string& name);

/// Ends the process with the status of an interrupted command, without waiting for threads that
/// still read or write.
[[noreturn]] void EndInterrupted();

} // namespace Command

#endif
