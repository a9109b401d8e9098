#include "IntensityModel.h"

#include "BallMorphology.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// A histogram's tails beyond this many deviations of the noise count as its ends.
constexpr double HalfRange = 30;
constexpr int NumberOfBins = 600;
constexpr double Bandwidth = 0.4;
constexpr double LeastDensity = 1e-6;

float Median(std::vector<float> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Grey images without noise (phantoms) still need bins of some width.
double UsableNoise(double noise, const GaussianMixture& mixture)
{
  double deviation = noise;
  for (const Gaussian& component : mixture.Components)
  {
    deviation = std::max(deviation, 0.1 * component.Deviation);
  }
  return deviation;
}

struct Bins
{
  double Begin;
  double Width;

  int operator()(double z) const
  {
    const double bin = std::floor((z - this->Begin) / this->Width);
    return static_cast<int>(std::max(0.0, std::min(bin, NumberOfBins - 1.0)));
  }
};

std::vector<double> SmoothHistogram(const std::vector<float>& values, const Bins& bins,
  double deviation)
{
  std::vector<double> histogram(NumberOfBins, 0.0);
  for (float value : values)
  {
    histogram[bins(value)] += 1.0 / static_cast<double>(values.size());
  }
  const double s = deviation / bins.Width;
  const int reach = static_cast<int>(3 * s) + 1;
  std::vector<double> smooth(NumberOfBins, 0.0);
  double total = 0;
  for (int offset = -reach; offset <= reach; ++offset)
  {
    const double weight = std::exp(-0.5 * offset * offset / (s * s));
    total += weight;
    for (int bin = 0; bin < NumberOfBins; ++bin)
    {
      smooth[bin] += weight * histogram[std::max(0, std::min(NumberOfBins - 1, bin + offset))];
    }
  }
  for (double& value : smooth)
  {
    value /= total;
  }
  return smooth;
}

} // namespace

float IntensityModel::operator()(float z) const
{
  const float place = (z - this->Begin) / this->Step + 0.5F; // so that cutting rounds
  const float last = static_cast<float>(this->Table.size() - 1);
  // Written so that a value that is not a number falls to the table's beginning.
  const float clamped = place > 0 ? std::min(place, last) : 0;
  return this->Table[static_cast<std::size_t>(clamped)];
}

IntensityModel IntensityModel::FromSeed(const std::vector<float>& values, double noise,
  const IntensitySettings& settings)
{
  IntensityModel model;
  model.Mixture = FitGaussianMixture(values, settings.Mixture);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  model.Ramp.Low = low;
  model.Ramp.High = high;
  for (Gaussian& component : model.Mixture.Components)
  {
    component.Deviation = std::hypot(component.Deviation, settings.NoiseWidening * noise);
    low = std::min(low, component.Mean - 8 * component.Deviation);
    high = std::max(high, component.Mean + 8 * component.Deviation);
    model.Ramp.Low = std::min(model.Ramp.Low, component.Mean);
    model.Ramp.High = std::max(model.Ramp.High, component.Mean);
  }
  model.Ramp.Width = settings.EdgeRamp * UsableNoise(noise, model.Mixture);
  model.Threshold = settings.Threshold > 0
    ? settings.Threshold
    : model.Mixture.ThresholdForMass(settings.ForegroundMass);

  constexpr int entries = 8192;
  const double mode = model.Mixture.Mode();
  model.Begin = static_cast<float>(low);
  model.Step = static_cast<float>((high - low) / (entries - 1));
  model.Table.resize(entries);
  for (int entry = 0; entry < entries; ++entry)
  {
    const double z = model.Begin + static_cast<double>(model.Step) * entry;
    model.Table[entry] = static_cast<float>(std::min(1.0, model.Mixture.Density(z) / mode));
  }
  return model;
}

void IntensityModel::Reestimate(const std::vector<float>& inside, const std::vector<float>& outside,
  double noise, const IntensitySettings& settings)
{
  const double unit = UsableNoise(noise, this->Mixture);
  const float median = Median(inside);
  const Bins bins{ median - HalfRange * unit, 2 * HalfRange * unit / NumberOfBins };
  const std::vector<double> foreground = SmoothHistogram(inside, bins, Bandwidth * unit);
  const std::vector<double> background = outside.empty()
    ? std::vector<double>(NumberOfBins, 0.0)
    : SmoothHistogram(outside, bins, Bandwidth * unit);

  std::vector<float> odds(NumberOfBins);
  for (int bin = 0; bin < NumberOfBins; ++bin)
  {
    const double f = foreground[bin] + LeastDensity;
    const double b = settings.BackgroundRatio * (background[bin] + 2 * LeastDensity);
    odds[bin] = static_cast<float>(f / (f + b));
  }
  constexpr float even = 0.5F;
  int first = bins(median);
  int last = first;
  while (first > 0 && odds[first - 1] > even)
  {
    --first;
  }
  while (last + 1 < NumberOfBins && odds[last + 1] > even)
  {
    ++last;
  }
  // One empty entry at either end, for all that lies beyond.
  this->Table.assign(NumberOfBins + 2, 0.0F);
  std::copy(odds.begin() + first, odds.begin() + last + 1, this->Table.begin() + first + 1);
  this->Threshold = settings.Threshold > 0 ? settings.Threshold : even;
  this->Table[bins(median) + 1] =
    std::max(this->Table[bins(median) + 1], static_cast<float>(this->Threshold));
  this->Step = static_cast<float>(bins.Width);
  this->Begin = static_cast<float>(bins.Begin - 0.5 * bins.Width);
}

bool SampleInsideAndShell(const ImageView<float>& image, const std::vector<unsigned char>& inside,
  const IntensitySettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<float>& insideValues, std::vector<float>& shellValues)
{
  const auto grow = [&](std::vector<unsigned char>& mask, double radius, unsigned char value,
                      double first, double last)
  {
    return GrowValue(mask, image.Geometry, radius, value, parallelFor,
      PartOf(monitor, first, last));
  };
  insideValues.clear();
  shellValues.clear();
  std::vector<unsigned char> mask = inside;
  if (!grow(mask, settings.InnerMargin, 0, 0, 0.2))
  {
    return false;
  }
  for (std::size_t voxel = 0; voxel < inside.size(); ++voxel)
  {
    if (mask[voxel])
    {
      insideValues.push_back(image.Data[voxel]);
    }
  }
  mask = inside;
  std::vector<unsigned char> around = inside;
  if (!grow(mask, settings.ShellBegin, 1, 0.2, 0.4) ||
    !grow(around, settings.ShellEnd, 1, 0.4, 0.9) || !monitor(0.9))
  {
    return false;
  }
  for (std::size_t voxel = 0; voxel < inside.size(); ++voxel)
  {
    if (around[voxel] && !mask[voxel])
    {
      shellValues.push_back(image.Data[voxel]);
    }
  }
  return true;
}

} // namespace FlipFree
