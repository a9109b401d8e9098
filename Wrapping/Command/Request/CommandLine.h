/**
 * The command line: subcommands, options, help, and what is said where it is wrong. What a
 * subcommand does is given from outside, since the toolkit's command and the one that pip installs
 * do it on different grounds.
 */
#ifndef FlipFreeCommandCommandLine_h
#define FlipFreeCommandCommandLine_h

#include "OtherRequests.h"
#include "SegmentRequest.h"
#include "TraceRequest.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace Command
{

/// What the subcommands do.
struct Actions
{
  std::function<void(const SegmentRequest&)> Segment;
  std::function<void(const TraceRequest&)> Trace;
  std::function<void(const SurfacesRequest&)> Surfaces;
  std::function<void(const EvaluateRequest&)> Evaluate;
  std::function<void(const SeriesRequest&)> Series;
  std::function<void(const PhantomRequest&)> Phantom;
  std::function<void(const CohortRequest&)> Cohort; ///< none in the toolkit
};

class CommandLine
{
public:
  CommandLine(const Actions& actions, const std::string& version);

  /// For options of the program's own.
  CLI::App& Parser() { return this->Program; }

  /// Does what the words ask for, the first of which is the program's name. Returns the text of
  /// --help or --version, or nothing. Throws WrongUsage, also for what an action throws so: it
  /// says which help explains more.
  std::string Run(int count, const char* const* words);

private:
  CLI::App Program;
};

} // namespace Command

#endif
