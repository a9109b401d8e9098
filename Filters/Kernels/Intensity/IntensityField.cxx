#include "Intensity/IntensityField.h"

#include "Intensity/RobustStatistics.h"
#include "Quantile.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Millimeters in which the polynomial's variables are measured.
constexpr double Unit = 50;
// Prior standard deviations of the coefficients, as parts of the gray value at the seed.
constexpr double ConstantPrior = 0.3;
constexpr double LinearPrior = 0.35;
constexpr double QuadraticPrior = 0.25;
// So that the field is the same whichever way the axes point: a quadratic form has each mixed
// coefficient twice.
constexpr double MixedPrior = QuadraticPrior * 1.4142135623730951;
constexpr std::size_t MostFieldSamples = 20000;
constexpr std::size_t FewestSamples = 200;
constexpr int FieldRounds = 6;
// Neighboring voxels are alike: a milliliter counts as one observation.
constexpr double CubicMillimetersPerObservation = 1000;
// Of the gray value at the seed.
constexpr double LeastFieldDeviation = 1e-3;

constexpr double LeastFactor = 0.4;
constexpr double GreatestFactor = 2.5;
constexpr double GreatestShift = 60;

double MedianMagnitude(const Eigen::VectorXd& values)
{
  std::vector<double> magnitudes;
  for (const double value : values)
  {
    magnitudes.push_back(std::abs(value));
  }
  return TakeMedian(magnitudes);
}

} // namespace

IntensityField::Coefficients IntensityField::BasisAt(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d p = (point - this->Center) / Unit;
  Coefficients basis;
  basis << 1, p.x(), p.y(), p.z(), p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(),
    p.x() * p.z(), p.y() * p.z();
  return basis;
}

double IntensityField::At(const Eigen::Vector3d& point) const
{
  return this->AtSeed + this->BasisAt(point).dot(this->Drift);
}

std::optional<IntensityField> IntensityField::Fit(const ImageView<float>& image,
  const BitMask& core, const SeedSphere& seed, Modality modality)
{
  const ImageGeometry& geometry = image.Geometry;
  const std::size_t count = core.Count();
  const std::size_t step = std::max<std::size_t>(1, count / MostFieldSamples);
  std::vector<Eigen::Vector3d> points;
  std::vector<float> values;
  std::vector<float> ofSeed;
  std::size_t place = 0;
  core.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      for (int i = begin; i < end; ++i)
      {
        const float value = image(i, j, k);
        const Eigen::Vector3d point = geometry.ToPhysical(Eigen::Vector3d(i, j, k));
        if ((point - seed.Center).norm() <= seed.Radius)
        {
          ofSeed.push_back(value);
        }
        if (place++ % step == 0 && std::isfinite(value))
        {
          points.push_back(point);
          values.push_back(value);
        }
      }
    });
  if (points.size() < FewestSamples || ofSeed.empty())
  {
    return std::nullopt;
  }
  IntensityField field;
  field.Center = seed.Center;
  field.AtSeed = RobustStatisticsOf(ofSeed).Median;
  field.Multiplies = modality == Modality::MR;
  field.Solve(points, values,
    static_cast<double>(count) * geometry.VoxelVolume() / CubicMillimetersPerObservation);
  return field;
}

// By weighted least squares, with weights that forget outliers.
void IntensityField::Solve(const std::vector<Eigen::Vector3d>& points,
  const std::vector<float>& values, double independent)
{
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix<double, Eigen::Dynamic, 10> basis(count, 10);
  Eigen::VectorXd drift(count);
  for (Eigen::Index sample = 0; sample < count; ++sample)
  {
    basis.row(sample) = this->BasisAt(points[sample]).transpose();
    drift[sample] = values[sample] - this->AtSeed;
  }
  const double scale = std::max(std::abs(this->AtSeed), LeastDeviation);
  Coefficients prior;
  prior << ConstantPrior, LinearPrior, LinearPrior, LinearPrior, QuadraticPrior, QuadraticPrior,
    QuadraticPrior, MixedPrior, MixedPrior, MixedPrior;
  const Coefficients precision = (scale * prior).array().square().inverse();
  std::vector<float> all = values;
  double deviation =
    std::max(RobustStatisticsOf(all).StandardDeviation, LeastFieldDeviation * scale);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(count);
  for (int round = 0; round < FieldRounds; ++round)
  {
    const Eigen::VectorXd weighted =
      weights * (independent / (static_cast<double>(count) * deviation * deviation));
    Eigen::Matrix<double, 10, 10> normal = basis.transpose() * weighted.asDiagonal() * basis;
    normal.diagonal() += precision;
    const Coefficients right = basis.transpose() * weighted.cwiseProduct(drift);
    this->Drift = normal.ldlt().solve(right);
    const Eigen::VectorXd rest = drift - basis * this->Drift;
    deviation = std::max(1.4826 * MedianMagnitude(rest), LeastFieldDeviation * scale);
    weights = (1 + (rest / (2 * deviation)).array().square()).square().inverse();
  }
}

float IntensityField::Flat(float value, double field) const
{
  if (!this->Multiplies)
  {
    const double shift = std::max(-GreatestShift, std::min(GreatestShift, field - this->AtSeed));
    return static_cast<float>(value - shift);
  }
  const bool sameSign = field * this->AtSeed > 0;
  const double factor = sameSign ? this->AtSeed / field : GreatestFactor;
  return static_cast<float>(value * std::max(LeastFactor, std::min(GreatestFactor, factor)));
}

void IntensityField::Flatten(const ImageGeometry& geometry, const ParallelFor& parallelFor,
  float* voxels) const
{
  const auto& size = geometry.Dimensions;
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (auto k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          // Along a row the field is a parabola, which three of its values determine.
          const int half = std::max(1, size[0] / 2);
          const double low = this->At(geometry.ToPhysical(Eigen::Vector3d(0, j, k)));
          const double middle = this->At(geometry.ToPhysical(Eigen::Vector3d(half, j, k)));
          const double high = this->At(geometry.ToPhysical(Eigen::Vector3d(2 * half, j, k)));
          float* const row = voxels + geometry.Offset(0, j, k);
          for (int i = 0; i < size[0]; ++i)
          {
            const double t = static_cast<double>(i - half) / half;
            const double field =
              middle + 0.5 * t * (high - low) + 0.5 * t * t * (low - 2 * middle + high);
            row[i] = this->Flat(row[i], field);
          }
        }
      }
    });
}

} // namespace FlipFree
