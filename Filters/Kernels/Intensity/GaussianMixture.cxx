#include "Intensity/GaussianMixture.h"

#include "Error.h"
#include "Intensity/RobustStatistics.h"
#include "Quantile.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

constexpr int NumberOfBins = 256;
constexpr int MaximumIterations = 200;
// A number, since Clang 19 crashes where it takes the root itself: for WebAssembly, EIGEN_PI has
// 128 bits.
constexpr long double RootOfTwoPi = 2.506628274631000502415765284811045253L;

struct Histogram
{
  Eigen::ArrayXd Centers;
  Eigen::ArrayXd Counts;
  double Grain = 1; ///< the unit of MixtureSettings::MinimumStandardDeviation
};

double GaussianDensity(const Gaussian& component, double z)
{
  const double x = (z - component.Mean) / component.StandardDeviation;
  return component.Weight * std::exp(-0.5 * x * x) / (component.StandardDeviation * RootOfTwoPi);
}

// The typical difference between a gray value and the next larger one that occurs: 1 for integers,
// almost zero for filtered images.
double TypicalStep(const std::vector<float>& values)
{
  constexpr std::size_t enough = 4096;
  const std::size_t stride = 1 + values.size() / enough;
  std::vector<float> sample;
  for (std::size_t at = 0; at < values.size(); at += stride)
  {
    sample.push_back(values[at]);
  }
  std::sort(sample.begin(), sample.end());
  std::vector<float> steps;
  for (std::size_t at = 1; at < sample.size(); ++at)
  {
    if (sample[at] > sample[at - 1])
    {
      steps.push_back(sample[at] - sample[at - 1]);
    }
  }
  if (steps.empty())
  {
    return 0;
  }
  return TakeMedian(steps);
}

// No unit of gray values is assumed: images may be in Hounsfield units or between 0 and 1.
double GrainOf(const std::vector<float>& values, double low, double high)
{
  const double magnitude = std::max(std::abs(low), std::abs(high));
  if (high - low > 1e-4 * magnitude)
  {
    return std::max(TypicalStep(values), (high - low) / 64);
  }
  return std::max(0.01 * magnitude, LeastDeviation);
}

// A stone or a clip in the seed would stretch the bins until the organ falls into a single one. The
// range is therefore that of the bulk, widened; values beyond count in the outermost bins.
Histogram MakeHistogram(std::vector<float> values)
{
  const double low = TakeQuantile(values, 0.02);
  const double high = TakeQuantile(values, 0.98);
  const double margin = 0.5 * (high - low) + 1e-6 * (std::abs(low) + std::abs(high)) +
    std::numeric_limits<float>::min();
  const double begin = low - margin;
  const double width = (high - low + 2 * margin) / NumberOfBins;

  Histogram histogram;
  histogram.Grain = GrainOf(values, low, high);
  histogram.Centers =
    begin + width * (Eigen::ArrayXd::LinSpaced(NumberOfBins, 0, NumberOfBins - 1) + 0.5);
  histogram.Counts = Eigen::ArrayXd::Zero(NumberOfBins);
  for (float value : values)
  {
    const double bin = std::floor((value - begin) / width);
    histogram.Counts[static_cast<int>(std::max(0.0, std::min(bin, NumberOfBins - 1.0)))] += 1;
  }
  return histogram;
}

// Means at the quantiles: deterministic, and no component starts without data.
std::vector<Gaussian> StartOf(const Histogram& histogram, int components,
  double minimumStandardDeviation)
{
  const double total = histogram.Counts.sum();
  const double mean = (histogram.Counts * histogram.Centers).sum() / total;
  const double variance = (histogram.Counts * (histogram.Centers - mean).square()).sum() / total;
  std::vector<Gaussian> start(components);
  for (int component = 0; component < components; ++component)
  {
    const double goal = total * (component + 0.5) / components;
    double sum = 0;
    int bin = 0;
    while (bin + 1 < NumberOfBins && sum + histogram.Counts[bin] < goal)
    {
      sum += histogram.Counts[bin++];
    }
    start[component].Weight = 1.0 / components;
    start[component].Mean = histogram.Centers[bin];
    start[component].StandardDeviation =
      std::max(minimumStandardDeviation, std::sqrt(variance) / components);
  }
  return start;
}

// One step of expectation maximization; returns the log-likelihood before it.
double ImproveOnce(const Histogram& histogram, double minimumStandardDeviation,
  std::vector<Gaussian>& mixture)
{
  const int size = static_cast<int>(mixture.size());
  Eigen::ArrayXXd share(NumberOfBins, size);
  for (int component = 0; component < size; ++component)
  {
    for (int bin = 0; bin < NumberOfBins; ++bin)
    {
      share(bin, component) = GaussianDensity(mixture[component], histogram.Centers[bin]);
    }
  }
  const Eigen::ArrayXd density = share.rowwise().sum().max(std::numeric_limits<double>::min());
  const double likelihood = (histogram.Counts * density.log()).sum();
  const double total = histogram.Counts.sum();
  for (int component = 0; component < size; ++component)
  {
    const Eigen::ArrayXd count = histogram.Counts * share.col(component) / density;
    const double mass = count.sum();
    if (mass < 1e-9 * total)
    {
      mixture[component].Weight = 0;
      continue;
    }
    const double mean = (count * histogram.Centers).sum() / mass;
    const double variance = (count * (histogram.Centers - mean).square()).sum() / mass;
    mixture[component] = { mass / total, mean,
      std::max(minimumStandardDeviation, std::sqrt(variance)) };
  }
  return likelihood;
}

double Fit(const Histogram& histogram, double minimumStandardDeviation,
  std::vector<Gaussian>& mixture)
{
  const double observations = histogram.Counts.sum();
  double likelihood = -std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < MaximumIterations; ++iteration)
  {
    const double next = ImproveOnce(histogram, minimumStandardDeviation, mixture);
    const bool settled = next - likelihood < 1e-7 * observations;
    likelihood = next;
    if (settled)
    {
      break;
    }
  }
  return likelihood;
}

void Prune(double minimumWeight, std::vector<Gaussian>& mixture)
{
  std::sort(mixture.begin(), mixture.end(),
    [](const Gaussian& a, const Gaussian& b) { return a.Weight > b.Weight; });
  double total = 0;
  std::size_t kept = 0;
  while (kept < mixture.size() && (kept == 0 || mixture[kept].Weight >= minimumWeight))
  {
    total += mixture[kept++].Weight;
  }
  mixture.resize(kept);
  for (Gaussian& component : mixture)
  {
    component.Weight /= total;
  }
}

} // namespace

double GaussianMixture::Density(double z) const
{
  double density = 0;
  for (const Gaussian& component : this->Components)
  {
    density += GaussianDensity(component, z);
  }
  return density;
}

double GaussianMixture::Mode() const
{
  // The maximum lies between the outermost means, or at the mean of a narrow component.
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Gaussian& component : this->Components)
  {
    low = std::min(low, component.Mean);
    high = std::max(high, component.Mean);
  }
  double mode = 0;
  for (const Gaussian& component : this->Components)
  {
    mode = std::max(mode, this->Density(component.Mean));
  }
  const int samples = high > low ? 512 : 0;
  for (int sample = 0; sample <= samples; ++sample)
  {
    const double part = samples > 0 ? static_cast<double>(sample) / samples : 0;
    mode = std::max(mode, this->Density(low + part * (high - low)));
  }
  return mode;
}

double GaussianMixture::ThresholdForMass(double mass) const
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Gaussian& component : this->Components)
  {
    low = std::min(low, component.Mean - 5 * component.StandardDeviation);
    high = std::max(high, component.Mean + 5 * component.StandardDeviation);
  }
  const int samples = 4096;
  std::vector<double> densities(samples);
  double total = 0;
  for (int sample = 0; sample < samples; ++sample)
  {
    densities[sample] = this->Density(low + (high - low) * (sample + 0.5) / samples);
    total += densities[sample];
  }
  std::sort(densities.begin(), densities.end(), std::greater<double>());
  double sum = 0;
  for (double density : densities)
  {
    sum += density;
    if (sum >= mass * total)
    {
      return density / this->Mode();
    }
  }
  return 0;
}

GaussianMixture FitGaussianMixture(const std::vector<float>& values,
  const MixtureSettings& settings)
{
  if (values.empty())
  {
    throw Error(ErrorCode::SeedWithoutVoxels,
      "there are no voxels to fit the foreground's mixture to; raise {SeedRadius}");
  }
  const Histogram histogram = MakeHistogram(values);
  const double minimumStandardDeviation = settings.MinimumStandardDeviation * histogram.Grain;
  const double observations = std::max(2.0, values.size() / settings.Correlation);
  const double scale = observations / static_cast<double>(values.size());

  GaussianMixture best;
  double minimumCriterion = std::numeric_limits<double>::infinity();
  for (int components = 1; components <= settings.MaximumComponents; ++components)
  {
    std::vector<Gaussian> mixture = StartOf(histogram, components, minimumStandardDeviation);
    const double likelihood = Fit(histogram, minimumStandardDeviation, mixture);
    const int parameters = 3 * components - 1;
    const double criterion = parameters * std::log(observations) - 2 * scale * likelihood;
    if (criterion < minimumCriterion)
    {
      minimumCriterion = criterion;
      best.Components = mixture;
    }
  }
  Prune(settings.MinimumWeight, best.Components);
  return best;
}

} // namespace FlipFree
