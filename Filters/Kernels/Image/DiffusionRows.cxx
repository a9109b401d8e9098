#include "Image/DiffusionRows.h"

#include <cmath>
#include <cstdint>
#include <cstring>

// Inlined into functions for several sets of instructions, which it then takes over.
#if defined(__GNUC__)
#define FLIPFREE_INLINE [[gnu::always_inline]] inline
#else
#define FLIPFREE_INLINE inline
#endif

namespace FlipFree
{
namespace
{

using Equation = DiffusionEquation;

// Least square of a gradient (ITK's), which keeps the normal finite where nothing changes.
constexpr float LeastSquare = 1e-10F;

FLIPFREE_INLINE float Square(float value)
{
  return value * value;
}

// e^-x for x >= 0, to two units in the last place; 0 beyond 87. After W. J. Cody
// and W. Waite (Software manual for the elementary functions, 1980), with the Taylor polynomial,
// which is enough on half a binary logarithm's width.
FLIPFREE_INLINE float ExpOfMinus(float x)
{
  constexpr float greatest = 87.0F;
  constexpr float rounder = 12582912.0F; // 1.5 * 2^23: adding it leaves no digits behind the point
  constexpr std::int32_t bitsOfRounder = 0x4B400000;
  const float t = -(x < greatest ? x : greatest);
  const float shifted = t * 1.44269504F + rounder;
  const float n = shifted - rounder;
  const float r = (t - n * 0.693359375F) + n * 2.12194440e-4F;
  float sum = 1.0F / 720;
  sum = sum * r + 1.0F / 120;
  sum = sum * r + 1.0F / 24;
  sum = sum * r + 1.0F / 6;
  sum = sum * r + 0.5F;
  sum = sum * (r * r) + (r + 1);
  // Times 2^n, by way of the exponent's bits.
  std::int32_t bits = 0;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits - bitsOfRounder + 127) * (1 << 23);
  float power = 0;
  std::memcpy(&power, &bits, sizeof power);
  return x < greatest ? sum * power : 0.0F;
}

template <Equation equation>
FLIPFREE_INLINE void FluxOfRow(const FaceRows& rows, const DiffusionCoefficients& coefficients,
  int size, float* __restrict flux)
{
  const float fall = coefficients.Fall;
  const float* const near = rows.Near.Voxels;
  const float* const far = rows.Far.Voxels;
  if constexpr (equation == Equation::Faces)
  {
    for (int i = 0; i < size; ++i)
    {
      const float difference = far[i] - near[i];
      flux[i] = difference / (1 + Square(difference) * fall);
    }
  }
  else
  {
    const float scale = coefficients.InverseSpacing[rows.Axis];
    // A quarter: the mean over both sides of differences over two voxels.
    const float scale0 = 0.25F * coefficients.InverseSpacing[rows.Others[0]];
    const float scale1 = 0.25F * coefficients.InverseSpacing[rows.Others[1]];
    const float* const nearNext0 = rows.Near.Next[0];
    const float* const nearNext1 = rows.Near.Next[1];
    const float* const nearPrevious0 = rows.Near.Previous[0];
    const float* const nearPrevious1 = rows.Near.Previous[1];
    const float* const farNext0 = rows.Far.Next[0];
    const float* const farNext1 = rows.Far.Next[1];
    const float* const farPrevious0 = rows.Far.Previous[0];
    const float* const farPrevious1 = rows.Far.Previous[1];
    for (int i = 0; i < size; ++i)
    {
      const float slope = scale * (far[i] - near[i]);
      const float slope0 =
        scale0 * ((nearNext0[i] - nearPrevious0[i]) + (farNext0[i] - farPrevious0[i]));
      const float slope1 =
        scale1 * ((nearNext1[i] - nearPrevious1[i]) + (farNext1[i] - farPrevious1[i]));
      const float square = Square(slope) + Square(slope0) + Square(slope1);
      const float conducted = slope * ExpOfMinus(square * fall);
      flux[i] =
        equation == Equation::Gradient ? conducted : conducted / std::sqrt(LeastSquare + square);
    }
  }
}

template <Equation equation>
FLIPFREE_INLINE void StepOfRow(const VoxelRows& rows, const DiffusionCoefficients& coefficients,
  int size, float* __restrict out)
{
  const auto [weight0, weight1, weight2] = coefficients.Weight;
  const auto [previousFlux0, previousFlux1, previousFlux2] = rows.PreviousFlux;
  const auto [nextFlux0, nextFlux1, nextFlux2] = rows.NextFlux;
  const float* const voxels = rows.Voxels;
  if constexpr (equation != Equation::Curvature)
  {
    for (int i = 0; i < size; ++i)
    {
      out[i] = voxels[i] +
        (weight0 * (nextFlux0[i] - previousFlux0[i]) + weight1 * (nextFlux1[i] - previousFlux1[i]) +
          weight2 * (nextFlux2[i] - previousFlux2[i]));
    }
  }
  else
  {
    const auto [scale0, scale1, scale2] = coefficients.InverseSpacing;
    const auto [previous0, previous1, previous2] = rows.Previous;
    const auto [next0, next1, next2] = rows.Next;
    // The square of the slope as the moving level set sees it, upwind: of the two sides, what it
    // comes from.
    const auto upwind = [](float slopeToNext, float slopeFromPrevious, float sign)
    {
      const float next = sign * slopeToNext;
      const float previous = sign * slopeFromPrevious;
      return Square(next > 0 ? next : 0.0F) + Square(previous < 0 ? previous : 0.0F);
    };
    for (int i = 0; i < size; ++i)
    {
      const float v = voxels[i];
      const float speed = (nextFlux0[i] - previousFlux0[i]) + (nextFlux1[i] - previousFlux1[i]) +
        (nextFlux2[i] - previousFlux2[i]);
      const float sign = speed > 0 ? 1.0F : -1.0F;
      const float square = upwind(scale0 * (next0[i] - v), scale0 * (v - previous0[i]), sign) +
        upwind(scale1 * (next1[i] - v), scale1 * (v - previous1[i]), sign) +
        upwind(scale2 * (next2[i] - v), scale2 * (v - previous2[i]), sign);
      out[i] = v + coefficients.TimeStep * (std::sqrt(square) * speed);
    }
  }
}

template <Equation equation>
void PlainFlux(const FaceRows& rows, const DiffusionCoefficients& coefficients, int size,
  float* flux)
{
  FluxOfRow<equation>(rows, coefficients, size, flux);
}

template <Equation equation>
void PlainStep(const VoxelRows& rows, const DiffusionCoefficients& coefficients, int size,
  float* out)
{
  StepOfRow<equation>(rows, coefficients, size, out);
}

#if defined(__GNUC__) && defined(__x86_64__)

template <Equation equation>
[[gnu::target("avx2")]] void WideFlux(const FaceRows& rows,
  const DiffusionCoefficients& coefficients, int size, float* flux)
{
  FluxOfRow<equation>(rows, coefficients, size, flux);
}

template <Equation equation>
[[gnu::target("avx2")]] void WideStep(const VoxelRows& rows,
  const DiffusionCoefficients& coefficients, int size, float* out)
{
  StepOfRow<equation>(rows, coefficients, size, out);
}

template <Equation equation>
DiffusionRows ChooseFor(bool plain)
{
  if (!plain && __builtin_cpu_supports("avx2"))
  {
    return { WideFlux<equation>, WideStep<equation> };
  }
  return { PlainFlux<equation>, PlainStep<equation> };
}

#else

template <Equation equation>
DiffusionRows ChooseFor(bool)
{
  return { PlainFlux<equation>, PlainStep<equation> };
}

#endif

} // namespace

DiffusionRows ChooseDiffusionRows(DiffusionEquation equation, bool plain)
{
  switch (equation)
  {
    case Equation::Gradient:
      return ChooseFor<Equation::Gradient>(plain);
    case Equation::Curvature:
      return ChooseFor<Equation::Curvature>(plain);
    default:
      return ChooseFor<Equation::Faces>(plain);
  }
}

} // namespace FlipFree
