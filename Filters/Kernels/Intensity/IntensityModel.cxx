#include "Intensity/IntensityModel.h"

#include "Quantile.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <mutex>
#include <numeric>

namespace FlipFree
{
namespace
{

// Values beyond this many standard deviations of the noise count in the histogram's end bins.
constexpr double HalfRange = 30;
constexpr int NumberOfTableBins = 600;
constexpr double Bandwidth = 0.4;
constexpr double MinimumDensity = 1e-6;

// Images without noise (phantoms) still need bins of some width.
double UsableNoise(double noise, const GaussianMixture& mixture)
{
  double deviation = noise;
  for (const Gaussian& component : mixture.Components)
  {
    deviation = std::max(deviation, 0.1 * component.StandardDeviation);
  }
  return deviation;
}

struct Bins
{
  double Begin;
  double Width;

  int operator()(double z) const
  {
    const double place = (z - this->Begin) / this->Width;
    return static_cast<int>(std::max(0.0, std::min(place, NumberOfTableBins - 1.0)));
  }
};

// How many of the image's voxels in the mask are in which bin.
std::vector<std::uint32_t> CountBins(const ImageView<float>& image, const std::array<int, 3>& first,
  const BitMask& mask, const Bins& bins, const ParallelFor& parallelFor)
{
  std::vector<std::uint32_t> counts(NumberOfTableBins, 0);
  std::mutex mutex;
  parallelFor(0, mask.GetGeometry().Dimensions[2],
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::vector<std::uint32_t> own(NumberOfTableBins, 0);
      mask.ForEachRun(begin, end,
        [&](int left, int right, int j, int k)
        {
          const float* const values = &image(first[0] + left, first[1] + j, first[2] + k);
          for (int voxel = 0; voxel < right - left; ++voxel)
          {
            own[bins(values[voxel])] += HasData(values[voxel]) ? 1 : 0;
          }
        });
      const std::lock_guard<std::mutex> lock(mutex);
      std::transform(own.begin(), own.end(), counts.begin(), counts.begin(), std::plus<>());
    });
  return counts;
}

std::vector<double> SmoothHistogram(const ImageView<float>& image, const std::array<int, 3>& first,
  const BitMask& mask, const Bins& bins, double deviation, const ParallelFor& parallelFor)
{
  const std::vector<std::uint32_t> counts = CountBins(image, first, mask, bins, parallelFor);
  const double size = std::accumulate(counts.begin(), counts.end(), 0.0);
  std::vector<double> histogram(NumberOfTableBins, 0.0);
  for (int bin = 0; bin < NumberOfTableBins && size > 0; ++bin)
  {
    histogram[bin] = counts[bin] / size;
  }
  const double s = deviation / bins.Width;
  const int reach = static_cast<int>(3 * s) + 1;
  std::vector<double> smooth(NumberOfTableBins, 0.0);
  double total = 0;
  for (int offset = -reach; offset <= reach; ++offset)
  {
    const double weight = std::exp(-0.5 * offset * offset / (s * s));
    total += weight;
    for (int bin = 0; bin < NumberOfTableBins; ++bin)
    {
      smooth[bin] += weight * histogram[std::max(0, std::min(NumberOfTableBins - 1, bin + offset))];
    }
  }
  for (double& value : smooth)
  {
    value /= total;
  }
  return smooth;
}

} // namespace

int IntensityModel::PlaceOf(float z) const
{
  const float place = (z - this->Begin) / this->Step + 0.5F; // truncated below
  const float last = static_cast<float>(this->Table.size() - 1);
  // NaN goes to the table's beginning.
  const float clamped = place > 0 ? std::min(place, last) : 0;
  return static_cast<int>(clamped);
}

float IntensityModel::ThresholdRoundedUp() const
{
  const auto nearest = static_cast<float>(this->Threshold);
  return nearest < this->Threshold ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                                   : nearest;
}

BitMask IntensityModel::Foreground(const ImageView<float>& image, const VoxelBox& box,
  const ParallelFor& parallelFor) const
{
  std::vector<unsigned char> isForeground;
  for (const float feature : this->Table)
  {
    isForeground.push_back(feature >= this->Threshold ? 1 : 0);
  }
  const auto noData = static_cast<int>(isForeground.size());
  isForeground.push_back(0);
  return MaskOfBox(
    image, box,
    [&](const float* voxels, int count, unsigned char* inside)
    {
      // In two loops, so that the compiler vectorizes the first.
      std::array<int, BitMask::BitsOfWord> places;
      for (int voxel = 0; voxel < count; ++voxel)
      {
        places[voxel] = HasData(voxels[voxel]) ? this->PlaceOf(voxels[voxel]) : noData;
      }
      for (int voxel = 0; voxel < count; ++voxel)
      {
        inside[voxel] = isForeground[places[voxel]];
      }
    },
    parallelFor);
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
    component.StandardDeviation =
      std::hypot(component.StandardDeviation, settings.NoiseWidening * noise);
    low = std::min(low, component.Mean - 8 * component.StandardDeviation);
    high = std::max(high, component.Mean + 8 * component.StandardDeviation);
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

void IntensityModel::Reestimate(const ImageView<float>& image, const std::array<int, 3>& first,
  const BitMask& inside, const BitMask& outside, double noise, const IntensitySettings& settings,
  const ParallelFor& parallelFor)
{
  const double unit = UsableNoise(noise, this->Mixture);
  const float median = MedianOf(image, first, inside);
  const Bins bins{ median - HalfRange * unit, 2 * HalfRange * unit / NumberOfTableBins };
  const std::vector<double> foreground =
    SmoothHistogram(image, first, inside, bins, Bandwidth * unit, parallelFor);
  const std::vector<double> background =
    SmoothHistogram(image, first, outside, bins, Bandwidth * unit, parallelFor);

  std::vector<float> odds(NumberOfTableBins);
  for (int bin = 0; bin < NumberOfTableBins; ++bin)
  {
    const double f = foreground[bin] + MinimumDensity;
    const double b = settings.BackgroundRatio * (background[bin] + 2 * MinimumDensity);
    odds[bin] = static_cast<float>(f / (f + b));
  }
  constexpr float even = 0.5F;
  int least = bins(median);
  int last = least;
  while (least > 0 && odds[least - 1] > even)
  {
    --least;
  }
  while (last + 1 < NumberOfTableBins && odds[last + 1] > even)
  {
    ++last;
  }
  // One empty entry at either end, for all that lies beyond.
  this->Table.assign(NumberOfTableBins + 2, 0.0F);
  std::copy(odds.begin() + least, odds.begin() + last + 1, this->Table.begin() + least + 1);
  this->Threshold = settings.Threshold > 0 ? settings.Threshold : even;
  float& atMedian = this->Table[bins(median) + 1];
  atMedian = std::max(atMedian, this->ThresholdRoundedUp());
  this->Step = static_cast<float>(bins.Width);
  this->Begin = static_cast<float>(bins.Begin - 0.5 * bins.Width);
}

float MedianOf(const ImageView<float>& image, const std::array<int, 3>& first, const BitMask& mask)
{
  std::vector<float> values;
  values.reserve(mask.Count());
  mask.ForEachRun(0, mask.GetGeometry().Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      const float* const row = &image(first[0], first[1] + j, first[2] + k);
      std::copy_if(row + begin, row + end, std::back_inserter(values), HasData);
    });
  return values.empty() ? 0 : TakeMedian(values);
}

} // namespace FlipFree
