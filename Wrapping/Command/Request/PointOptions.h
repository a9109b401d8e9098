/**
 * The options that correct a segmentation: points inside the organ or vessel, outside
 * it, on its boundary, and strokes of such points.
 */
#ifndef FlipFreeCommandPointOptions_h
#define FlipFreeCommandPointOptions_h

#include "PointFile.h"

#include <array>
#include <map>
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
  void AddOptions(CLI::App& command);

  /// Whether none of the options is given.
  bool IsEmpty() const;

  /// Throws WrongUsage for coordinates that are not finite and files of another ending.
  void Validate() const;

  /// A point of the command line, such as the seed or a vessel's point, in LPS millimeters.
  std::array<double, 3> InLps(const double* given) const;

  /// All points in LPS millimeters, those of the file first. Throws Failure if it cannot be read.
  std::vector<CorrectionPoint> Points() const;

  /// What the value of that number, from 1, completes of an option, named without its dashes: a
  /// point, a stroke, or nothing.
  std::vector<CorrectionPoint> PointsEndingAt(const std::string& option, std::size_t number) const;

  /// Whether points are read from a file, or written.
  bool HasFiles() const { return !this->PointsIn.empty() || !this->PointsOut.empty(); }

  /// Whether the command line has RAS coordinates.
  bool AreRas() const { return this->RAS; }

  /// Where points are read from; empty if nowhere.
  const std::string& Input() const { return this->PointsIn; }

  /// The files of strokes.
  std::vector<std::string> StrokeFiles() const;

  /// Where all points are to be written; empty if nowhere.
  const std::string& Output() const { return this->PointsOut; }

private:
  /// By the name of the option; three numbers of each point.
  std::map<std::string, std::vector<double>> Coordinates;
  std::map<std::string, std::vector<std::string>> Strokes;
  std::string PointsIn;
  std::string PointsOut;
  bool RAS = false;
};

} // namespace Command

#endif
