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

// Shells about a point look like it where their voxels lie within this many deviations of the
// innermost ball's median; the ball in millimeters and voxels.
constexpr double ShellDeviations = 2.5;
constexpr double FirstBall = 3;
constexpr double FirstBallVoxels = 1.5;

} // namespace

void AlikeShells::Add(double away, bool isAlike)
{
  const auto number = static_cast<std::size_t>(away / this->Step);
  if (number < this->Shells.size())
  {
    ++this->Shells[number].Size;
    this->Shells[number].Alike += isAlike ? 1 : 0;
  }
}

double AlikeShells::Reach() const
{
  const auto end = std::find_if(this->Shells.begin(), this->Shells.end(),
    [](const Shell& shell) { return 2 * shell.Alike < shell.Size; });
  return std::min(static_cast<double>(end - this->Shells.begin()) * this->Step, this->Limit);
}

double GrayValueSimilarity::SpreadOf(const RobustStatistics& of) const
{
  constexpr double ofMR = 0.03; // of the median
  constexpr double ofCT = 5;    // Hounsfield units
  const double least =
    std::max({ 0.5 * this->Noise, this->IsMR ? ofMR * std::abs(of.Median) : ofCT, LeastDeviation });
  return std::max(of.StandardDeviation, least);
}

double GrayValueSimilarity::LikenessOf(double value, const RobustStatistics& of) const
{
  const double deviations = (value - of.Median) / this->SpreadOf(of);
  const double fit = (SimilarDeviations * SimilarDeviations - deviations * deviations) / 4;
  return std::max(-1.0, std::min(fit, 1.0)); // -1 of no data, too
}

double GrayValueSimilarity::ReachOfLikeness(const ImagePart& image, const ImageGeometry& geometry,
  const Eigen::Vector3d& point, double limit) const
{
  const double step = geometry.Spacing.maxCoeff();
  const double first = std::max(FirstBall, FirstBallVoxels * geometry.Spacing.minCoeff());
  const VoxelBox box = BoxAround(geometry, point, std::max(limit, first));
  // Calls visit(distance, value).
  const auto forEachVoxel = [&](const auto& visit)
  {
    for (int k = box.Begin[2]; k < box.End[2]; ++k)
    {
      for (int j = box.Begin[1]; j < box.End[1]; ++j)
      {
        for (int i = box.Begin[0]; i < box.End[0]; ++i)
        {
          visit((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - point).norm(), image.Row(j, k)[i]);
        }
      }
    }
  };
  std::vector<float> inner;
  forEachVoxel(
    [&](double away, float value)
    {
      if (away <= first)
      {
        inner.push_back(value);
      }
    });
  const RobustStatistics of = RobustStatisticsOf(inner);
  const double spread = this->SpreadOf(of);
  AlikeShells shells(step, limit);
  forEachVoxel([&](double away, float value)
    { shells.Add(away, std::abs(value - of.Median) < ShellDeviations * spread); });
  return std::min(std::max(step, shells.Reach()), limit);
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
