#include "Intensity/GrayValueSimilarity.h"

#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Gray values look alike within this many standard deviations.
constexpr double SimilarDeviations = 2;

// Shells about a point look like it as long as this part of their voxels lies within this many
// deviations of the innermost ball's median; the ball in millimeters and voxels.
constexpr double AlikePart = 0.5;
constexpr double ShellDeviations = 2.5;
constexpr double FirstBall = 3;
constexpr double FirstBallVoxels = 1.5;

} // namespace

double GrayValueSimilarity::SpreadOf(const RobustStatistics& of) const
{
  constexpr double ofMR = 0.03; // of the median
  constexpr double ofCT = 5;    // Hounsfield units
  const double least =
    std::max({ 0.5 * this->Noise, this->IsMR ? ofMR * std::abs(of.Median) : ofCT, 1e-12 });
  return std::max(of.StandardDeviation, least);
}

double GrayValueSimilarity::LikenessOf(double value, const RobustStatistics& of) const
{
  const double deviations = (value - of.Median) / this->SpreadOf(of);
  const double fit = (SimilarDeviations * SimilarDeviations - deviations * deviations) / 4;
  return std::max(-1.0, std::min(1.0, fit));
}

double GrayValueSimilarity::ReachOfLikeness(const ImageView<float>& image,
  const Eigen::Vector3d& point, double limit) const
{
  const ImageGeometry& geometry = image.Geometry;
  const double step = geometry.Spacing.maxCoeff();
  const double first = std::max(FirstBall, FirstBallVoxels * geometry.Spacing.minCoeff());
  const VoxelBox box = BoxAround(geometry, point, std::max(limit, first));
  std::vector<float> inner;
  std::vector<std::vector<float>> shells(static_cast<std::size_t>(limit / step) + 2);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        const double away = (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - point).norm();
        if (away <= first)
        {
          inner.push_back(image(i, j, k));
        }
        const auto shell = static_cast<std::size_t>(away / step);
        if (shell < shells.size())
        {
          shells[shell].push_back(image(i, j, k));
        }
      }
    }
  }
  const RobustStatistics of = RobustStatisticsOf(inner);
  const double spread = this->SpreadOf(of);
  double reach = step;
  for (std::size_t shell = 0; shell < shells.size(); ++shell)
  {
    const auto alike = std::count_if(shells[shell].begin(), shells[shell].end(),
      [&](float value) { return std::abs(value - of.Median) < ShellDeviations * spread; });
    if (static_cast<double>(alike) < AlikePart * static_cast<double>(shells[shell].size()))
    {
      break;
    }
    reach = static_cast<double>(shell + 1) * step;
  }
  return std::min(reach, limit);
}

RobustStatistics StatisticsInBall(const ImagePart& image, const ImageGeometry& geometry,
  const SeedSphere& ball)
{
  std::vector<float> values;
  for (const std::size_t voxel : VoxelsAround(geometry, ball))
  {
    const std::array<int, 3> index = IndexOf(voxel, geometry);
    values.push_back(image.Row(index[1], index[2])[index[0]]);
  }
  return RobustStatisticsOf(values);
}

} // namespace FlipFree
