#include "Image/GaussianSmoothing.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

constexpr double Truncation = 3;

// The weights at offsets 0, 1, ... voxels.
std::vector<float> HalfKernel(double deviation, double spacing)
{
  const auto reach = static_cast<int>(std::lround(Truncation * deviation / spacing));
  std::vector<float> weights(reach + 1);
  double sum = 0;
  for (int offset = 0; offset <= reach; ++offset)
  {
    const double x = offset * spacing / deviation;
    weights[offset] = static_cast<float>(std::exp(-0.5 * x * x));
    sum += (offset > 0 ? 2 : 1) * static_cast<double>(weights[offset]);
  }
  for (float& weight : weights)
  {
    weight = static_cast<float>(weight / sum);
  }
  return weights;
}

// Some neighboring lines, whose sums stay in registers.
using Bundle = Eigen::Array<float, 16, 1>;

// Convolves `lines` neighboring lines of `size` voxels that are `stride` apart.
void ConvolveLines(float* first, int size, std::ptrdiff_t stride, int lines,
  const std::vector<float>& weights, std::vector<float>& copy)
{
  constexpr int width = Bundle::SizeAtCompileTime;
  const int reach = static_cast<int>(weights.size()) - 1;
  const std::ptrdiff_t row = (lines + width - 1) / width * width;
  copy.assign(size * row, 0.0F);
  for (int place = 0; place < size; ++place)
  {
    std::copy_n(first + place * stride, lines, copy.data() + place * row);
  }
  for (int place = 0; place < size; ++place)
  {
    float* const to = first + place * stride;
    const int begin = std::max(0, place - reach);
    const int end = std::min(size, place + reach + 1);
    const auto sumAt = [&](int line) -> Bundle
    {
      Bundle sum = Bundle::Zero();
      for (int from = begin; from < end; ++from)
      {
        sum += weights[std::abs(from - place)] *
          Eigen::Map<const Bundle>(copy.data() + from * row + line);
      }
      return sum;
    };
    int line = 0;
    for (; line + width <= lines; line += width)
    {
      Eigen::Map<Bundle>(to + line) = sumAt(line);
    }
    if (line < lines)
    {
      const Bundle sum = sumAt(line);
      std::copy_n(sum.data(), lines - line, to + line);
    }
  }
}

void ConvolveRow(float* row, int size, const std::vector<float>& weights,
  std::vector<float>& padded)
{
  const int reach = static_cast<int>(weights.size()) - 1;
  padded.assign(size + 2 * static_cast<std::size_t>(reach), 0.0F);
  std::copy_n(row, size, padded.data() + reach);
  const float* const center = padded.data() + reach;
  for (int i = 0; i < size; ++i)
  {
    row[i] = weights[0] * center[i];
  }
  for (int offset = 1; offset <= reach; ++offset)
  {
    const float weight = weights[offset];
    for (int i = 0; i < size; ++i)
    {
      row[i] += weight * (center[i - offset] + center[i + offset]);
    }
  }
}

} // namespace

void SmoothGaussian(std::vector<float>& voxels, const ImageGeometry& geometry, double deviation,
  const ParallelFor& parallelFor)
{
  const auto& size = geometry.Dimensions;
  const std::ptrdiff_t row = size[0];
  const std::ptrdiff_t slice = row * size[1];
  std::array<std::vector<float>, 3> weights;
  for (int axis = 0; axis < 3; ++axis)
  {
    weights[axis] = HalfKernel(deviation, geometry.Spacing[axis]);
  }
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<float> buffer;
      for (std::ptrdiff_t k = first; k < last; ++k)
      {
        for (std::ptrdiff_t j = 0; j < size[1]; ++j)
        {
          ConvolveRow(voxels.data() + k * slice + j * row, size[0], weights[0], buffer);
        }
        ConvolveLines(voxels.data() + k * slice, size[1], row, size[0], weights[1], buffer);
      }
    });
  parallelFor(0, size[1],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<float> buffer;
      for (std::ptrdiff_t j = first; j < last; ++j)
      {
        ConvolveLines(voxels.data() + j * row, size[2], slice, size[0], weights[2], buffer);
      }
    });
}

} // namespace FlipFree
