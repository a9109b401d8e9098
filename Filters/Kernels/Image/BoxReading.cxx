#include "Image/BoxReading.h"

namespace FlipFree
{

void ReadSlices(const VoxelReader& read, const VoxelBox& box, std::ptrdiff_t first,
  std::ptrdiff_t last, float* voxels)
{
  float* row = voxels + first * box.Size(1) * box.Size(0);
  for (int k = static_cast<int>(first); k < last; ++k)
  {
    for (int j = 0; j < box.Size(1); ++j, row += box.Size(0))
    {
      read(box.Begin[0], box.End[0], box.Begin[1] + j, box.Begin[2] + k, row);
    }
  }
}

FloatImage ReadBox(const VoxelReader& read, const ImageGeometry& geometry, const VoxelBox& box,
  const ParallelFor& parallelFor)
{
  FloatImage part;
  part.Geometry = CropGeometry(geometry, box);
  part.Voxels.resize(part.Geometry.NumberOfVoxels());
  parallelFor(0, box.Size(2),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    { ReadSlices(read, box, first, last, part.Voxels.data()); });
  return part;
}

} // namespace FlipFree
