/**
 * Checks the numbers by which VTK's reader of VTP files finds its arrays, since it trusts them: it
 * asks for any amount of memory, and reads beyond its own.
 */
#ifndef FlipFreeCommandVtpHeader_h
#define FlipFreeCommandVtpHeader_h

#include <string>

namespace Command
{

/// Throws a Failure where the file cannot hold what it says.
void ValidateVtp(const std::string& name);

} // namespace Command

#endif
