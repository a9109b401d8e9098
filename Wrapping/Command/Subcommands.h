/**
 * Each subcommand adds itself to the parser: its options and the function that runs it.
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
void AddTraceCommand(CLI::App& program);
void AddSurfacesCommand(CLI::App& program);
void AddEvaluateCommand(CLI::App& program);
void AddSeriesCommand(CLI::App& program);
void AddPhantomCommand(CLI::App& program);

} // namespace Command

#endif
