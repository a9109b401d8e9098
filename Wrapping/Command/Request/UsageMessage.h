/**
 * What is wrong with a command line, in our words: those of CLI11 neither name the remedy nor what
 * an option takes.
 */
#ifndef FlipFreeCommandUsageMessage_h
#define FlipFreeCommandUsageMessage_h

#include <string>

namespace CLI
{
class App;
class ParseError;
}

namespace Command
{

/// One or two sentences about the error of a program whose parsing has failed.
std::string UsageMessage(const CLI::ParseError& error, const CLI::App& program);

} // namespace Command

#endif
