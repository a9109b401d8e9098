#include "Image/LocalMeans.h"

#include "Image/GaussianSmoothing.h"
#include "Image/NoData.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{

float BlockSums::Mean() const
{
  double whole = 0;
  double count = 0;
  for (std::size_t block = 0; block < this->Values.size(); ++block)
  {
    whole += this->Values[block];
    count += this->Weights[block];
  }
  return static_cast<float>(count > 0 ? whole / count : 0);
}

BlockSums SumInBlocks(const ImagePart& image, const BitMask& mask, const BlockGrid& grid,
  const ParallelFor& parallelFor)
{
  return SumInBlocks(mask, grid, parallelFor,
    [&image](std::size_t, int begin, int end, int j, int k, float& sum)
    {
      const float* const row = image.Row(j, k);
      int count = 0;
      for (int i = begin; i < end; ++i)
      {
        if (HasData(row[i]))
        {
          sum += row[i];
          ++count;
        }
      }
      return count;
    });
}

std::vector<float> LocalMeans(BlockSums sums, const ImageGeometry& blocks, double deviation,
  float leastWeight, float elsewhere, const ParallelFor& parallelFor)
{
  SmoothGaussian(sums.Values, blocks, deviation, parallelFor);
  SmoothGaussian(sums.Weights, blocks, deviation, parallelFor);
  std::transform(sums.Values.begin(), sums.Values.end(), sums.Weights.begin(), sums.Values.begin(),
    [=](float value, float weight) { return weight > leastWeight ? value / weight : elsewhere; });
  return std::move(sums.Values);
}

std::vector<float> DifferencesFrom(const std::vector<float>& means, const BlockGrid& grid,
  const ImagePart& image, const BitMask& mask)
{
  std::vector<float> differences;
  BlockRow interpolate(grid);
  std::array<float, BitMask::BitsOfWord> mean{};
  mask.ForEachRun(0, mask.GetGeometry().Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      const float* const row = image.Row(j, k);
      interpolate.Read(means, begin, end, j, k, mean.data());
      for (int i = begin; i < end; ++i)
      {
        if (HasData(row[i]))
        {
          differences.push_back(row[i] - mean[i - begin]);
        }
      }
    });
  return differences;
}

} // namespace FlipFree
