/**
 * A progress bar of one line, which is removed when the work is done. Nothing is written unless the
 * standard error stream is a terminal.
 */
#ifndef FlipFreeCommandProgressBar_h
#define FlipFreeCommandProgressBar_h

#include <string>

namespace Command
{
namespace ProgressBar
{

/// Shows no bar, even on a terminal.
void Disable();

/// Draws the bar for a fraction from 0 to 1.
void Show(const std::string& title, double fraction);

void Clear();

} // namespace ProgressBar
} // namespace Command

#endif
