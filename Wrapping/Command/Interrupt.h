/**
 * Turns Ctrl-C and SIGTERM into a request to stop, which aborts the running filter.
 */
#ifndef FlipFreeCommandInterrupt_h
#define FlipFreeCommandInterrupt_h

namespace Command
{

/// From now on these signals no longer end the process; WasInterrupted() reports them. Exceeding
/// the limit on file sizes fails the write instead of ending the process.
void CatchSignals();

bool WasInterrupted();

} // namespace Command

#endif
