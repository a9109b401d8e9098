#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/AnisotropicDiffusion.h"
#include "Image/DiffusionRows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace FlipFree;

namespace
{

// A step of 100 in the middle of x, with noise.
std::vector<float> NoisyStep(const ImageGeometry& geometry, double noise)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  std::vector<float> voxels(geometry.NumberOfVoxels());
  for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
  {
    const int i = static_cast<int>(voxel % geometry.Dimensions[0]);
    const double level = 2 * i < geometry.Dimensions[0] ? 0 : 100;
    voxels[voxel] = static_cast<float>(level + noise * normal(random));
  }
  return voxels;
}

VoxelReader ReaderOf(const std::vector<float>& voxels, const ImageGeometry& geometry)
{
  return FlipFree::ReaderOf(ImageView<float>{ voxels.data(), geometry });
}

std::vector<float> Diffused(const std::vector<float>& voxels, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const ParallelFor& parallelFor = SerialFor)
{
  std::vector<float> out(voxels.size(), std::nanf(""));
  EXPECT_TRUE(DiffuseAnisotropically(ReaderOf(voxels, geometry), geometry, settings, parallelFor,
    NeverStop, out.data()));
  return out;
}

double Mean(const std::vector<float>& voxels)
{
  return std::accumulate(voxels.begin(), voxels.end(), 0.0) / static_cast<double>(voxels.size());
}

double StandardDeviation(const std::vector<float>& voxels)
{
  const double mean = Mean(voxels);
  double sum = 0;
  for (float voxel : voxels)
  {
    sum += (voxel - mean) * (voxel - mean);
  }
  return std::sqrt(sum / static_cast<double>(voxels.size()));
}

double MaximumDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double greatest = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t voxel = 0; voxel < std::min(a.size(), b.size()); ++voxel)
  {
    const double difference = std::abs(static_cast<double>(a[voxel]) - b[voxel]);
    greatest = difference <= greatest ? greatest : difference; // and if it is not a number
  }
  return greatest;
}

// The equation once more: voxel by voxel, over the whole image, step after step, in double.
std::vector<float> PlainDiffusion(const std::vector<float>& voxels, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings)
{
  std::vector<double> now(voxels.begin(), voxels.end());
  const auto at = [&](const Eigen::Vector3i& index)
  {
    std::array<int, 3> inside;
    for (int axis = 0; axis < 3; ++axis)
    {
      inside[axis] = std::clamp(index[axis], 0, geometry.Dimensions[axis] - 1);
    }
    return now[geometry.Offset(inside[0], inside[1], inside[2])];
  };
  const auto flux = [&](double difference)
  { return difference / (1 + std::pow(difference / settings.Contrast, 2)); };
  const Eigen::Vector3d rates = geometry.Spacing.array().square().inverse();
  for (int iteration = 0; iteration < settings.Iterations; ++iteration)
  {
    std::vector<double> next;
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3i index(i, j, k);
        double change = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const Eigen::Vector3i unit = Eigen::Vector3i::Unit(axis);
          const double here = at(index);
          change += rates[axis] * (flux(at(index + unit) - here) - flux(here - at(index - unit)));
        }
        next.push_back(at(index) + change / (2 * rates.sum()));
      });
    now = next;
  }
  return { now.begin(), now.end() };
}

const std::vector<ImageGeometry> DiffusionGrids{ Grid({ { 24, 18, 11 } }, { 1, 1, 1 }),
  Grid({ { 24, 18, 11 } }, { 0.7, 0.7, 5 }), Grid({ { 24, 18, 11 } }, { 4, 0.1, 1 }),
  Grid({ { 24, 1, 11 } }, { 1, 1, 1 }), Grid({ { 1, 1, 1 } }, { 1, 2, 3 }),
  Grid({ { 2, 70, 67 } }, { 1, 1, 2 }), Grid({ { 650, 3, 2 } }, { 0.8, 0.9, 2.5 }) };

} // namespace

TEST(AnisotropicDiffusion, IsThePlainOne)
{
  for (const ImageGeometry& geometry : DiffusionGrids)
  {
    const std::vector<float> voxels = NoisyStep(geometry, 15);
    for (const int iterations : { 0, 1, 2, 5, 23 })
    {
      for (const double contrast : { 4.0, 30.0 })
      {
        const AnisotropicDiffusionSettings settings{ iterations, contrast };
        ASSERT_LT(MaximumDifference(Diffused(voxels, geometry, settings),
                    PlainDiffusion(voxels, geometry, settings)),
          5e-4)
          << iterations << " iterations";
      }
    }
  }
}

// The noise goes from the two halves, the step between them stays.
TEST(AnisotropicDiffusion, SmoothsNoiseAndKeepsEdges)
{
  const ImageGeometry geometry = Grid({ { 24, 18, 11 } }, { 1, 1, 1 });
  const std::vector<float> smooth = Diffused(NoisyStep(geometry, 5), geometry, { 10, 15 });
  std::vector<float> left;
  std::vector<float> right;
  for (std::size_t voxel = 0; voxel < smooth.size(); ++voxel)
  {
    (voxel % 24 < 12 ? left : right).push_back(smooth[voxel]);
  }
  EXPECT_LT(StandardDeviation(left), 2.5);
  EXPECT_LT(StandardDeviation(right), 2.5);
  EXPECT_GT(Mean(right) - Mean(left), 95);

  // With a contrast above the step it goes, too.
  const std::vector<float> flat = Diffused(NoisyStep(geometry, 5), geometry, { 2000, 1e4 });
  EXPECT_LT(StandardDeviation(flat), 2);
}

// Small differences diffuse linearly: along x alone, by the known factor of a cosine per step,
// which follows from spacing.
TEST(AnisotropicDiffusion, DiffusesByTheSpacing)
{
  for (const Eigen::Vector3d& spacing :
    { Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 1, 3), Eigen::Vector3d(2, 1, 0.5) })
  {
    const ImageGeometry geometry = Grid({ { 16, 4, 4 } }, spacing);
    std::vector<float> wave(geometry.NumberOfVoxels());
    const auto cosine = [](std::size_t voxel)
    { return std::cos(EIGEN_PI * (static_cast<double>(voxel % 16) + 0.5) / 16); };
    for (std::size_t voxel = 0; voxel < wave.size(); ++voxel)
    {
      wave[voxel] = static_cast<float>(cosine(voxel));
    }
    const int iterations = 40;
    const Eigen::Array3d rates = spacing.array().square().inverse();
    const double factor = 1 - (1 - std::cos(EIGEN_PI / 16)) * rates[0] / rates.sum();
    const std::vector<float> smooth = Diffused(wave, geometry, { iterations, 1e6 });
    for (std::size_t voxel = 0; voxel < wave.size(); ++voxel)
    {
      ASSERT_NEAR(smooth[voxel], std::pow(factor, iterations) * cosine(voxel), 1e-4);
    }
  }
}

TEST(AnisotropicDiffusion, AnyNumberOfThreadsGivesTheSameBits)
{
  for (const ImageGeometry& geometry : DiffusionGrids)
  {
    const std::vector<float> voxels = NoisyStep(geometry, 15);
    EXPECT_EQ(Diffused(voxels, geometry, { 7, 20 }, ScatteredFor),
      Diffused(voxels, geometry, { 7, 20 }));
  }
}

// At the image's rim or within it, and nothing else is written.
TEST(AnisotropicDiffusion, APartHasTheBitsOfTheWhole)
{
  const ImageGeometry geometry = Grid({ { 37, 41, 29 } }, { 0.8, 0.9, 2.5 });
  const std::vector<float> voxels = NoisyStep(geometry, 15);
  std::mt19937 random(3);
  for (const int iterations : { 0, 1, 4, 10 })
  {
    const AnisotropicDiffusionSettings settings{ iterations, 20 };
    const std::vector<float> whole = Diffused(voxels, geometry, settings);
    for (int repetition = 0; repetition < 12; ++repetition)
    {
      VoxelBox box = RandomBox(geometry, random);
      if (repetition == 0)
      {
        box = { box.Begin, { { box.Begin[0] + 1, box.Begin[1] + 1, box.Begin[2] + 1 } } };
      }
      std::vector<float> out(whole.size(), -1);
      ASSERT_TRUE(DiffuseBox(ReaderOf(voxels, geometry), geometry, settings, box, ScatteredFor,
        NeverStop, out.data()));
      ForEachVoxel(geometry,
        [&](int i, int j, int k)
        {
          const bool inside = box.Holds({ { { i, j, k } }, { { i + 1, j + 1, k + 1 } } });
          const std::size_t voxel = geometry.Offset(i, j, k);
          ASSERT_EQ(out[voxel], inside ? whole[voxel] : -1) << i << " " << j << " " << k;
        });
    }
  }
}

// The rows' arithmetic is the same on a machine without wide vectors, and at any place in a row.
TEST(AnisotropicDiffusion, AnyVectorsGiveTheSameBits)
{
  constexpr int size = 203;
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0, 30);
  std::array<std::vector<float>, 7> rows;
  for (std::vector<float>& row : rows)
  {
    std::generate_n(std::back_inserter(row), size, [&] { return normal(random); });
  }
  std::fill_n(rows[1].begin(), 20, 1e30F); // differences whose squares are infinite
  const DiffusionCoefficients coefficients{ { { 0.1F, 0.2F, 0.05F } }, 1e-3F };
  const auto results = [&](bool plain, int begin)
  {
    const DiffusionRows kernels = ChooseDiffusionRows(plain);
    const auto at = [&](int row) { return rows[row].data() + begin; };
    std::vector<float> flux(size - begin);
    kernels.Flux(at(0), at(1), coefficients, size - begin, flux.data());
    std::vector<float> stepped(size - begin);
    kernels.Step(at(0), { { at(1), at(2), at(3) } }, { { at(4), at(5), at(6) } }, coefficients,
      size - begin, stepped.data());
    flux.insert(flux.end(), stepped.begin(), stepped.end());
    return flux;
  };
  const std::vector<float> wide = results(false, 0);
  EXPECT_EQ(wide, results(true, 0));
  for (int begin : { 1, 5, 190 })
  {
    const std::vector<float> part = results(false, begin);
    for (int i = begin; i < size; ++i)
    {
      ASSERT_EQ(part[i - begin], wide[i]);
      ASSERT_EQ(part[size - begin + i - begin], wide[size + i]);
    }
  }
}

TEST(AnisotropicDiffusion, WithoutContrastEverythingIsAnEdge)
{
  const ImageGeometry geometry = Grid({ { 24, 18, 11 } }, { 1, 1, 1 });
  for (double contrast : { 0.0, 1e-30 })
  {
    for (const double noise : { 0.0, 5.0 })
    {
      const std::vector<float> voxels = NoisyStep(geometry, noise);
      EXPECT_EQ(Diffused(voxels, geometry, { 3, contrast }), voxels);
    }
  }
}

TEST(AnisotropicDiffusion, StopsWhenTold)
{
  const ImageGeometry geometry = Grid({ { 24, 700, 150 } }, { 1, 1, 1 });
  const std::vector<float> voxels = NoisyStep(geometry, 5);
  std::vector<float> out(voxels.size());
  std::vector<double> fractions;
  std::size_t questions = 2;
  const auto monitor = [&](double fraction)
  {
    fractions.push_back(fraction);
    return fractions.size() < questions;
  };
  const auto run = [&]
  {
    fractions.clear();
    return DiffuseAnisotropically(ReaderOf(voxels, geometry), geometry, { 1, 15, 1 }, SerialFor,
      monitor, out.data());
  };
  EXPECT_FALSE(run());
  EXPECT_EQ(fractions.size(), 2u);
  EXPECT_GT(fractions[1], 0);
  questions = 1;
  EXPECT_FALSE(run());
  questions = 100;
  EXPECT_TRUE(run());
  EXPECT_LT(fractions.size(), 100u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_LT(fractions.back(), 1);
}

// Between two questions, every thread gets some parts.
TEST(AnisotropicDiffusion, AsksAfterSomePartsPerThread)
{
  const ImageGeometry geometry = Grid({ { 2, 32 * 30, 1 } }, { 1, 1, 1 }); // 30 parts
  const std::vector<float> voxels = NoisyStep(geometry, 5);
  for (const auto& [threads, expected] : std::vector<std::pair<int, std::vector<std::ptrdiff_t>>>{
         { 1, { 4, 4, 4, 4, 4, 4, 4, 2 } }, { 3, { 12, 12, 6 } }, { 16, { 30 } } })
  {
    std::vector<std::ptrdiff_t> atOnce;
    Diffused(voxels, geometry, { 1, 15, threads },
      [&](std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
      {
        atOnce.push_back(end - begin);
        SerialFor(begin, end, body);
      });
    EXPECT_EQ(atOnce, expected) << threads << " threads";
  }
}

TEST(AnisotropicDiffusion, ContrastLiesAboveTheNoise)
{
  EXPECT_NEAR(ContrastOfNoise(10), 2 * std::sqrt(2.0) * 10, 1e-9);
  EXPECT_EQ(ContrastOfNoise(0), 0);
  EXPECT_EQ(ContrastOfNoise(1e-9), 1e-9 * ContrastOfNoise(1));
}
