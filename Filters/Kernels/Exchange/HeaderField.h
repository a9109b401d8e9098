/**
 * What the headers of all formats have in common. Values are judged as they stand in the file; an
 * error names file, field, value and remedy.
 */
#ifndef FlipFreeHeaderField_h
#define FlipFreeHeaderField_h

#include "Exchange/VolumeFileHeader.h"
#include "Image/GridCheck.h"

#include <map>
#include <string>
#include <vector>

namespace FlipFree
{

/// Throws the FileProblem "The header of ... cannot be used: FIELD WHAT. Repair the field, or
/// download or copy the file again."
[[noreturn]] void RefuseField(const std::string& file, const std::string& field,
  const std::string& what);

constexpr double GreatestLength = 1e9; ///< mm, of which squares fit in single precision

/// Whether it can be a length or a coordinate in millimeters.
bool IsLength(double value);

/// Why it cannot, as the end of a sentence about it; empty where it can.
std::string WhyNoLength(double value);

/// Throws unless it is one.
void RequireLength(const std::string& file, const std::string& field, double value);

/// The same, and positive.
void RequireSpacing(const std::string& file, const std::string& field, double value);

/// Of three dimensions, voxels along each; further ones are of one voxel. Throws a FileProblem
/// where that is no volume.
std::array<int, 3> VolumeSize(const std::string& file, const std::vector<double>& sizes);

/// Throws the FileProblem of several numbers per voxel.
[[noreturn]] void RefuseComponents(const std::string& file, long count);

/// The grid whose voxels step along the columns of `steps`, in LPS millimeters. Throws a
/// FileProblem where that cannot be inverted.
ImageGeometry GridOfSteps(const std::string& file, const std::array<int, 3>& size,
  const Eigen::Matrix3d& steps, const Eigen::Vector3d& origin);

/// Only raw voxels can be found from the end of the file; throws where `field` puts others there.
void RequireLengthOfVoxels(const std::string& file, const std::string& field,
  const VoxelStorage& storage);

/// What a header may leave out, for which something is taken.
enum class Unsaid
{
  VoxelSize,
  Axes,
  AxesButForNames,
  AxesInSpace, ///< where the file says how its space lies in the patient
  Origin,
  ByteOrder
};

/// One warning of all that the header leaves out, and of what was taken.
void WarnOfUnsaid(const std::string& file, const std::vector<Unsaid>& unsaid,
  std::vector<std::string>& warnings);

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

  /// All must be numbers.
  std::vector<double> Numbers(const std::string& field) const;

  /// And as many as wanted.
  std::vector<double> Numbers(const std::string& field, std::size_t count) const;

  /// A whole number within bounds, or the default where there is no such field.
  long Integer(const std::string& field, long least, long greatest, long otherwise) const;

  /// Numbers of voxels along the axes, each 1 to INT_MAX.
  std::vector<double> Sizes(const std::string& field, std::size_t dimension) const;

  [[noreturn]] void Refuse(const std::string& field, const std::string& what) const;

private:
  std::string File;
  std::map<std::string, std::string> Values;
};

/// The lines of a text, one by one.
class LineReader
{
public:
  explicit LineReader(const std::string& text)
    : Text(text)
  {
  }

  /// False at the end. Without the characters that end the line.
  bool Next(std::string& line);

  /// Where the next line begins.
  std::size_t Place() const { return this->Begin; }

private:
  const std::string& Text;
  std::size_t Begin = 0;
};

/// The files that a header names: one, a list of `lines`, or a pattern such as `slice%03d.raw 1 9
/// 1` with a first and a last number and a step, which may be left out where `needsStep` is not
/// set.
std::vector<std::string> FilesOfField(const TextFields& fields, const std::string& field,
  const std::vector<std::string>& lines, bool needsStep);

/// Whether the field says that a list of files follows.
bool IsFileList(const TextFields& fields, const std::string& field);

} // namespace FlipFree

#endif
