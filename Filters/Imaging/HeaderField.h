/**
 * Private to the module: what the headers of all formats have in common. Values are judged as they
 * stand in the file; an error names file, field, value and remedy.
 */
#ifndef FlipFreeHeaderField_h
#define FlipFreeHeaderField_h

#include <map>
#include <string>
#include <vector>

namespace FlipFree
{

/// Throws the ImageFileError "The header of ... cannot be used: FIELD WHAT. Repair the field, or
/// download or copy the file again."
[[noreturn]] void RefuseField(const std::string& file, const std::string& field,
  const std::string& what);

/// Lengths and coordinates, in millimeters: finite, and small enough for squares in single
/// precision.
void RequireLength(const std::string& file, const std::string& field, double value);

/// The same, and not zero.
void RequireSpacing(const std::string& file, const std::string& field, double value);

/// Fields of a header that is text, each one a line.
class TextFields
{
public:
  explicit TextFields(std::string file)
    : File(std::move(file))
  {
  }

  /// Throws where the field stands twice.
  void Add(const std::string& field, const std::string& value);

  bool Has(const std::string& field) const { return this->Values.count(field) > 0; }

  /// An empty text where there is no such field.
  std::string Text(const std::string& field) const;

  /// All must be numbers, and as many as wanted.
  std::vector<double> Numbers(const std::string& field, std::size_t count) const;

  /// A whole number within bounds, or the default where there is no such field.
  long Integer(const std::string& field, long least, long greatest, long otherwise) const;

  /// Sizes along the axes, each 1 to INT_MAX; returns their product.
  double Voxels(const std::string& field, std::size_t dimension) const;

  [[noreturn]] void Refuse(const std::string& field, const std::string& what) const;

private:
  std::string File;
  std::map<std::string, std::string> Values;
};

/// Without white space at both ends.
std::string Trimmed(const std::string& text);

/// The words of a text, between white space.
std::vector<std::string> Words(const std::string& text);

/// A number that takes up the whole text; NaN and infinity are numbers. False if it is not one.
bool ToNumber(const std::string& text, double& number);

/// Files that a header gives by a pattern such as `slice%03d.raw`, numbered from `first` to `last`.
/// Throws where the pattern has anything but one whole number.
std::vector<std::string> NumberedFiles(const TextFields& fields, const std::string& field,
  const std::string& pattern, long first, long last, long step);

} // namespace FlipFree

#endif
