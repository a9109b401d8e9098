/**
 * What the user should know although the command goes on. Each program says it in its own way, so
 * each defines this function.
 */
#ifndef FlipFreeCommandWarning_h
#define FlipFreeCommandWarning_h

#include <string>

namespace Command
{

void PrintWarning(const std::string& message);

} // namespace Command

#endif
