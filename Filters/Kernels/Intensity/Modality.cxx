#include "Intensity/Modality.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Fat has less than this, in Hounsfield units.
constexpr float Negative = -40;
// In CT, that many of the voxels around an organ at least.
constexpr double Part = 0.01;
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
  std::size_t negative = 0;
  std::size_t count = 0;
  for (int k = 0; k < geometry.Dimensions[2]; k += step[2])
  {
    for (int j = 0; j < geometry.Dimensions[1]; j += step[1])
    {
      read(0, geometry.Dimensions[0], j, k, row.data());
      for (int i = 0; i < geometry.Dimensions[0]; i += step[0])
      {
        negative += row[i] < Negative ? 1 : 0;
        ++count;
      }
    }
  }
  return static_cast<double>(negative) >= Part * static_cast<double>(count) && count > 0
    ? Modality::CT
    : Modality::MR;
}

} // namespace FlipFree
