#include "Intensity/Modality.h"

#include "Intensity/RobustStatistics.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Fat has less, in Hounsfield units.
constexpr float Negative = -40;
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
  return darkest < Negative && -darkest > LeastPart * brightest ? Modality::CT : Modality::MR;
}

Modality ResolveModality(Modality given, const VoxelReader& read, const ImageGeometry& geometry)
{
  return given == Modality::Automatic ? ModalityOf(read, geometry) : given;
}

} // namespace FlipFree
