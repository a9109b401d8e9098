/**
 * How files of points are read, whatever their points mean: tables (.csv) line by line, and markups
 * of 3D Slicer (.mrk.json), LPS or RAS and in the unit that the file says, control point by control
 * point. Control points that have not been placed are left out.
 * The package without VTK reads them, too (_point_files.py); a test holds the two together.
 */
#ifndef FlipFreeCommandPointText_h
#define FlipFreeCommandPointText_h

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace Command
{

/// What becomes of the entries. Each throws Failure with what is wrong.
struct PointReader
{
  std::string Columns; ///< of the tables, for messages

  /// Whether the first line names the columns. Throws Failure for others than those of the lines.
  std::function<bool(const std::vector<std::string>& cells)> IsHeader;

  std::function<void(const std::vector<std::string>& cells)> TakeCells;

  /// The place is in LPS millimeters.
  std::function<void(const std::string& label, const std::array<double, 3>& place)> TakeControl;
};

/// The endings of files of points.
const std::vector<std::string>& PointEndings();

/// Throws Failure, naming the file, the line or the control point, and what is wrong.
void ReadPointText(const std::string& name, const PointReader& reader);

/// Whether cells are these names, in any case.
bool AreColumns(const std::vector<std::string>& cells, const std::vector<std::string>& names);

/// Throws Failure unless the text is a decimal number.
double PointNumberOf(const std::string& text);

/// With letters from A to Z made small.
std::string Lower(std::string word);

} // namespace Command

#endif
