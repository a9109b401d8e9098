#include "ExampleSurfaces.h"
#include "Image/AnisotropicDiffusion.h"
#include "Image/DiffusionRows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <thread>

using namespace FlipFree;

namespace
{

using Equation = DiffusionEquation;

constexpr std::array<Equation, 3> Equations{ { Equation::Faces, Equation::Gradient,
  Equation::Curvature } };

ImageGeometry Grid(std::array<int, 3> dimensions, const Eigen::Vector3d& spacing)
{
  ImageGeometry geometry;
  geometry.Dimensions = dimensions;
  geometry.Spacing = spacing;
  return geometry;
}

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

std::vector<float> Diffused(const std::vector<float>& voxels, const ImageGeometry& geometry,
  int iterations, double contrast, const ParallelFor& parallelFor = SerialFor)
{
  return Diffused(voxels, geometry, { iterations, contrast }, parallelFor);
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

// The equations once more: voxel by voxel, over the whole image, step after step, in double.
class PlainDiffusion
{
public:
  PlainDiffusion(const std::vector<float>& voxels, const ImageGeometry& geometry,
    const AnisotropicDiffusionSettings& settings)
    : Geometry(geometry)
    , Settings(settings)
    , Now(voxels.begin(), voxels.end())
  {
  }

  std::vector<float> Run()
  {
    for (int iteration = 0; iteration < this->Settings.Iterations; ++iteration)
    {
      std::vector<double> next = this->Now;
      std::size_t voxel = 0;
      for (int k = 0; k < this->Geometry.Dimensions[2]; ++k)
      {
        for (int j = 0; j < this->Geometry.Dimensions[1]; ++j)
        {
          for (int i = 0; i < this->Geometry.Dimensions[0]; ++i)
          {
            next[voxel++] += this->Change({ i, j, k });
          }
        }
      }
      this->Now = next;
    }
    return { this->Now.begin(), this->Now.end() };
  }

private:
  using Index = Eigen::Vector3i;

  double At(const Index& index) const
  {
    std::array<int, 3> inside;
    for (int axis = 0; axis < 3; ++axis)
    {
      inside[axis] = std::clamp(index[axis], 0, this->Geometry.Dimensions[axis] - 1);
    }
    return this->Now[this->Geometry.Offset(inside[0], inside[1], inside[2])];
  }

  // Through the face towards the next voxel on the axis.
  double Flux(const Index& index, int axis) const
  {
    const Index next = index + Index::Unit(axis);
    const double difference = this->At(next) - this->At(index);
    const double contrast = this->Settings.Contrast * this->Settings.Contrast;
    if (this->Settings.Equation == Equation::Faces)
    {
      return difference / (1 + difference * difference / contrast);
    }
    Eigen::Vector3d gradient;
    for (int other = 0; other < 3; ++other)
    {
      const Index step = Index::Unit(other);
      const double slope = other == axis ? difference
                                         : 0.25 *
          (this->At(index + step) - this->At(index - step) + this->At(next + step) -
            this->At(next - step));
      gradient[other] = slope / this->Geometry.Spacing[other];
    }
    const double square = gradient.squaredNorm();
    const double flux = gradient[axis] * std::exp(-0.5 * square / contrast);
    return this->Settings.Equation == Equation::Gradient ? flux : flux / std::sqrt(1e-10 + square);
  }

  double Change(const Index& index) const
  {
    const Eigen::Vector3d& spacing = this->Geometry.Spacing;
    Eigen::Vector3d divergence;
    for (int axis = 0; axis < 3; ++axis)
    {
      divergence[axis] = this->Flux(index, axis) - this->Flux(index - Index::Unit(axis), axis);
    }
    if (this->Settings.Equation == Equation::Faces)
    {
      const Eigen::Vector3d rates = spacing.array().square().inverse();
      return divergence.dot(rates) / (2 * rates.sum());
    }
    const double step =
      this->Settings.TimeStep > 0 ? this->Settings.TimeStep : spacing.minCoeff() / 16;
    const double speed = divergence.sum();
    if (this->Settings.Equation == Equation::Gradient)
    {
      return step * speed;
    }
    double square = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Index unit = Index::Unit(axis);
      const double forward = (this->At(index + unit) - this->At(index)) / spacing[axis];
      const double backward = (this->At(index) - this->At(index - unit)) / spacing[axis];
      square += speed > 0
        ? std::pow(std::min(backward, 0.0), 2) + std::pow(std::max(forward, 0.0), 2)
        : std::pow(std::max(backward, 0.0), 2) + std::pow(std::min(forward, 0.0), 2);
    }
    return step * std::sqrt(square) * speed;
  }

  ImageGeometry Geometry;
  AnisotropicDiffusionSettings Settings;
  std::vector<double> Now;
};

const std::vector<ImageGeometry> ExampleGrids{ Grid({ { 24, 18, 11 } }, { 1, 1, 1 }),
  Grid({ { 24, 18, 11 } }, { 0.7, 0.7, 5 }), Grid({ { 24, 18, 11 } }, { 4, 0.1, 1 }),
  Grid({ { 24, 1, 11 } }, { 1, 1, 1 }), Grid({ { 1, 1, 1 } }, { 1, 2, 3 }),
  Grid({ { 2, 70, 67 } }, { 1, 1, 2 }), Grid({ { 650, 3, 2 } }, { 0.8, 0.9, 2.5 }) };

} // namespace

TEST(AnisotropicDiffusion, IsThePlainOne)
{
  double difference = 0; // that the length of the steps makes
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    const std::vector<float> voxels = NoisyStep(geometry, 15);
    for (const Equation equation : Equations)
    {
      for (const int iterations : { 0, 1, 2, 5, 23 })
      {
        for (const double contrast : { 4.0, 30.0 })
        {
          AnisotropicDiffusionSettings settings{ iterations, contrast, equation, 0 };
          if (equation == Equation::Curvature && iterations > 5)
          {
            continue; // where it has flattened the image, the input's last bit decides
          }
          const std::vector<float> plain = PlainDiffusion(voxels, geometry, settings).Run();
          ASSERT_LT(MaximumDifference(Diffused(voxels, geometry, settings), plain), 5e-4)
            << "equation " << static_cast<int>(equation) << ", " << iterations << " iterations";
          settings.TimeStep = 0.3 * geometry.Spacing.minCoeff() / 16;
          if (equation != Equation::Faces && iterations > 0 && voxels.size() > 1)
          {
            const std::vector<float> slow = PlainDiffusion(voxels, geometry, settings).Run();
            ASSERT_LT(MaximumDifference(Diffused(voxels, geometry, settings), slow), 5e-4);
            difference = std::max(difference, MaximumDifference(slow, plain));
          }
        }
      }
    }
  }
  EXPECT_GT(difference, 1);
}

TEST(AnisotropicDiffusion, LeavesAConstantImage)
{
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    const std::vector<float> constant(geometry.NumberOfVoxels(), -1024.25F);
    for (const Equation equation : Equations)
    {
      EXPECT_EQ(Diffused(constant, geometry, { 10, 20, equation, 0 }), constant);
    }
  }
}

TEST(AnisotropicDiffusion, KeepsTheMeanAndTheRange)
{
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    for (const Equation equation : { Equation::Faces, Equation::Gradient })
    {
      for (double contrast : { 1.0, 20.0, 1e4 })
      {
        const std::vector<float> voxels = NoisyStep(geometry, 15);
        const std::vector<float> smooth = Diffused(voxels, geometry, { 50, contrast, equation, 0 });
        EXPECT_NEAR(Mean(smooth), Mean(voxels), 1e-3);
        const auto before = std::minmax_element(voxels.begin(), voxels.end());
        const auto after = std::minmax_element(smooth.begin(), smooth.end());
        EXPECT_GE(*after.first, *before.first - 1e-3F);
        EXPECT_LE(*after.second, *before.second + 1e-3F);
      }
    }
  }
}

// The noise goes from the two halves, the step between them stays.
TEST(AnisotropicDiffusion, SmoothsNoiseAndKeepsEdges)
{
  const ImageGeometry geometry = Grid({ { 24, 18, 11 } }, { 1, 1, 1 });
  for (const Equation equation : Equations)
  {
    const int iterations = equation == Equation::Faces ? 10 : 40;
    const std::vector<float> smooth =
      Diffused(NoisyStep(geometry, 5), geometry, { iterations, 15, equation, 0 });
    std::vector<float> left;
    std::vector<float> right;
    for (std::size_t voxel = 0; voxel < smooth.size(); ++voxel)
    {
      (voxel % 24 < 12 ? left : right).push_back(smooth[voxel]);
    }
    EXPECT_LT(StandardDeviation(left), 2.5);
    EXPECT_LT(StandardDeviation(right), 2.5);
    EXPECT_GT(Mean(right) - Mean(left), 95);
  }

  // With a contrast above the step it goes, too.
  const std::vector<float> flat = Diffused(NoisyStep(geometry, 5), geometry, 2000, 1e4);
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
    const std::vector<float> smooth = Diffused(wave, geometry, iterations, 1e6);
    for (std::size_t voxel = 0; voxel < wave.size(); ++voxel)
    {
      ASSERT_NEAR(smooth[voxel], std::pow(factor, iterations) * cosine(voxel), 1e-4);
    }
  }
}

TEST(AnisotropicDiffusion, AnyNumberOfThreadsGivesTheSameBits)
{
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    const std::vector<float> voxels = NoisyStep(geometry, 15);
    for (const Equation equation : Equations)
    {
      const AnisotropicDiffusionSettings settings{ 7, 20, equation, 0 };
      EXPECT_EQ(Diffused(voxels, geometry, settings, ScatteredFor),
        Diffused(voxels, geometry, settings));
    }
  }
}

// Whatever part is asked for, at the image's rim or within it, and nothing else.
TEST(AnisotropicDiffusion, APartHasTheBitsOfTheWhole)
{
  const ImageGeometry geometry = Grid({ { 37, 41, 29 } }, { 0.8, 0.9, 2.5 });
  const std::vector<float> voxels = NoisyStep(geometry, 15);
  std::mt19937 random(3);
  for (const Equation equation : Equations)
  {
    for (const int iterations : { 0, 1, 4, 10 })
    {
      const AnisotropicDiffusionSettings settings{ iterations, 20, equation, 0 };
      const std::vector<float> whole = Diffused(voxels, geometry, settings);
      for (int repetition = 0; repetition < 12; ++repetition)
      {
        VoxelBox box;
        for (int axis = 0; axis < 3; ++axis)
        {
          const int size = geometry.Dimensions[axis];
          std::uniform_int_distribution<int> place(0, size - 1);
          const int a = place(random);
          const int b = repetition == 0 ? a : place(random); // a single voxel, too
          box.Begin[axis] = std::min(a, b);
          box.End[axis] = std::max(a, b) + 1;
        }
        std::vector<float> out(whole.size(), -1);
        ASSERT_TRUE(DiffuseBox(ReaderOf(voxels, geometry), geometry, settings, box, ScatteredFor,
          NeverStop, out.data()));
        for (int k = 0; k < geometry.Dimensions[2]; ++k)
        {
          for (int j = 0; j < geometry.Dimensions[1]; ++j)
          {
            for (int i = 0; i < geometry.Dimensions[0]; ++i)
            {
              const bool inside = i >= box.Begin[0] && i < box.End[0] && j >= box.Begin[1] &&
                j < box.End[1] && k >= box.Begin[2] && k < box.End[2];
              const std::size_t voxel = geometry.Offset(i, j, k);
              ASSERT_EQ(out[voxel], inside ? whole[voxel] : -1) << i << " " << j << " " << k;
            }
          }
        }
      }
    }
  }
}

// The rows' arithmetic is the same on a machine without wide vectors, and at any place in a row.
TEST(AnisotropicDiffusion, AnyVectorsGiveTheSameBits)
{
  constexpr int size = 203;
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0, 30);
  std::vector<std::vector<float>> rows(10, std::vector<float>(size));
  for (std::vector<float>& row : rows)
  {
    std::generate(row.begin(), row.end(), [&] { return normal(random); });
  }
  std::fill_n(rows[1].begin(), 20, 1e30F); // gradients whose squares are infinite
  const DiffusionCoefficients coefficients{ { { 1.2F, 1.1F, 0.3F } }, { { 0.1F, 0.2F, 0.05F } },
    1e-3F, 0.05F };
  const auto results = [&](Equation equation, bool plain, int begin)
  {
    const DiffusionRows kernels = ChooseDiffusionRows(equation, plain);
    const auto at = [&](int row) { return rows[row].data() + begin; };
    std::vector<float> flux(size - begin);
    kernels.Flux({ 1, { { 0, 2 } }, { at(0), { { at(2), at(3) } }, { { at(4), at(5) } } },
                   { at(1), { { at(6), at(7) } }, { { at(8), at(9) } } } },
      coefficients, size - begin, flux.data());
    std::vector<float> stepped(size - begin);
    kernels.Step({ at(0), { { at(2), at(3), at(4) } }, { { at(5), at(6), at(7) } },
                   { { at(8), at(9), at(2) } }, { { at(3), at(4), at(5) } } },
      coefficients, size - begin, stepped.data());
    flux.insert(flux.end(), stepped.begin(), stepped.end());
    return flux;
  };
  for (const Equation equation : Equations)
  {
    const std::vector<float> wide = results(equation, false, 0);
    EXPECT_EQ(wide, results(equation, true, 0));
    for (int begin : { 1, 5, 190 })
    {
      const std::vector<float> part = results(equation, false, begin);
      for (int i = begin; i < size; ++i)
      {
        ASSERT_EQ(part[i - begin], wide[i]);
        ASSERT_EQ(part[size - begin + i - begin], wide[size + i]);
      }
    }
  }
}

TEST(AnisotropicDiffusion, WithoutContrastEverythingIsAnEdge)
{
  const ImageGeometry geometry = Grid({ { 24, 18, 11 } }, { 1, 1, 1 });
  for (const Equation equation : Equations)
  {
    for (double contrast : { 0.0, 1e-30 })
    {
      const std::vector<float> voxels = NoisyStep(geometry, 5);
      EXPECT_EQ(Diffused(voxels, geometry, { 3, contrast, equation, 0 }), voxels);
      const std::vector<float> noiseless = NoisyStep(geometry, 0);
      EXPECT_EQ(Diffused(noiseless, geometry, { 3, contrast, equation, 0 }), noiseless);
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
    return DiffuseAnisotropically(ReaderOf(voxels, geometry), geometry, { 1, 15 }, SerialFor,
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

// However long a part of the image takes: after every one that a single thread has done, and never
// after fewer than there are threads, which take as long as one.
TEST(AnisotropicDiffusion, AsksAfterAsManySlowPartsAsThereAreThreads)
{
  const ImageGeometry geometry = Grid({ { 24, 320, 8 } }, { 1, 1, 1 }); // ten parts
  const std::vector<float> voxels = NoisyStep(geometry, 5);
  const VoxelReader read = ReaderOf(voxels, geometry);
  const VoxelReader slow = [&read](int begin, int end, int j, int k, float* to)
  {
    if (j % 32 == 16 && k == 0)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
    }
    read(begin, end, j, k, to);
  };
  AnisotropicDiffusionSettings settings{ 1, 15 };
  const std::vector<float> expected = Diffused(voxels, geometry, settings);
  const std::vector<std::pair<int, std::vector<std::ptrdiff_t>>> cases{
    { 1, std::vector<std::ptrdiff_t>(10, 1) }, { 3, { 3, 3, 3, 1 } }, { 4, { 4, 4, 2 } },
    { 16, { 10 } }
  };
  for (const auto& [threads, waves] : cases)
  {
    settings.Threads = threads;
    std::vector<std::ptrdiff_t> atOnce;
    const auto record = [&atOnce](std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
    {
      atOnce.push_back(end - begin);
      SerialFor(begin, end, body);
    };
    std::size_t questions = 0;
    const auto count = [&questions](double) { return ++questions > 0; };
    std::vector<float> out(voxels.size());
    EXPECT_TRUE(DiffuseBox(slow, geometry, settings, { { { 0, 0, 0 } }, geometry.Dimensions },
      record, count, out.data()));
    EXPECT_EQ(atOnce, waves) << threads << " threads";
    EXPECT_EQ(questions, waves.size());
    EXPECT_EQ(out, expected);
  }
}

// Unless it is told, as many threads as the machine has.
TEST(AnisotropicDiffusion, GivesEveryThreadAPart)
{
  const ImageGeometry geometry = Grid({ { 2, 32 * 300, 1 } }, { 1, 1, 1 });
  const std::vector<float> voxels = NoisyStep(geometry, 5);
  std::vector<std::ptrdiff_t> atOnce;
  Diffused(voxels, geometry, { 1, 15 },
    [&atOnce](std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
    {
      atOnce.push_back(end - begin);
      SerialFor(begin, end, body);
    });
  ASSERT_GT(atOnce.size(), 0U);
  atOnce.pop_back(); // the rest
  for (const std::ptrdiff_t parts : atOnce)
  {
    EXPECT_GE(parts, std::max(1U, std::thread::hardware_concurrency()));
  }
}

TEST(AnisotropicDiffusion, ContrastLiesAboveTheNoise)
{
  const ImageGeometry geometry = Grid({ { 4, 4, 4 } }, { 0.8, 0.9, 2.5 });
  EXPECT_NEAR(ContrastOfNoise(10, geometry, Equation::Faces), 2 * std::sqrt(2.0) * 10, 1e-9);
  for (const Equation equation : Equations)
  {
    EXPECT_GT(ContrastOfNoise(0, geometry, equation), 0);
    EXPECT_NEAR(ContrastOfNoise(20, geometry, equation),
      2 * ContrastOfNoise(10, geometry, equation), 1e-9);
  }
}

// Twice that of white noise, as it is measured over the image.
TEST(AnisotropicDiffusion, ContrastOfGradientsIsThatOfTheNoise)
{
  const ImageGeometry geometry = Grid({ { 40, 40, 40 } }, { 0.8, 0.9, 2.5 });
  const std::vector<float> voxels = NoisyStep(geometry, 10);
  const ImageView<float> image{ voxels.data(), geometry };
  double sum = 0;
  int count = 0;
  for (int k = 1; k < 39; ++k)
  {
    for (int j = 1; j < 39; ++j)
    {
      for (int i = 1; i < 18; ++i)
      {
        const Eigen::Vector3d twice(image(i + 1, j, k) - image(i - 1, j, k),
          image(i, j + 1, k) - image(i, j - 1, k), image(i, j, k + 1) - image(i, j, k - 1));
        sum += 0.25 * twice.cwiseQuotient(geometry.Spacing).squaredNorm();
        ++count;
      }
    }
  }
  const double measured = 2 * std::sqrt(sum / count);
  EXPECT_NEAR(ContrastOfNoise(10, geometry, Equation::Gradient), measured, 0.02 * measured);
  EXPECT_NEAR(ContrastOfNoise(10, geometry, Equation::Curvature), measured, 0.02 * measured);
}
