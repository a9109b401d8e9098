/**
 * The whole command as a function, so that a program which forks can run it many times.
 */
#ifndef FlipFreeCommandProgram_h
#define FlipFreeCommandProgram_h

namespace Command
{

/// Gives the exit status.
int RunCommand(int argc, char* argv[]);

} // namespace Command

#endif
