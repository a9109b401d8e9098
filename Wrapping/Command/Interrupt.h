/**
 * Ctrl-C and SIGTERM as a request to stop, which the running filter is asked to follow.
 */
#ifndef FlipFreeCommandInterrupt_h
#define FlipFreeCommandInterrupt_h

namespace Command
{

/// From now on signals no longer end the process; they are asked for by WasInterrupted(). Writing
/// beyond a limit on file sizes becomes an error of the write.
void CatchSignals();

bool WasInterrupted();

} // namespace Command

#endif
