#include "Intensity/Modality.h"

#include "Quantile.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// In Hounsfield units: fat has less; soft tissue has more, and bone and contrast medium at most so
// much, of which the brightest are left out.
constexpr float Negative = -40;
constexpr float LeastBright = 40;
constexpr float MostBright = 2000;
// Paddings have at least this in 12 bits; with others, the brightest must be plain tissue.
constexpr float LowestIn12Bits = -4096;
constexpr float BrightTissue = 500;
// The darkest and the brightest part of the voxels are left out.
constexpr double TailOfValues = 0.01;
// Below zero, in comparison with the brightest.
constexpr float LeastPart = 0.05F;
constexpr int SamplesPerAxis = 64;

} // namespace

Modality ModalityOf(const VoxelReader& read, const ImageGeometry& geometry)
{
  std::array<int, 3> step{};
  for (int axis = 0; axis < 3; ++axis)
  {
    step[axis] = std::max(1, geometry.Dimensions[axis] / SamplesPerAxis);
  }
  std::vector<float> row(geometry.Dimensions[0]);
  std::vector<float> values;
  for (int k = 0; k < geometry.Dimensions[2]; k += step[2])
  {
    for (int j = 0; j < geometry.Dimensions[1]; j += step[1])
    {
      read(0, geometry.Dimensions[0], j, k, row.data());
      for (int i = 0; i < geometry.Dimensions[0]; i += step[0])
      {
        if (std::isfinite(row[i]))
        {
          values.push_back(row[i]);
        }
      }
    }
  }
  if (values.empty())
  {
    return Modality::MR;
  }
  const float darkest = TakeQuantile(values, TailOfValues);
  const float brightest = TakeQuantile(values, 1 - TailOfValues);
  const bool isBrightAsInCT =
    brightest > LeastBright && brightest <= (darkest < LowestIn12Bits ? BrightTissue : MostBright);
  return darkest < Negative && -darkest > LeastPart * brightest && isBrightAsInCT ? Modality::CT
                                                                                  : Modality::MR;
}

Modality ResolveModality(Modality given, const VoxelReader& read, const ImageGeometry& geometry)
{
  return given == Modality::Automatic ? ModalityOf(read, geometry) : given;
}

} // namespace FlipFree
