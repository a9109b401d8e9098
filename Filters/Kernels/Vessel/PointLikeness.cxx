#include "Vessel/PointLikeness.h"

#include "Image/SeedRegion.h"
#include "Intensity/RobustStatistics.h"
#include "Quantile.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

constexpr double Ball = 2.2; // mm
// Sections this far from a point tell what the vessel looks like there, mm.
constexpr double NearestSection = 12;
constexpr double FarthestSection = 60;
constexpr std::size_t FewestSections = 8;
constexpr double LeastDeviationNearby = 10;
constexpr double LargestDeviationNearby = 25;
constexpr double ClearlyBeyond = 5; // deviations: contrast medium mixes where veins meet

double MedianAround(const ImageView<float>& image, const Eigen::Vector3d& place)
{
  std::vector<float> values;
  for (const std::size_t voxel : VoxelsAround(image.Geometry, { place, Ball }))
  {
    values.push_back(image.Data[voxel]);
  }
  return RobustStatisticsOf(values).Median;
}

} // namespace

std::vector<int> PointsUnlike(const ImageView<float>& image, const VesselTree& tree,
  const PointList& points)
{
  PointList centers(0, 3);
  std::vector<float> medians;
  for (const VesselBranch& branch : tree.Branches)
  {
    const PointList more = branch.Sections.Centers();
    centers.conservativeResize(centers.rows() + more.rows(), 3);
    centers.bottomRows(more.rows()) = more;
    for (Eigen::Index section = 0; section < more.rows(); ++section)
    {
      medians.push_back(static_cast<float>(MedianAround(image, more.row(section).transpose())));
    }
  }
  std::vector<int> unlike;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    std::vector<float> near;
    for (Eigen::Index section = 0; section < centers.rows(); ++section)
    {
      const double distance = (centers.row(section) - points.row(point)).norm();
      if (distance > NearestSection && distance < FarthestSection)
      {
        near.push_back(medians[section]);
      }
    }
    if (near.size() < FewestSections)
    {
      continue;
    }
    const double low = TakeQuantile(near, 0.1);
    const double high = TakeQuantile(near, 0.9);
    const double deviation = std::min(LargestDeviationNearby,
      std::max(LeastDeviationNearby, RobustStatisticsOf(near).StandardDeviation));
    const double value = MedianAround(image, points.row(point).transpose());
    if (std::max(low - value, value - high) > ClearlyBeyond * deviation)
    {
      unlike.push_back(static_cast<int>(point));
    }
  }
  return unlike;
}

} // namespace FlipFree
