#include "Deformation/PlausibilityCheck.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// On organs fewer than a twentieth of the vertices find no boundary, and hardly any lie at the
// image's boundary along two axes, even where a slab cuts off a liver above and below.
constexpr double MaximumWithoutBoundary = 0.1;
constexpr double MaximumAtImageBoundary = 0.25;

// Whether points lie at a side of the region where the image goes on.
bool TouchesEnd(const ImageGeometry& region, const ImageGeometry& image, const PointList& points)
{
  const Eigen::Vector3d first = image.ToIndex(region.ToPhysical(Eigen::Vector3d::Zero()));
  for (int axis = 0; axis < 3; ++axis)
  {
    const double size = region.Dimensions[axis];
    const bool isCutBelow = first[axis] > 0.5;
    const bool isCutAbove = first[axis] + size < image.Dimensions[axis] - 0.5;
    for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
    {
      const double index = region.ToIndex(points.row(vertex).transpose())[axis];
      if ((isCutBelow && index < 0) || (isCutAbove && index > size - 1))
      {
        return true;
      }
    }
  }
  return false;
}

// The fraction of the points that lie in the image's outermost voxels along any axis but the one
// along which most of them do: a stack of few slices, or a slab that cuts off an organ above and
// below, is not a sign of a leak.
double FractionAtBoundary(const ImageGeometry& image, const PointList& points)
{
  const Eigen::Array3d last(image.Dimensions[0] - 1, image.Dimensions[1] - 1,
    image.Dimensions[2] - 1);
  Eigen::Array3i ofAxis = Eigen::Array3i::Zero();
  Eigen::Array3i ofOthers = Eigen::Array3i::Zero(); // at the ends of either of the two other axes
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    const Eigen::Array3d index = image.ToIndex(points.row(vertex).transpose());
    const Eigen::Array<bool, 3, 1> atEnd = index < 0.5 || index > last - 0.5;
    for (int axis = 0; axis < 3; ++axis)
    {
      ofAxis[axis] += atEnd[axis];
      ofOthers[axis] += atEnd[(axis + 1) % 3] || atEnd[(axis + 2) % 3];
    }
  }
  Eigen::Index most = 0;
  ofAxis.maxCoeff(&most);
  return ofOthers[most] / static_cast<double>(points.rows());
}

// The fraction of the vertices that found no boundary in a run's last iteration; with carving,
// which gives the second run's foreground a boundary on all sides, that of the run that found less.
double FractionWithoutBoundary(const std::vector<IterationRecord>& iterations, int levels)
{
  double fraction = 0;
  for (auto record = iterations.begin(); record != iterations.end(); ++record)
  {
    const auto next = record + 1;
    if (next == iterations.end() || (record->Level < levels && next->Level >= levels))
    {
      fraction =
        std::max(fraction, static_cast<double>(record->Targets.WithoutBoundary) / record->Vertices);
    }
  }
  return fraction;
}

} // namespace

Implausibility CheckPlausibility(const OrganSurface& organ, const ImageGeometry& region,
  const ImageGeometry& image, double seedRadius, const OrganSegmentationSettings& settings,
  bool startsAtSeed)
{
  if (TouchesEnd(region, image, organ.Points))
  {
    return { ImplausibilityReason::EndOfReach, 0 };
  }
  if (!startsAtSeed || !settings.Step.Guard || organ.Iterations.empty())
  {
    return {};
  }
  const double without =
    FractionWithoutBoundary(organ.Iterations, settings.Schedule.NumberOfLevels());
  if (without > MaximumWithoutBoundary &&
    SearchDistanceOf(settings.Targets, seedRadius) >= SearchDistanceOf({}, seedRadius))
  {
    return { ImplausibilityReason::NoBoundary, without };
  }
  const double atBoundary = FractionAtBoundary(image, organ.Points);
  if (atBoundary > MaximumAtImageBoundary)
  {
    return { ImplausibilityReason::ImageBoundary, atBoundary };
  }
  return {};
}

} // namespace FlipFree
