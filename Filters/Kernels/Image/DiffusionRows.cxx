#include "Image/DiffusionRows.h"

#include <cmath>

// Inlined into the functions for each instruction set.
#if defined(__GNUC__)
#define FLIPFREE_INLINE [[gnu::always_inline]] inline
#else
#define FLIPFREE_INLINE inline
#endif

namespace FlipFree
{
namespace
{

FLIPFREE_INLINE void FluxOfRow(const float* near, const float* far,
  const DiffusionCoefficients& coefficients, int size, float* __restrict flux)
{
  const float fall = coefficients.Fall;
  for (int i = 0; i < size; ++i)
  {
    const float difference = far[i] - near[i];
    const float flow = difference / (1 + difference * difference * fall);
    flux[i] = std::isnan(flow) ? 0 : flow; // a voxel has no data
  }
}

FLIPFREE_INLINE void StepOfRow(const float* voxels, const RowFluxes& previous,
  const RowFluxes& next, const DiffusionCoefficients& coefficients, int size, float* __restrict out)
{
  const auto [weight0, weight1, weight2] = coefficients.Weight;
  const auto [previous0, previous1, previous2] = previous;
  const auto [next0, next1, next2] = next;
  for (int i = 0; i < size; ++i)
  {
    out[i] = voxels[i] +
      (weight0 * (next0[i] - previous0[i]) + weight1 * (next1[i] - previous1[i]) +
        weight2 * (next2[i] - previous2[i]));
  }
}

void PlainFlux(const float* near, const float* far, const DiffusionCoefficients& coefficients,
  int size, float* flux)
{
  FluxOfRow(near, far, coefficients, size, flux);
}

void PlainStep(const float* voxels, const RowFluxes& previous, const RowFluxes& next,
  const DiffusionCoefficients& coefficients, int size, float* out)
{
  StepOfRow(voxels, previous, next, coefficients, size, out);
}

#if defined(__GNUC__) && defined(__x86_64__)

[[gnu::target("avx2")]] void WideFlux(const float* near, const float* far,
  const DiffusionCoefficients& coefficients, int size, float* flux)
{
  FluxOfRow(near, far, coefficients, size, flux);
}

[[gnu::target("avx2")]] void WideStep(const float* voxels, const RowFluxes& previous,
  const RowFluxes& next, const DiffusionCoefficients& coefficients, int size, float* out)
{
  StepOfRow(voxels, previous, next, coefficients, size, out);
}

#endif

} // namespace

DiffusionRows ChooseDiffusionRows([[maybe_unused]] bool plain)
{
#if defined(__GNUC__) && defined(__x86_64__)
  if (!plain && __builtin_cpu_supports("avx2"))
  {
    return { WideFlux, WideStep };
  }
#endif
  return { PlainFlux, PlainStep };
}

} // namespace FlipFree
