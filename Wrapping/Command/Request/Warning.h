/**
 * What the user should know although the command goes on. Each program says it in its own way.
 */
#ifndef FlipFreeCommandWarning_h
#define FlipFreeCommandWarning_h

#include <functional>
#include <string>

namespace Command
{

/// From now on, `print` gets the warnings; before, nobody does.
void SendWarningsTo(const std::function<void(const std::string&)>& print);

void Warn(const std::string& message);

} // namespace Command

#endif
