/**
 * What kernels throw at input that they cannot work with. Only what should be impossible, such as a
 * guarded surface that intersects itself, is a std::logic_error.
 *
 * Kernels know no front end. An error has a code, and a message that marks the quantities in it
 * (QuantityNames.h). It names no filter: which one helps is for the front end to say, by the code.
 */
#ifndef FlipFreeError_h
#define FlipFreeError_h

#include "FlipFreeErrorCode.h"
#include "QuantityNames.h"

#include <new>
#include <stdexcept>
#include <string>

namespace FlipFree
{

/// A message says what is wrong, where, and what to do; it begins in lower case and has no period,
/// so that a front end can embed it.
class Error : public std::invalid_argument
{
public:
  /// what() has the names of the properties.
  Error(ErrorCode code, const std::string& text)
    : std::invalid_argument(WithNames(text))
    , Code(code)
    , Text(text)
  {
  }

  ErrorCode GetCode() const { return this->Code; }

  /// With quantities in braces.
  const std::string& GetText() const { return this->Text; }

private:
  ErrorCode Code;
  std::string Text;
};

/// With quantities in braces, whatever the error is.
inline std::string MessageOf(const std::exception& error)
{
  // The latter is of more than a vector could hold.
  if (dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error))
  {
    return "out of memory; crop the volume, or use a machine with more memory";
  }
  const auto* const known = dynamic_cast<const Error*>(&error);
  return known ? known->GetText() : Escaped(error.what());
}

} // namespace FlipFree

#endif
