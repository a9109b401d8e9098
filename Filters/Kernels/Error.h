/**
 * What kernels throw at input that they cannot work with.
 *
 * Kernels know no shell, so a message names quantities, in braces: "lower {SeedRadius}". Each shell
 * spells them as its users write them: VTK as properties, the command as options, Python as
 * keywords.
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
  InvalidMesh,     ///< connectivity that is none
  NoContrast,      ///< between the seed and its surroundings
  NonFiniteValue,
  NotFourValent,
  OpenSurface,
  OutOfRange, ///< of a parameter
  SeedWithoutVoxels,
  SelfIntersecting,
  SingularSystem,
  TooLarge
};

/// Replaces each {Quantity} of a text by nameOf("Quantity").
template <typename Naming>
std::string SpellQuantities(const std::string& text, const Naming& nameOf)
{
  std::string spelled;
  std::size_t end = 0;
  for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', end))
  {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos)
    {
      break;
    }
    spelled += text.substr(end, open - end) + nameOf(text.substr(open + 1, close - open - 1));
    end = close + 1;
  }
  return spelled + text.substr(end);
}

/// A message says what is wrong, where, and what to do; it begins in lower case and has no period,
/// so that a shell can embed it. what() names quantities as the properties of the VTK filters do.
class Error : public std::invalid_argument
{
public:
  Error(ErrorCode code, const std::string& text)
    : std::invalid_argument(SpellQuantities(text, [](const std::string& name) { return name; }))
    , Code(code)
    , Text(text)
  {
  }

  ErrorCode GetCode() const { return this->Code; }

  /// The message with its quantities in braces, for SpellQuantities.
  const std::string& GetText() const { return this->Text; }

private:
  ErrorCode Code;
  std::string Text;
};

} // namespace FlipFree

#endif
