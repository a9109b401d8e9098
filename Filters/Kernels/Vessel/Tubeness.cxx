#include "Vessel/Tubeness.h"

#include "Image/VoxelOffsets.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace FlipFree
{
namespace
{

// By central differences, in gray values per square millimeter; not at the rim of the image.
Eigen::Matrix3d HessianAt(const ImageView<float>& image, const std::array<std::ptrdiff_t, 3>& steps,
  std::size_t voxel)
{
  const float* const here = image.Data + voxel;
  const Eigen::Vector3d& spacing = image.Geometry.Spacing;
  Eigen::Matrix3d hessian;
  for (int row = 0; row < 3; ++row)
  {
    hessian(row, row) =
      (here[steps[row]] + here[-steps[row]] - 2 * here[0]) / (spacing[row] * spacing[row]);
    for (int column = 0; column < row; ++column)
    {
      const std::ptrdiff_t along = steps[row] + steps[column];
      const std::ptrdiff_t across = steps[row] - steps[column];
      hessian(row, column) = (here[along] + here[-along] - here[across] - here[-across]) /
        (4 * spacing[row] * spacing[column]);
      hessian(column, row) = hessian(row, column);
    }
  }
  return hessian;
}

double TubenessOf(const Eigen::Matrix3d& hessian)
{
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(hessian, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& curvatures = solver.eigenvalues(); // increasing
  return curvatures[1] < 0 ? std::sqrt(curvatures[0] * curvatures[1]) : 0;
}

} // namespace

std::vector<float> BrightTubeness(const FloatImage& image, const std::vector<unsigned char>& wanted,
  double deviation, const ParallelFor& parallelFor)
{
  const ImageView<float> view = image.View();
  const auto& size = image.Geometry.Dimensions;
  const std::array<std::ptrdiff_t, 3> steps = StepsOf(image.Geometry);
  std::vector<float> result(image.Voxels.size(), 0);
  parallelFor(1, std::max(1, size[2] - 1),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 1; j + 1 < size[1]; ++j)
        {
          for (int i = 1; i + 1 < size[0]; ++i)
          {
            const std::size_t voxel = image.Geometry.Offset(i, j, k);
            if (wanted[voxel])
            {
              result[voxel] = static_cast<float>(
                deviation * deviation * TubenessOf(HessianAt(view, steps, voxel)));
            }
          }
        }
      }
    });
  return result;
}

} // namespace FlipFree
