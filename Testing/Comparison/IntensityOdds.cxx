#include "IntensityOdds.h"

#include "Intensity/IntensityModel.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

constexpr std::size_t Samples = 200000;
constexpr int Bins = 4096;
// Values further from the seed's mixture have no chance, and need no model.
constexpr double StandardDeviations = 10;

struct Range
{
  double Begin;
  double End;
};

Range SupportOf(const GaussianMixture& mixture)
{
  Range range{ HUGE_VAL, -HUGE_VAL };
  for (const Gaussian& component : mixture.Components)
  {
    range.Begin =
      std::min(range.Begin, component.Mean - StandardDeviations * component.StandardDeviation);
    range.End =
      std::max(range.End, component.Mean + StandardDeviations * component.StandardDeviation);
  }
  return range;
}

GaussianMixture FitSurroundings(const std::vector<float>& voxels, const Range& range)
{
  const std::size_t step = std::max<std::size_t>(1, voxels.size() / Samples);
  std::vector<float> values;
  for (std::size_t voxel = 0; voxel < voxels.size(); voxel += step)
  {
    if (voxels[voxel] > range.Begin && voxels[voxel] < range.End)
    {
      values.push_back(voxels[voxel]);
    }
  }
  MixtureSettings settings;
  settings.MaximumComponents = 6;
  settings.MinimumWeight = 0.01;
  settings.Correlation = 1; // they are few enough, and far apart
  return values.empty() ? GaussianMixture() : FitGaussianMixture(values, settings);
}

} // namespace

std::vector<float> LogOddsOf(const BaselineTask& task, double noiseWidening,
  const ParallelFor& parallelFor)
{
  IntensitySettings settings;
  settings.NoiseWidening = noiseWidening;
  std::vector<float> seed(task.SeedVoxels.size());
  std::transform(task.SeedVoxels.begin(), task.SeedVoxels.end(), seed.begin(),
    [&task](std::size_t voxel) { return task.Region.Voxels[voxel]; });
  const GaussianMixture organ = IntensityModel::FromSeed(seed, task.Noise, settings).Mixture;
  const Range range = SupportOf(organ);
  const GaussianMixture around = FitSurroundings(task.Region.Voxels, range);

  std::vector<float> table(Bins);
  const double width = (range.End - range.Begin) / Bins;
  for (int bin = 0; bin < Bins; ++bin)
  {
    const double value = range.Begin + (bin + 0.5) * width;
    const double odds =
      std::log(std::max(organ.Density(value), 1e-300) / std::max(around.Density(value), 1e-300));
    table[bin] = std::max(-MaximumLogOdds, std::min(MaximumLogOdds, static_cast<float>(odds)));
  }
  std::vector<float> result(task.Region.Voxels.size());
  parallelFor(0, static_cast<std::ptrdiff_t>(result.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t voxel = first; voxel < last; ++voxel)
      {
        const double bin = std::floor((task.Region.Voxels[voxel] - range.Begin) / width);
        result[voxel] =
          bin >= 0 && bin < Bins ? table[static_cast<std::size_t>(bin)] : -MaximumLogOdds;
      }
    });
  return result;
}

} // namespace FlipFree
