#include "Evidence/UnaryTerms.h"

#include "Intensity/RobustStatistics.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

// Organs in which larger balls fit are wide everywhere (livers).
constexpr double LargeBall = 20;

} // namespace

std::vector<float> FindUnaryTerms(BlockSums sums, const std::vector<unsigned char>& inside,
  const ImageGeometry& blocks, const SeedSphere& ball, double deviation, bool isMR,
  const ParallelFor& parallelFor)
{
  const double radius = ball.Radius;
  const double smoothing = std::max(2.0, std::min(6.0, 0.3 * radius));
  constexpr float leastWeight = 1e-6F;
  std::vector<float> values =
    LocalMeans(std::move(sums), blocks, smoothing, leastWeight, 0, parallelFor);
  std::vector<float> central;
  for (const std::size_t block : VoxelsAround(blocks, ball))
  {
    central.push_back(values[block]);
  }
  const RobustStatistics of = RobustStatisticsOf(central);
  const double least = isMR ? 0.02 * std::abs(of.Median) : 3;
  const double spread = std::max({ of.StandardDeviation, 0.5 * deviation, least, LeastDeviation });
  const double drift = isMR ? 0.15 * std::abs(of.Median) : 12;
  const double driftUp = radius >= LargeBall ? (isMR ? 0.03 * std::abs(of.Median) : 2.4) : drift;
  const double base = radius >= LargeBall ? 0.2 : 0.3;
  const double gain = radius >= LargeBall ? 0.5 : 0.3;
  const auto termOf = [&](double value, const Eigen::Vector3d& place)
  {
    const double away = (place - ball.Center).norm();
    const double difference = value - of.Median;
    const double allowed = (difference > 0 ? driftUp : drift) * std::max(0.0, away - radius) / 50;
    const double square = difference * difference / (spread * spread + allowed * allowed);
    const double fit = std::max(-2.0, std::min(2.0, (3.5 * 3.5 - square) / 2)) / 2;
    return static_cast<float>(base + gain * fit);
  };
  parallelFor(0, blocks.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < blocks.Dimensions[1]; ++j)
        {
          for (int i = 0; i < blocks.Dimensions[0]; ++i)
          {
            const std::size_t block = blocks.Offset(i, j, k);
            values[block] = inside[block]
              ? termOf(values[block], blocks.ToPhysical(Eigen::Vector3d(i, j, k)))
              : 0.0F;
          }
        }
      }
    });
  return values;
}

} // namespace FlipFree
