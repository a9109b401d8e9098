#include "AnisotropicDiffusion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace FlipFree
{
namespace
{

// Slices that are worked on by one thread in one piece.
constexpr std::ptrdiff_t SlicesOfSlab = 16;

struct Fluxes
{
  float WeightX;
  float WeightY;
  float WeightZ;
  float InverseSquare; // 1 / contrast^2
};

// Flux between two neighbours: the difference times a conductance that falls off at edges.
inline float Flux(float difference, float inverseSquare)
{
  return difference / (1 + difference * difference * inverseSquare);
}

// One row of one explicit step. The rows before and after, in y and in z, repeat at the border,
// which lets nothing flow out.
void StepRow(const float* row, const float* south, const float* north, const float* below,
  const float* above, float* out, int size, const Fluxes& fluxes)
{
  const float s = fluxes.InverseSquare;
  for (int i = 0; i < size; ++i)
  {
    const float v = row[i];
    const float west = row[i > 0 ? i - 1 : 0];
    const float east = row[i + 1 < size ? i + 1 : i];
    out[i] = v + fluxes.WeightX * (Flux(west - v, s) + Flux(east - v, s)) +
      fluxes.WeightY * (Flux(south[i] - v, s) + Flux(north[i] - v, s)) +
      fluxes.WeightZ * (Flux(below[i] - v, s) + Flux(above[i] - v, s));
  }
}

// One slice of one explicit step.
void StepSlice(const float* now, const float* below, const float* above,
  const std::array<int, 3>& size, const Fluxes& fluxes, float* out)
{
  const std::ptrdiff_t row = size[0];
  for (std::ptrdiff_t j = 0; j < size[1]; ++j)
  {
    const float* const at = now + j * row;
    StepRow(at, at - (j > 0 ? row : 0), at + (j + 1 < size[1] ? row : 0), below + j * row,
      above + j * row, out + j * row, size[0], fluxes);
  }
}

} // namespace

bool DiffuseAnisotropically(std::vector<float>& voxels, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  const auto& size = geometry.Dimensions;
  const std::ptrdiff_t slice = static_cast<std::ptrdiff_t>(size[0]) * size[1];
  // The step is chosen in units of the finest spacing; coarser axes diffuse less.
  const double finest = geometry.Spacing.minCoeff();
  const Eigen::Vector3d weights = (finest / geometry.Spacing.array()).square();
  const double step = 1 / (2 * weights.sum() + 1e-9);
  // Finite, so that where nothing differs nothing flows, however small the contrast.
  const double inverseSquare = 1 / (settings.Contrast * settings.Contrast);
  const Fluxes fluxes{ static_cast<float>(step * weights[0]), static_cast<float>(step * weights[1]),
    static_cast<float>(step * weights[2]), static_cast<float>(std::min(inverseSquare, 1e38)) };

  // In place, slab by slab. The slices next to a slab are kept as they were before the step, since
  // other slabs may have changed them by the time that they are needed.
  const std::ptrdiff_t slabs = (size[2] + SlicesOfSlab - 1) / SlicesOfSlab;
  std::vector<float> before(slabs * slice);
  std::vector<float> behind(slabs * slice);
  for (int iteration = 0; iteration < settings.Iterations; ++iteration)
  {
    if (!monitor(static_cast<double>(iteration) / settings.Iterations))
    {
      return false;
    }
    parallelFor(0, slabs,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t slab = first; slab < last; ++slab)
        {
          const std::ptrdiff_t begin = slab * SlicesOfSlab;
          const std::ptrdiff_t end = std::min<std::ptrdiff_t>(begin + SlicesOfSlab, size[2]);
          // The border repeats, which lets nothing flow out.
          const float* const lower = voxels.data() + std::max<std::ptrdiff_t>(begin - 1, 0) * slice;
          const float* const upper =
            voxels.data() + std::min<std::ptrdiff_t>(end, size[2] - 1) * slice;
          std::copy_n(lower, slice, before.data() + slab * slice);
          std::copy_n(upper, slice, behind.data() + slab * slice);
        }
      });
    parallelFor(0, slabs,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        std::vector<float> below(slice);
        std::vector<float> now(slice);
        for (std::ptrdiff_t slab = first; slab < last; ++slab)
        {
          const std::ptrdiff_t begin = slab * SlicesOfSlab;
          const std::ptrdiff_t end = std::min<std::ptrdiff_t>(begin + SlicesOfSlab, size[2]);
          std::copy_n(before.data() + slab * slice, slice, below.data());
          for (std::ptrdiff_t k = begin; k < end; ++k)
          {
            float* const out = voxels.data() + k * slice;
            std::copy_n(out, slice, now.data());
            const float* const above = k + 1 < end ? out + slice : behind.data() + slab * slice;
            StepSlice(now.data(), below.data(), above, size, fluxes, out);
            below.swap(now);
          }
        }
      });
  }
  return true;
}

double ContrastOfNoise(double noiseDeviation)
{
  // Differences of neighbours scatter by sqrt(2) of the noise; twice that is an edge. An image
  // without noise has nothing to smooth.
  return std::max(1e-3, 2 * std::sqrt(2.0) * noiseDeviation);
}

} // namespace FlipFree
