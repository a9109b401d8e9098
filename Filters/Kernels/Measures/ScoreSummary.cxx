#include "Measures/ScoreSummary.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace FlipFree
{

std::string SummaryOf(const SegmentationScores& scores)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(4);
  text << "Dice                 " << scores.Dice << "\n";
  text << "Jaccard              " << scores.Jaccard << "\n";
  text << std::setprecision(2);
  text << "volume               " << scores.SegmentationVolume << " ml, reference "
       << scores.ReferenceVolume << " ml, difference " << std::showpos
       << 100 * scores.RelativeVolumeDifference << std::noshowpos << " %\n";
  text << std::setprecision(3);
  text << "surface distance     mean " << scores.ASD << " mm, RMS " << scores.RMS << " mm\n";
  text << "Hausdorff distance   " << scores.HD << " mm, 95th percentile " << scores.HD95 << " mm\n";
  text << "measured             overlap of the " << scores.OverlapOf << ", distances of the "
       << scores.DistanceOf << ", weighted by area\n";
  return text.str();
}

std::string SummaryOf(const SurfaceValidity& validity)
{
  const SurfaceTopology& topology = validity.Quality.Topology;
  const int open = topology.BoundaryEdges;
  return std::string("surface              ") + (validity.IsValid() ? "valid" : "not valid") +
    ": " + (open > 0 ? std::to_string(open) + " open edges" : "closed") + ", Euler number " +
    std::to_string(topology.EulerNumber()) + ", self-intersections " +
    std::to_string(validity.SelfIntersections) + "\n";
}

} // namespace FlipFree
