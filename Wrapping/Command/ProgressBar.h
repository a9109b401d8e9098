/**
 * One line on a terminal that shows how far the work has come, and goes when it is done. Where the
 * standard error stream is a file or a pipe, nothing is written.
 */
#ifndef FlipFreeCommandProgressBar_h
#define FlipFreeCommandProgressBar_h

#include <string>

namespace Command
{
namespace ProgressBar
{

/// No bar, whatever the stream is.
void Disable();

/// Draws it, with a fraction between 0 and 1.
void Show(const std::string& title, double fraction);

void Clear();

} // namespace ProgressBar
} // namespace Command

#endif
