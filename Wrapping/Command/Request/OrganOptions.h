/**
 * The options by which `flipfree segment` takes several organs: each has a name and a seed sphere,
 * and the points that follow it on the command line.
 */
#ifndef FlipFreeCommandOrganOptions_h
#define FlipFreeCommandOrganOptions_h

#include "PointOptions.h"

#include <array>
#include <string>
#include <vector>

namespace Command
{

struct GivenOrgan
{
  std::string Name;                          ///< as it was given
  std::array<double, 3> Seed{ { 0, 0, 0 } }; // LPS millimeters
  double Radius = 0;
  std::vector<CorrectionPoint> Points;
  std::string Color; ///< #ffd24a; empty for that of its place in the list

  /// The name as it can stand in names of files.
  std::string FileName() const;
};

class OrganOptions
{
public:
  void AddOptions(CLI::App& command);

  bool IsEmpty() const { return this->Values.empty() && this->Fixed.empty(); }
  bool HasOrgans() const { return !this->Values.empty(); }

  /// The organs, after the command line was read: the points of `corrections` belong to the organ
  /// before them. Throws WrongUsage for a value that is not a number, a point before the first
  /// organ, and names that are empty or would give the same file name, and Failure for a stroke
  /// that cannot be read.
  std::vector<GivenOrgan> Organs(const PointOptions& corrections) const;

  /// Files of surfaces that stay as they are.
  const std::vector<std::string>& FixedSurfaces() const { return this->Fixed; }

private:
  const CLI::App* Command = nullptr;
  std::vector<std::string> Values; // five of each organ
  std::vector<std::string> Fixed;
};

} // namespace Command

#endif
