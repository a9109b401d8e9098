#include "Vessel/VesselWarnings.h"

#include "MessageText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace FlipFree
{
namespace
{

// How far the surface extends beyond the disks at the ends, in mm.
double BeyondEnds(const VesselTree& tree, const PointList& points)
{
  double farthest = 0;
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    const Eigen::Vector3d point = points.row(vertex);
    double nearest = std::numeric_limits<double>::infinity();
    double beyond = 0;
    for (const VesselBranch& branch : tree.Branches)
    {
      const auto& frames = branch.Sections.Frames;
      for (std::size_t section = 0; section < frames.size(); ++section)
      {
        const Eigen::Vector3d offset = point - frames[section].Origin;
        if (offset.squaredNorm() < nearest)
        {
          nearest = offset.squaredNorm();
          const double along = offset.dot(frames[section].Tangent);
          const bool isStart = section == 0 && branch.Parent < 0;
          beyond = isStart ? -along : (section + 1 == frames.size() ? along : 0);
        }
      }
    }
    farthest = std::max(farthest, beyond);
  }
  return farthest;
}

// Where a path runs at the border of the image, if it does: what it follows goes on beyond. The
// ends of a vessel may lie there.
std::optional<Eigen::Vector3d> PlaceAtBorder(const ImageGeometry& geometry, const VesselTree& tree)
{
  constexpr double margin = 1.5; // mm, from the outer faces of the outermost voxels
  constexpr double end = 10;     // mm
  for (const VesselBranch& branch : tree.Branches)
  {
    const auto& frames = branch.Sections.Frames;
    for (const SectionFrame& frame : frames)
    {
      if ((frame.Origin - frames.front().Origin).norm() < end ||
        (frame.Origin - frames.back().Origin).norm() < end)
      {
        continue;
      }
      const Eigen::Vector3d index = geometry.ToIndex(frame.Origin);
      for (int axis = 0; axis < 3; ++axis)
      {
        // At the centers of the outermost voxels, where these are large.
        const double least = std::max(0.0, margin / geometry.Spacing[axis] - 0.5) + 1e-6;
        if (index[axis] < least || index[axis] > geometry.Dimensions[axis] - 1 - least)
        {
          return frame.Origin;
        }
      }
    }
  }
  return std::nullopt;
}

} // namespace

void AddWarnings(const ImageGeometry& geometry, const PointList& points, double doubtful,
  VesselSegmentation& result)
{
  constexpr double tolerance = 3; // mm
  if (result.Surface.Reason == StopReason::NotRefined)
  {
    result.Warnings.emplace_back(
      "The surface could not be refined without intersecting itself, and "
      "is coarse; set {Levels} to 1, or move the points apart.");
  }
  if (result.Confidence.Value < doubtful)
  {
    const std::string cause = result.Confidence.IsFaint
      ? "the vessel's boundary is hardly visible in the image, least of all"
      : "the path leaves what looks like the vessel at its points, most of all";
    result.Warnings.push_back("The result is doubtful: " + cause + " near " +
      TextOf(result.Confidence.Place.array().round().matrix().transpose()) +
      " mm; look there first: where the surface is not in the vessel, add a point of the vessel.");
  }
  const double beyond = BeyondEnds(result.Tree, result.Surface.Points);
  if (beyond > tolerance)
  {
    result.Warnings.push_back("The surface extends " + std::to_string(std::lround(beyond)) +
      " mm beyond an end of the path; look at the ends, and move their points.");
  }
  for (const int point : result.Tree.Unlike)
  {
    result.Warnings.push_back("The point " + TextOf(points.row(point)) +
      " mm does not look like the vessel, which is brighter or darker nearby; move the point into "
      "the vessel.");
  }
  if (const auto place = PlaceAtBorder(geometry, result.Tree))
  {
    result.Warnings.push_back(
      "The path leaves the image near " + TextOf(*place) + " mm; add a point along the vessel.");
  }
}

} // namespace FlipFree
