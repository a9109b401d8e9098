#include "Image/BoxReading.h"

namespace FlipFree
{

FloatImage ReadBox(const VoxelReader& read, const ImageGeometry& geometry, const VoxelBox& box,
  const ParallelFor& parallelFor)
{
  FloatImage part;
  part.Geometry = CropGeometry(geometry, box);
  part.Voxels.resize(part.Geometry.NumberOfVoxels());
  parallelFor(0, box.Size(2),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < box.Size(1); ++j)
        {
          read(box.Begin[0], box.End[0], box.Begin[1] + j, box.Begin[2] + k,
            part.Voxels.data() + part.Geometry.Offset(0, j, k));
        }
      }
    });
  return part;
}

} // namespace FlipFree
