#include "Vessel/VesselSpeed.h"

#include "Image/DistanceTransform.h"
#include "Intensity/RobustStatistics.h"
#include "Vessel/Tubeness.h"
#include "Vessel/VesselImage.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Where a ball is wider than the vessel in it, up to half of its voxels are others, darker ones.
RobustStatistics StatisticsOfBrighterHalf(std::vector<float>& values)
{
  constexpr double deviationOfHalf =
    0.593; // estimated from the upper half of a normal distribution
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  values.erase(values.begin(), middle);
  RobustStatistics statistics = RobustStatisticsOf(values);
  statistics.StandardDeviation /= deviationOfHalf;
  return statistics;
}

// In gray values per millimeter, by central differences, at the rim of the image one-sided.
double GradientSquare(const ImageView<float>& image, int i, int j, int k)
{
  const int place[3] = { i, j, k };
  double square = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    int before[3] = { i, j, k };
    int after[3] = { i, j, k };
    before[axis] = std::max(0, place[axis] - 1);
    after[axis] = std::min(image.Geometry.Dimensions[axis] - 1, place[axis] + 1);
    const int voxels = std::max(1, after[axis] - before[axis]);
    const double slope =
      (image(after[0], after[1], after[2]) - image(before[0], before[1], before[2])) /
      (voxels * image.Geometry.Spacing[axis]);
    square += slope * slope;
  }
  return square;
}

} // namespace

VesselIntensities IntensitiesAtPoints(const ImageView<float>& image, const PointList& points,
  double radius, const VesselSpeedSettings& settings)
{
  const double ball = std::min(settings.MaximumBall, std::max(settings.MinimumBall, radius));
  VesselIntensities result;
  result.Low = std::numeric_limits<double>::infinity();
  result.High = -result.Low;
  double deviations = 0;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    std::vector<float> values;
    for (const std::size_t voxel :
      VoxelsInSphere(image.Geometry, { points.row(point).transpose(), ball }))
    {
      values.push_back(image.Data[voxel]);
    }
    const RobustStatistics statistics =
      settings.Bright ? StatisticsOfBrighterHalf(values) : RobustStatisticsOf(values);
    deviations += statistics.StandardDeviation;
    result.Low = std::min(result.Low, statistics.Median);
    result.High = std::max(result.High, statistics.Median);
  }
  result.High += settings.HighAllowance;
  result.Deviation = std::min(settings.MaximumDeviation,
    std::max(settings.MinimumDeviation, deviations / static_cast<double>(points.rows())));
  return result;
}

std::vector<float> DepthOf(const ImageView<float>& image, const VesselIntensities& intensities,
  const ParallelFor& parallelFor)
{
  std::vector<unsigned char> like(image.Geometry.NumberOfVoxels());
  std::transform(image.Data, image.Data + like.size(), like.begin(),
    [&](float value) { return intensities.Distance(value) < 2 ? 1 : 0; });
  std::vector<float> depth = SquaredDistance(like, image.Geometry, 0, parallelFor, NeverStop);
  std::transform(depth.begin(), depth.end(), depth.begin(),
    [](float square) { return std::sqrt(square); });
  return depth;
}

SpeedScales MakeSpeedScales(const FloatImage& image, const VesselSpeedSettings& settings,
  const ParallelFor& parallelFor)
{
  const double topHatDeviation = 16 / std::sqrt(12.0); // of a box of 16 mm
  SpeedScales scales;
  if (settings.TopHat > 0)
  {
    scales.Background = image;
    SmoothInside(scales.Background, topHatDeviation, parallelFor);
  }
  if (settings.Tube > 0)
  {
    scales.Tubes = image;
    SmoothInside(scales.Tubes, settings.TubeDeviation, parallelFor);
  }
  return scales;
}

FloatImage MakeVesselSpeed(const FloatImage& image, const SpeedScales& scales,
  const VesselIntensities& intensities, const std::vector<float>& depth, double radius,
  const VesselSpeedSettings& settings, const ParallelFor& parallelFor)
{
  std::vector<float> tubes;
  if (settings.Tube > 0)
  {
    constexpr double farthest = 3; // from the vessel's gray values
    std::vector<unsigned char> wanted(image.Voxels.size());
    std::transform(image.Voxels.begin(), image.Voxels.end(), wanted.begin(),
      [&](float value) { return intensities.Distance(value) < farthest ? 1 : 0; });
    tubes = BrightTubeness(scales.Tubes, wanted, settings.TubeDeviation, parallelFor);
  }
  const double cap = std::min(settings.MaximumCap, std::max(settings.MinimumCap, radius));
  const double body = std::max(settings.MinimumBody, settings.BodyScale * radius);
  FloatImage speed;
  speed.Geometry = image.Geometry;
  speed.Voxels.resize(image.Voxels.size());
  const auto at = [&](int i, int j, int k)
  {
    const std::size_t voxel = image.Geometry.Offset(i, j, k);
    const double value = image.Voxels[voxel];
    const double e = intensities.Distance(value);
    double factor = std::exp(-0.5 * e * e -
      GradientSquare(image.View(), i, j, k) / (settings.EdgeStrength * settings.EdgeStrength));
    factor *= std::min<double>(depth[voxel], cap) / cap;
    factor *= depth[voxel] > body ? std::pow(body / depth[voxel], 3) : 1;
    if (settings.TopHat > 0)
    {
      factor /= 1 +
        std::exp(-(value - scales.Background.Voxels[voxel] - settings.TopHat) / settings.TopHat);
    }
    if (settings.Tube > 0)
    {
      const double tube = tubes[voxel] / settings.Tube;
      factor *= tube * tube / (1 + tube * tube);
    }
    return static_cast<float>(factor + settings.Floor);
  };
  parallelFor(0, image.Geometry.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < image.Geometry.Dimensions[1]; ++j)
        {
          for (int i = 0; i < image.Geometry.Dimensions[0]; ++i)
          {
            speed.Voxels[image.Geometry.Offset(i, j, k)] = at(i, j, k);
          }
        }
      }
    });
  return speed;
}

} // namespace FlipFree
