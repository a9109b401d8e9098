/**
 * How files of points are read, whatever their points mean: tables (.csv), by the kernels, and
 * markups of 3D Slicer (.mrk.json), LPS or RAS and in the unit that the file says, control point by
 * control point. Control points that have not been placed are left out.
 */
#ifndef FlipFreeCommandPointText_h
#define FlipFreeCommandPointText_h

#include <array>
#include <functional>
#include <string>

namespace Command
{

/// What becomes of the entries. Throws Failure with what is wrong in one.
struct PointReader
{
  std::string Columns; ///< of the tables, for messages

  /// Of a whole table. May throw FlipFree::FileProblem, naming the file.
  std::function<void(const std::string& text)> TakeTable;

  /// The place is in LPS millimeters.
  std::function<void(const std::string& label, const std::array<double, 3>& place)> TakeControl;
};

/// Throws Failure, naming the file, the line or the control point, and what is wrong.
void ReadPointText(const std::string& name, const PointReader& reader);

/// What messages call a control point: by its label, or by its number, from 1 on.
std::string NameOfControl(int number, const std::string& label);

/// Throws Failure unless the text is a decimal number.
double PointNumberOf(const std::string& text);

} // namespace Command

#endif
