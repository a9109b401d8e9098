/**
 * Runs a filter with a progress bar, stops it at Ctrl-C, and turns the error it reports into a
 * Failure.
 */
#ifndef FlipFreeCommandRun_h
#define FlipFreeCommandRun_h

#include "Messages.h"

#include <functional>
#include <string>

class vtkAlgorithm;

namespace Command
{

/// Updates the filter, or calls `work` in place of its Update(). What it reports calls properties
/// by `names`. Throws Interrupted or Failure.
void Run(vtkAlgorithm* algorithm, const std::string& title,
  const FlipFree::QuantityNames& names = {}, const std::function<void()>& work = {});

/// Throws Interrupted once the user has asked to stop.
void StopIfInterrupted();

} // namespace Command

#endif
