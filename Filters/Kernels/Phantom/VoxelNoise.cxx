#include "Phantom/VoxelNoise.h"

#include "Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace FlipFree
{
namespace
{

// The finalizer of SplitMix64: every input bit flips every output bit with probability one half.
std::uint64_t Mix(std::uint64_t bits)
{
  bits += 0x9E3779B97F4A7C15u;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
  return bits ^ (bits >> 31);
}

std::uint64_t Bits(int index)
{
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(index));
}

std::uint64_t RowHash(std::uint64_t seed, int j, int k)
{
  return Mix(Mix(Mix(seed) ^ Bits(k)) ^ Bits(j));
}

std::uint64_t PositionHash(std::uint64_t seed, int i, int j, int k)
{
  return Mix(RowHash(seed, j, k) ^ Bits(i));
}

// Box-Muller transform of the two halves of the bits.
double Normal(std::uint64_t bits)
{
  const double twoPi = 6.283185307179586477;
  const double u = (static_cast<double>(bits >> 32) + 0.5) * (1 / 4294967296.0);
  const double v = static_cast<double>(bits & 0xFFFFFFFFu) * (1 / 4294967296.0);
  return std::sqrt(-2 * std::log(u)) * std::cos(twoPi * v);
}

} // namespace

double PositionUniform(std::uint64_t seed, int i, int j, int k)
{
  return static_cast<double>(PositionHash(seed, i, j, k) >> 11) * (1 / 9007199254740992.0);
}

void RequireNoise(double standardDeviation, double correlation)
{
  if (!(standardDeviation >= 0) || !std::isfinite(standardDeviation))
  {
    throw Error(ErrorCode::OutOfRange,
      "the standard deviation of the noise must be zero or more, not " +
        std::to_string(standardDeviation));
  }
  if (!(correlation >= 0 && correlation <= 0.7))
  {
    throw Error(ErrorCode::OutOfRange,
      "the noise's correlation between neighbors must lie between 0 and "
      "0.7, not " +
        std::to_string(correlation));
  }
}

void AddNoise(std::uint64_t seed, double standardDeviation, double correlation,
  const Eigen::Array3i& first, const Eigen::Array3i& size, float* values)
{
  if (standardDeviation == 0)
  {
    return;
  }
  // White noise under the separable weights (side, 1, side): neighbors then have the correlation
  // 2 side / (1 + 2 side^2), solved here for side.
  const double side =
    correlation == 0 ? 0 : (1 - std::sqrt(1 - 2 * correlation * correlation)) / (2 * correlation);
  const float outer = static_cast<float>(side);
  const float scale = static_cast<float>(standardDeviation / (1 + 2 * side * side));
  const int width = size[0] + 2;
  const int height = size[1] + 2;
  std::vector<float> white(static_cast<std::size_t>(width) * height);
  std::vector<float> rows(static_cast<std::size_t>(size[0]) * height);
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < height; ++j)
    {
      const std::uint64_t row = RowHash(seed, first[1] + j - 1, first[2] + k);
      float* noise = &white[static_cast<std::size_t>(width) * j];
      for (int i = 0; i < width; ++i)
      {
        noise[i] = static_cast<float>(Normal(Mix(row ^ Bits(first[0] + i - 1))));
      }
      for (int i = 0; i < size[0]; ++i)
      {
        rows[static_cast<std::size_t>(size[0]) * j + i] =
          noise[i + 1] + outer * (noise[i] + noise[i + 2]);
      }
    }
    for (int j = 0; j < size[1]; ++j)
    {
      const float* row = &rows[static_cast<std::size_t>(size[0]) * j];
      for (int i = 0; i < size[0]; ++i)
      {
        *values++ += scale * (row[size[0] + i] + outer * (row[i] + row[2 * size[0] + i]));
      }
    }
  }
}

SmoothField::SmoothField(std::uint64_t seed, double cell, const Eigen::Vector3d& extent)
  : InverseCell(1 / cell)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Size[axis] = 2 + static_cast<int>(std::min(std::ceil(extent[axis] / cell), 62.0));
    this->First[axis] = -0.5 * (this->Size[axis] - 1) * cell;
  }
  for (int k = 0; k < this->Size[2]; ++k)
  {
    for (int j = 0; j < this->Size[1]; ++j)
    {
      for (int i = 0; i < this->Size[0]; ++i)
      {
        this->Nodes.push_back(static_cast<float>(Normal(PositionHash(seed, i, j, k))));
      }
    }
  }
}

double SmoothField::operator()(const Eigen::Vector3d& point) const
{
  std::array<int, 3> node;
  std::array<float, 3> weight;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = std::clamp((point[axis] - this->First[axis]) * this->InverseCell, 0.0,
      this->Size[axis] - 1.001);
    node[axis] = static_cast<int>(at);
    const float t = static_cast<float>(at - node[axis]);
    weight[axis] = t * t * (3 - 2 * t);
  }
  const std::size_t row = this->Size[0];
  const std::size_t slice = row * this->Size[1];
  const float* corner = &this->Nodes[node[0] + row * node[1] + slice * node[2]];
  const auto along = [&](const float* first)
  { return first[0] + weight[0] * (first[1] - first[0]); };
  const auto inPlane = [&](const float* first)
  {
    const float a = along(first);
    return a + weight[1] * (along(first + row) - a);
  };
  const float below = inPlane(corner);
  const float value = below + weight[2] * (inPlane(corner + slice) - below);
  // Interpolation loses variance: its mean along an axis is the integral of w^2 + (1 - w)^2 with
  // w = 3 t^2 - 2 t^3, which is 26 / 35.
  const double retained = 26.0 / 35.0;
  return value / std::sqrt(retained * retained * retained);
}

} // namespace FlipFree
