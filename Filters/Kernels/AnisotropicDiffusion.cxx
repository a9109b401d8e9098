#include "AnisotropicDiffusion.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

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

} // namespace

bool DiffuseAnisotropically(std::vector<float>& voxels, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  const auto& size = geometry.Dimensions;
  const std::ptrdiff_t row = size[0];
  const std::ptrdiff_t slice = row * size[1];
  // The step is chosen in units of the finest spacing; coarser axes diffuse less.
  const double finest = geometry.Spacing.minCoeff();
  const Eigen::Vector3d weights = (finest / geometry.Spacing.array()).square();
  const double step = 1 / (2 * weights.sum() + 1e-9);
  // Finite, so that where nothing differs nothing flows, however small the contrast.
  const double inverseSquare = 1 / (settings.Contrast * settings.Contrast);
  const Fluxes fluxes{ static_cast<float>(step * weights[0]), static_cast<float>(step * weights[1]),
    static_cast<float>(step * weights[2]), static_cast<float>(std::min(inverseSquare, 1e38)) };

  std::vector<float> next(voxels.size());
  for (int iteration = 0; iteration < settings.Iterations; ++iteration)
  {
    if (!monitor(static_cast<double>(iteration) / settings.Iterations))
    {
      return false;
    }
    parallelFor(0, size[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t k = first; k < last; ++k)
        {
          const std::ptrdiff_t below = k > 0 ? -slice : 0;
          const std::ptrdiff_t above = k + 1 < size[2] ? slice : 0;
          for (std::ptrdiff_t j = 0; j < size[1]; ++j)
          {
            const float* at = voxels.data() + k * slice + j * row;
            StepRow(at, at - (j > 0 ? row : 0), at + (j + 1 < size[1] ? row : 0), at + below,
              at + above, next.data() + k * slice + j * row, size[0], fluxes);
          }
        }
      });
    voxels.swap(next);
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
