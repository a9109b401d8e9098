/**
 * What the subcommands print of their results.
 */
#ifndef FlipFreeCommandSummary_h
#define FlipFreeCommandSummary_h

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Command
{

struct OrganSummary
{
  std::string Title;
  double Milliliters = 0;
  int Iterations = 0;
  std::string StopReason;
  int SelfIntersections = 0;
};

/// Seconds of the stages, as the filters count them.
using StageSeconds = std::array<double, 4>;

/// Rounded down, so that it is never better than it is.
std::string ConfidenceText(double confidence);

/// Of an organ by itself, with its confidence.
std::string OrganText(const OrganSummary& organ, double confidence, double readingSeconds,
  const StageSeconds& seconds);

/// Of a vessel of a session, with its support.
std::string VesselText(const OrganSummary& vessel, double support, double readingSeconds,
  const StageSeconds& seconds);

/// Of an organ of several; `Title` is that of the volume.
std::string GroupText(const OrganSummary& organ, const std::string& name, int label,
  double confidence);
/// Below those of all organs.
std::string GroupEndText(const std::string& title, double readingSeconds,
  const StageSeconds& seconds);

struct TraceSummary
{
  std::string Title;
  int Branches = 0;
  int Vertices = 0;
  std::string StopReason;
  int SelfIntersections = 0;
  double Support = 0;
};

std::string TraceText(const TraceSummary& vessel, const StageSeconds& seconds);

struct LabelSummary
{
  int Label = 0;
  std::string Name;
  double Milliliters = 0;
  int EulerNumber = 0;
  int Triangles = 0;
  long long WrongVoxels = 0;
};

/// Where edges were collapsed.
struct CollapseSummary
{
  long long Triangles = 0;
  double Distance = 0; ///< mm
};

struct SurfacesSummary
{
  std::vector<LabelSummary> Labels;
  long long WrongVoxels = 0;
  double GreatestDistance = 0; ///< mm
  std::optional<CollapseSummary> Collapse;
};

std::string SurfacesText(const SurfacesSummary& surfaces);

struct SeriesSummary
{
  std::string Number;
  std::string UID;
  std::string Modality;
  int Slices = 0;
  std::array<double, 3> Spacing{ { 0, 0, 0 } }; ///< 0 if the series cannot be read
  std::string Description;
};

std::string SeriesText(const std::vector<SeriesSummary>& series);

/// Why there are no questions about an organ that was found.
std::string NothingToAskText(bool startsFromLabels, bool isCarved);

/// What is said of a surface without the guard that does not intersect itself.
inline const char* const NotCertifiedText =
  "The surface is not certified: --guard is off. It does not intersect itself, though.";

} // namespace Command

#endif
