/**
 * The subcommands. Each adds itself, with its options and what it does, to the parser.
 */
#ifndef FlipFreeCommandSubcommands_h
#define FlipFreeCommandSubcommands_h

namespace CLI
{
class App;
}

namespace Command
{

void AddSegmentCommand(CLI::App& program);
void AddEvaluateCommand(CLI::App& program);
void AddPhantomCommand(CLI::App& program);

} // namespace Command

#endif
