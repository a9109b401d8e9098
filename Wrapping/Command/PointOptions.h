/**
 * The options that correct a segmentation: points inside the organ or vessel, outside
 * it, on its boundary.
 */
#ifndef FlipFreeCommandPointOptions_h
#define FlipFreeCommandPointOptions_h

#include "PointFile.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace Command
{

class PointOptions
{
public:
  /// `what` is segmented: "organ", which takes further seeds, or "vessel".
  void AddOptions(CLI::App& command, const std::string& what);

  /// Whether none of the options is given.
  bool IsEmpty() const;

  /// Throws WrongUsage for coordinates that are not finite and files of another ending.
  void RequireSense() const;

  /// A point of the command line, such as the seed or a vessel's point, in LPS millimeters.
  std::array<double, 3> InLps(const double* given) const;

  /// All points in LPS millimeters, those of the file first. Throws Failure if it cannot be read.
  std::vector<CorrectionPoint> Points() const;

  /// The kind of the points that an option takes, named without its dashes; none of other options.
  static std::optional<FlipFree::ConstraintKind> KindOfOption(const std::string& name);

  /// The point of that kind, which is not a seed, and number, from 0, of the command line.
  CorrectionPoint PointOf(FlipFree::ConstraintKind kind, std::size_t number) const;

  /// Whether points are read from a file, or written.
  bool HasFiles() const { return !this->PointsIn.empty() || !this->PointsOut.empty(); }

  /// Whether the command line has RAS coordinates.
  bool AreRas() const { return this->RAS; }

  /// Where points are read from; empty if nowhere.
  const std::string& Input() const { return this->PointsIn; }

  /// Where all points are to be written; empty if nowhere.
  const std::string& Output() const { return this->PointsOut; }

private:
  const std::vector<double>& CoordinatesOf(FlipFree::ConstraintKind kind) const;

  std::array<std::vector<double>, 3> Coordinates; // by the kind, three numbers of each point
  std::string PointsIn;
  std::string PointsOut;
  bool RAS = false;
};

} // namespace Command

#endif
