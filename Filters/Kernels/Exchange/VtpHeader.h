/**
 * Checks the numbers by which VTK's reader of VTP files finds its arrays, since it trusts them: it
 * asks for any amount of memory, and reads beyond its own.
 */
#ifndef FlipFreeVtpHeader_h
#define FlipFreeVtpHeader_h

#include <string>

namespace FlipFree
{

/// The bytes are those of a file of this name. Throws FileProblem where they cannot hold what they
/// say.
void ValidateVtp(const std::string& name, const std::string& bytes);

} // namespace FlipFree

#endif
