#include "Summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace Command
{
namespace
{

template <typename... Values>
std::string Printed(const char* format, Values... values)
{
  const int length = std::snprintf(nullptr, 0, format, values...);
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  std::snprintf(&text[0], text.size(), format, values...);
  text.pop_back();
  return text;
}

/// Fills up to the width, and counts letters, of which those beyond ASCII have several bytes.
std::string Filled(std::string text, std::ptrdiff_t width)
{
  const auto letters =
    std::count_if(text.begin(), text.end(), [](char byte) { return (byte & 0xC0) != 0x80; });
  text.append(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, width - letters)), ' ');
  return text;
}

std::string Counted(int number, const char* noun)
{
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

std::string FoundText(const OrganSummary& organ)
{
  return Printed("volume %.1f ml, ", organ.Milliliters) + Counted(organ.Iterations, "iteration") +
    ", " + organ.StopReason + ", " + Counted(organ.SelfIntersections, "self-intersection") + ", ";
}

std::string SupportText(double support)
{
  return Printed("support %.2f", support);
}

std::string ReadingText(double seconds)
{
  return Printed("reading %.2f s, ", seconds);
}

std::string OrganStagesText(const StageSeconds& seconds)
{
  return Printed("smoothing %.2f s, feature %.2f s, deformation %.2f s, label map %.2f s\n",
    seconds[0], seconds[1], seconds[2], seconds[3]);
}

std::string VesselStagesText(const StageSeconds& seconds)
{
  return Printed("path %.2f s, start %.2f s, deformation %.2f s, label map %.2f s\n", seconds[0],
    seconds[1], seconds[2], seconds[3]);
}

std::string SpacingText(const std::array<double, 3>& spacing)
{
  if (spacing[0] <= 0)
  {
    return "-"; // it cannot be read
  }
  std::ostringstream text;
  text << spacing[0] << " x " << spacing[1] << " x " << spacing[2];
  return text.str();
}

} // namespace

std::string ConfidenceText(double confidence)
{
  return Printed("%.2f", std::floor(100 * confidence) / 100);
}

std::string OrganText(const OrganSummary& organ, double confidence, double readingSeconds,
  const StageSeconds& seconds)
{
  return organ.Title + ": " + FoundText(organ) + "confidence " + ConfidenceText(confidence) + "; " +
    ReadingText(readingSeconds) + OrganStagesText(seconds);
}

std::string VesselText(const OrganSummary& vessel, double support, double readingSeconds,
  const StageSeconds& seconds)
{
  return vessel.Title + ": " + FoundText(vessel) + SupportText(support) + "; " +
    ReadingText(readingSeconds) + VesselStagesText(seconds);
}

std::string GroupText(const OrganSummary& organ, const std::string& name, int label,
  double confidence)
{
  return organ.Title + ", " + name + ": label " + std::to_string(label) + ", " + FoundText(organ) +
    "confidence " + ConfidenceText(confidence) + "\n";
}

std::string GroupEndText(const std::string& title, double readingSeconds,
  const StageSeconds& seconds)
{
  return title + ": organs do not meet; " + ReadingText(readingSeconds) + OrganStagesText(seconds);
}

std::string TraceText(const TraceSummary& vessel, const StageSeconds& seconds)
{
  return vessel.Title +
    Printed(": %d %s, %d vertices, ", vessel.Branches, vessel.Branches == 1 ? "branch" : "branches",
      vessel.Vertices) +
    vessel.StopReason + ", " + Counted(vessel.SelfIntersections, "self-intersection") + ", " +
    SupportText(vessel.Support) + "; " + VesselStagesText(seconds);
}

std::string SurfacesText(const SurfacesSummary& surfaces)
{
  std::string text = Printed("%10s  %-24s  %11s  %6s  %9s  %12s\n", "Label", "Name", "Milliliters",
    "Euler", "Triangles", "Wrong voxels");
  for (const LabelSummary& one : surfaces.Labels)
  {
    text += Printed("%10d  ", one.Label) + Filled(one.Name, 24) +
      Printed("  %11.3f  %6d  %9d  %12lld\n", one.Milliliters, one.EulerNumber, one.Triangles,
        one.WrongVoxels);
  }
  text += Printed("%lld voxels on the wrong side; vertices lie at most %.2f mm from the corners "
                  "where voxels of different labels meet\n",
    surfaces.WrongVoxels, surfaces.GreatestDistance);
  if (surfaces.Collapse)
  {
    text += Printed("%lld triangles; walls lie at most %.2f mm from where they were before edges "
                    "were collapsed\n",
      surfaces.Collapse->Triangles, surfaces.Collapse->Distance);
  }
  return text;
}

std::string SeriesText(const std::vector<SeriesSummary>& series)
{
  int widest = 3;
  for (const SeriesSummary& one : series)
  {
    widest = std::max(widest, static_cast<int>(one.UID.size()));
  }
  std::string text = Printed("%6s  %-*s  %-8s  %6s  %-24s  %s\n", "Number", widest, "UID",
    "Modality", "Slices", "Spacing (mm)", "Description");
  for (const SeriesSummary& one : series)
  {
    text += Printed("%6s  %-*s  %-8s  %6d  %-24s  %s\n", one.Number.c_str(), widest,
      one.UID.c_str(), one.Modality.c_str(), one.Slices, SpacingText(one.Spacing).c_str(),
      one.Description.c_str());
  }
  return text;
}

std::string NothingToAskText(bool startsFromLabels, bool isCarved)
{
  const char* const why = startsFromLabels ? "a start from labels has no questions"
    : isCarved                             ? "no part alone is in doubt"
                                           : "questions come with --carving";
  return std::string("--ask: there is nothing to ask; ") + why + ".\n";
}

} // namespace Command
