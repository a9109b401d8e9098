/**
 * Runs filters as the command wants them run: with a progress bar, stopped by Ctrl-C, and with what
 * they report turned into a Failure.
 */
#ifndef FlipFreeCommandRun_h
#define FlipFreeCommandRun_h

#include <functional>
#include <string>

class vtkAlgorithm;

namespace Command
{

/// Does `work` (by default, updates the filter). Throws Interrupted, or a Failure with what the
/// filter reports. Returns the seconds that it took.
double Run(vtkAlgorithm* algorithm, const std::string& title,
  const std::function<void()>& work = std::function<void()>());

/// Throws Interrupted once the user has asked to stop.
void StopIfInterrupted();

} // namespace Command

#endif
