/**
 * What kernels throw at input that they cannot work with. Only what should be impossible, such as a
 * guarded surface that intersects itself, is a std::logic_error.
 *
 * Kernels know no front end. Their messages name quantities as the properties of the VTK filters
 * do; the command and Python replace these names, word by word, by their options and keywords, but
 * not within single quotes, in which names stand that users give (MessageText.h). They name no
 * filter: which one helps is for the front end to say, by the code.
 */
#ifndef FlipFreeError_h
#define FlipFreeError_h

#include <stdexcept>
#include <string>

namespace FlipFree
{

enum class ErrorCode
{
  EmptyMask,
  GeometryMismatch, ///< two images are not on the same grid
  InsideOut,
  InvalidGeometry, ///< of an image: spacing, direction, dimensions
  InvalidLine,     ///< of a tube: too few points, radii that are not positive
  InvalidMesh,     ///< faces that do not make up a surface
  NoContrast,      ///< between the seed and its surroundings
  NonFiniteValue,
  NotFourValent,
  OpenSurface,
  OutOfRange,    ///< of a parameter
  RepeatedPoint, ///< of a line
  SeedWithoutVoxels,
  SelfIntersecting,
  SingularSystem,
  TooLarge,
  UnreachablePoint ///< a constraint that cannot be obeyed
};

/// A message says what is wrong, where, and what to do; it begins in lower case and has no period,
/// so that a front end can embed it.
class Error : public std::invalid_argument
{
public:
  Error(ErrorCode code, const std::string& text)
    : std::invalid_argument(text)
    , Code(code)
  {
  }

  ErrorCode GetCode() const { return this->Code; }

private:
  ErrorCode Code;
};

} // namespace FlipFree

#endif
