#include "VoxelOverlap.h"

#include <atomic>
#include <sstream>
#include <stdexcept>

namespace FlipFree
{
namespace
{

const Eigen::IOFormat OneLine(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ", ", ", "", "", "(",
  ")");

[[noreturn]] void RefuseGeometry(const std::string& what, const Eigen::MatrixXd& segmentation,
  const Eigen::MatrixXd& reference)
{
  std::ostringstream message;
  message << "the " << what << " of the segmentation " << segmentation.format(OneLine)
          << " and of the reference " << reference.format(OneLine)
          << " differ; resample one onto the grid of the other";
  throw std::invalid_argument(message.str());
}

Eigen::Vector3d Vector(const std::array<int, 3>& values)
{
  return { 1.0 * values[0], 1.0 * values[1], 1.0 * values[2] };
}

} // namespace

void RequireSameGeometry(const ImageGeometry& segmentation, const ImageGeometry& reference)
{
  if (segmentation.Dimensions != reference.Dimensions)
  {
    RefuseGeometry("dimensions", Vector(segmentation.Dimensions), Vector(reference.Dimensions));
  }
  // Headers round their numbers, so compare where the corner voxels end up.
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d index =
      Eigen::Vector3d(corner & 1, (corner >> 1) & 1, corner >> 2)
        .cwiseProduct(Vector(reference.Dimensions) - Eigen::Vector3d::Ones());
    const double distance = (segmentation.ToPhysical(index) - reference.ToPhysical(index)).norm();
    if (distance <= 0.01 * reference.Spacing.cwiseAbs().minCoeff())
    {
      continue;
    }
    if (corner == 0)
    {
      RefuseGeometry("origins", segmentation.Origin, reference.Origin);
    }
    if (!segmentation.Spacing.isApprox(reference.Spacing, 1e-5))
    {
      RefuseGeometry("spacings", segmentation.Spacing, reference.Spacing);
    }
    RefuseGeometry("direction matrices", segmentation.Direction, reference.Direction);
  }
}

VoxelOverlap MeasureOverlap(const ImageView<unsigned char>& segmentation,
  const ImageView<unsigned char>& reference, const ParallelFor& parallelFor)
{
  RequireSameGeometry(segmentation.Geometry, reference.Geometry);
  std::atomic<std::size_t> inSegmentation{ 0 };
  std::atomic<std::size_t> inReference{ 0 };
  std::atomic<std::size_t> inBoth{ 0 };
  parallelFor(0, static_cast<std::ptrdiff_t>(reference.Geometry.NumberOfVoxels()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      VoxelOverlap part;
      for (std::ptrdiff_t voxel = first; voxel < last; ++voxel)
      {
        const bool a = segmentation.Data[voxel] != 0;
        const bool b = reference.Data[voxel] != 0;
        part.Segmentation += a;
        part.Reference += b;
        part.Intersection += a && b;
      }
      inSegmentation += part.Segmentation;
      inReference += part.Reference;
      inBoth += part.Intersection;
    });
  if (inSegmentation == 0 || inReference == 0)
  {
    throw std::invalid_argument(
      std::string(inReference == 0 ? "the reference" : "the segmentation") +
      " is empty: none of its voxels has the label asked for; check the label value");
  }
  return { inSegmentation, inReference, inBoth };
}

} // namespace FlipFree
