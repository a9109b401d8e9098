/**
 * The command `flipfree`: the toolkit for batch users. `flipfree --help` explains it.
 */
#include "Program.h"

int main(int argc, char* argv[])
{
  return Command::RunCommand(argc, argv);
}
