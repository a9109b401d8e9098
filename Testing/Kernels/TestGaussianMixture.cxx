#include "ExampleSurfaces.h"
#include "Intensity/GaussianMixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace FlipFree;

namespace
{

std::vector<float> Sample(const std::vector<Gaussian>& components, int count, unsigned int seed = 1)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<float> values;
  for (int sample = 0; sample < count; ++sample)
  {
    double choice = uniform(random);
    std::size_t at = 0;
    while (at + 1 < components.size() && choice > components[at].Weight)
    {
      choice -= components[at++].Weight;
    }
    values.push_back(
      static_cast<float>(components[at].Mean + components[at].StandardDeviation * normal(random)));
  }
  return values;
}

// Independent observations, nothing pruned: the mixture itself.
MixtureSettings Plain()
{
  MixtureSettings settings;
  settings.Correlation = 1;
  settings.MinimumWeight = 0;
  return settings;
}

std::vector<Gaussian> Fitted(const std::vector<float>& values, const MixtureSettings& settings)
{
  std::vector<Gaussian> components = FitGaussianMixture(values, settings).Components;
  std::sort(components.begin(), components.end(),
    [](const Gaussian& a, const Gaussian& b) { return a.Mean < b.Mean; });
  return components;
}

const std::vector<std::vector<Gaussian>> Examples{ { { 1, 110, 12 } },
  { { 0.4, 60, 8 }, { 0.6, 120, 10 } }, { { 0.3, 0, 10 }, { 0.4, 60, 6 }, { 0.3, 130, 15 } },
  { { 0.3, -5, 0.02 }, { 0.7, -4.8, 0.03 } } };

} // namespace

TEST(GaussianMixture, RecoversKnownMixturesAndTheirNumber)
{
  for (const auto& expected : Examples)
  {
    const std::vector<Gaussian> fitted = Fitted(Sample(expected, 40000), Plain());
    ASSERT_EQ(fitted.size(), expected.size()) << expected[0].Mean;
    for (std::size_t at = 0; at < fitted.size(); ++at)
    {
      EXPECT_NEAR(fitted[at].Weight, expected[at].Weight, 0.03);
      EXPECT_NEAR(fitted[at].Mean, expected[at].Mean, 0.1 * expected[at].StandardDeviation);
      EXPECT_NEAR(fitted[at].StandardDeviation, expected[at].StandardDeviation,
        0.1 * expected[at].StandardDeviation);
    }
  }
}

TEST(GaussianMixture, CorrelatedVoxelsCountLess)
{
  // Two components that 500 independent values tell apart, but not 500 / 27.
  const std::vector<float> values = Sample({ { 0.5, 100, 10 }, { 0.5, 140, 10 } }, 500);
  MixtureSettings settings = Plain();
  EXPECT_EQ(FitGaussianMixture(values, settings).Components.size(), 2u);
  settings.Correlation = 27;
  EXPECT_EQ(FitGaussianMixture(values, settings).Components.size(), 1u);
  settings.Correlation = 1;
  settings.MaximumComponents = 1;
  EXPECT_EQ(FitGaussianMixture(values, settings).Components.size(), 1u);
}

TEST(GaussianMixture, DoesNotDependOnUnitOrOrigin)
{
  for (const auto& example : Examples)
  {
    const std::vector<float> values = Sample(example, 20000, 2);
    const std::vector<Gaussian> fitted = Fitted(values, MixtureSettings());
    for (const auto& [factor, shift] :
      { std::pair<double, double>{ 100, 1000 }, { 0.001, 0 }, { 1, 30000 } })
    {
      std::vector<float> other;
      for (float value : values)
      {
        other.push_back(static_cast<float>(factor * value + shift));
      }
      // What single precision leaves of values far from zero.
      const double grain = 1e-6 * (std::abs(shift) + 1) / factor;
      const std::vector<Gaussian> moved = Fitted(other, MixtureSettings());
      if (grain > 0.01 * example[0].StandardDeviation)
      {
        continue;
      }
      ASSERT_EQ(moved.size(), fitted.size()) << factor << " " << shift;
      for (std::size_t at = 0; at < fitted.size(); ++at)
      {
        const double tolerance = 0.01 * fitted[at].StandardDeviation;
        EXPECT_NEAR(moved[at].Weight, fitted[at].Weight, 0.01);
        EXPECT_NEAR((moved[at].Mean - shift) / factor, fitted[at].Mean, tolerance);
        EXPECT_NEAR(moved[at].StandardDeviation / factor, fitted[at].StandardDeviation, tolerance);
      }
    }
  }
}

TEST(GaussianMixture, IntegersDoNotCollapse)
{
  for (double deviation : { 0.6, 1.5, 4.0 })
  {
    for (double unit : { 1.0, 0.01, 64.0 })
    {
      std::vector<float> values = Sample({ { 1, 100, deviation } }, 40000, 3);
      for (float& value : values)
      {
        value = static_cast<float>(unit * std::round(value));
      }
      const std::vector<Gaussian> fitted = Fitted(values, Plain());
      ASSERT_EQ(fitted.size(), 1u) << deviation << " " << unit;
      EXPECT_NEAR(fitted[0].Mean, 100 * unit, 0.1 * unit);
      const double expected = std::sqrt(deviation * deviation + 1.0 / 12);
      EXPECT_NEAR(fitted[0].StandardDeviation, unit * std::max(1.0, expected),
        0.1 * unit * deviation);
    }
  }
}

TEST(GaussianMixture, ConstantsDoNotCollapse)
{
  for (float value : { -1024.0F, -3.5F, 0.0F, 0.5F, 100.0F, 30000.0F })
  {
    const GaussianMixture mixture = FitGaussianMixture({ value, value, value }, MixtureSettings());
    ASSERT_EQ(mixture.Components.size(), 1u);
    const Gaussian& only = mixture.Components[0];
    EXPECT_NEAR(only.Mean, value, 1e-4 * (1 + std::abs(value)));
    EXPECT_EQ(only.Weight, 1);
    // Rounding does not leave it, a quarter more does.
    EXPECT_GT(only.StandardDeviation, 1e-4 * std::abs(value));
    EXPECT_TRUE(value == 0 || only.StandardDeviation < 0.05 * std::abs(value));
    EXPECT_TRUE(std::isfinite(mixture.Mode()) && mixture.Mode() > 0);
  }
  EXPECT_EQ(FitGaussianMixture({ 7.0F }, MixtureSettings()).Components.size(), 1u);
}

TEST(GaussianMixture, TinyComponentsArePruned)
{
  const std::vector<float> values = Sample({ { 0.9, 100, 8 }, { 0.1, 170, 6 } }, 40000, 4);
  MixtureSettings settings = Plain();
  EXPECT_EQ(FitGaussianMixture(values, settings).Components.size(), 2u);
  settings.MinimumWeight = 0.15;
  const std::vector<Gaussian> pruned = Fitted(values, settings);
  ASSERT_EQ(pruned.size(), 1u);
  EXPECT_EQ(pruned[0].Weight, 1);
  EXPECT_NEAR(pruned[0].Mean, 100, 1);
  EXPECT_NEAR(pruned[0].StandardDeviation, 8, 0.8);
  // The heaviest stays however high the bar.
  settings.MinimumWeight = 2;
  EXPECT_EQ(FitGaussianMixture(values, settings).Components.size(), 1u);
}

TEST(GaussianMixture, OutliersDoNotStretchTheBins)
{
  std::vector<float> values = Sample({ { 0.5, 60, 8 }, { 0.5, 120, 10 } }, 20000, 5);
  values.insert(values.end(), 100, 3000.0F);
  const std::vector<Gaussian> fitted = Fitted(values, MixtureSettings());
  ASSERT_EQ(fitted.size(), 2u);
  EXPECT_NEAR(fitted[0].Mean, 60, 2);
  EXPECT_NEAR(fitted[1].Mean, 120, 2);
}

TEST(GaussianMixture, DensityIntegratesToOneAndTheModeIsItsGreatest)
{
  GaussianMixture mixture;
  // A narrow one between two wide ones.
  mixture.Components = { { 0.4, 0, 50 }, { 0.2, 501.3, 0.3 }, { 0.4, 1000, 50 } };
  for (const auto& components : { Examples[0], Examples[1], Examples[2], mixture.Components })
  {
    mixture.Components = components;
    double sum = 0;
    double greatest = 0;
    const double step = 0.02;
    for (double z = -600; z < 1600; z += step)
    {
      const double density = mixture.Density(z);
      sum += step * density;
      greatest = std::max(greatest, density);
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_NEAR(mixture.Mode(), greatest, 1e-3 * greatest);
  }
}

TEST(GaussianMixture, ThresholdHoldsTheMass)
{
  GaussianMixture mixture;
  mixture.Components = { { 1, 50, 7 } };
  // One Gaussian: 95 % lie within 1.96 deviations.
  EXPECT_NEAR(mixture.ThresholdForMass(0.95), std::exp(-0.5 * 1.959964 * 1.959964), 2e-3);
  for (const auto& components : { Examples[0], Examples[1], Examples[2] })
  {
    mixture.Components = components;
    double before = 1.0;
    for (double mass : { 0.1, 0.5, 0.9, 0.99 })
    {
      const double threshold = mixture.ThresholdForMass(mass);
      EXPECT_LT(threshold, before);
      before = threshold;
      const double level = threshold * mixture.Mode();
      double held = 0;
      const double step = 0.01;
      for (double z = -200; z < 300; z += step)
      {
        const double density = mixture.Density(z);
        held += density >= level ? step * density : 0;
      }
      EXPECT_NEAR(held, mass, 3e-3);
    }
  }
}

TEST(GaussianMixture, NoValuesAreRefused)
{
  const std::string error = ErrorOf([] { FitGaussianMixture({}, MixtureSettings()); });
  EXPECT_NE(error.find("raise SeedRadius"), std::string::npos) << error;
}
