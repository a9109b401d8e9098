#include "Deformation/StartMask.h"

#include "Error.h"
#include "Image/DistanceTransform.h"
#include "Image/GridCheck.h"
#include "Image/LatticePlacement.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

StartMask StartMaskOf(const LabelVolume& labels, int label, const ImageGeometry& image,
  const std::string& nameOfImage)
{
  if (labels.Geometry.NumberOfVoxels() == 0)
  {
    throw Error(ErrorCode::InvalidGeometry, labels.Name + " have no voxels; give a label map");
  }
  RequireProperGrid(labels.Geometry, labels.Name);
  const LatticePlacement placement = PlacementOn(image, labels.Geometry, nameOfImage, labels.Name);
  const BitMask mask = labels.MaskOf(label == 0 ? -1 : label);
  const std::size_t count = mask.Count();
  if (count == 0)
  {
    const std::string others = TextOf(labels.Values().Labels);
    throw Error(ErrorCode::EmptyMask,
      labels.Name + " have no " +
        (label == 0 ? "nonzero voxels" : "voxels with the value " + std::to_string(label)) +
        (others.empty()
            ? "; give a label map of the organ"
            : "; they have " + others + ": set {StartLabel} to a value that they have"));
  }
  StartMask start{ PlacedIn(WholeBox(image), image, placement, mask) };
  const std::size_t inside = start.Voxels.Count();
  if (inside == 0)
  {
    throw Error(ErrorCode::EmptyMask,
      labels.Name + " have the label only outside " + nameOfImage +
        "; give an image that holds the organ, or another label");
  }
  start.Outside = 1 - static_cast<double>(inside) / static_cast<double>(count);
  return start;
}

SeedSphere LargestBallIn(const BitMask& mask, const ParallelFor& parallelFor)
{
  const VoxelBox box = mask.Bounds();
  // With a layer of background on all sides, beyond the image's ends, too.
  ImageGeometry geometry = CropGeometry(mask.GetGeometry(), box);
  geometry.Origin = geometry.ToPhysical(Eigen::Vector3d(-1, -1, -1));
  for (int& size : geometry.Dimensions)
  {
    size += 2;
  }
  BitMask inside(geometry);
  inside.Insert(mask.Cropped(box), { { 1, 1, 1 } });
  const std::vector<float> depth = SquaredDistance(inside, false, parallelFor, NeverStop);
  const auto deepest = std::max_element(depth.begin(), depth.end());
  const auto [i, j, k] = IndexOf(static_cast<std::size_t>(deepest - depth.begin()), geometry);
  SeedSphere ball;
  ball.Center = geometry.ToPhysical(Eigen::Vector3d(i, j, k));
  ball.Radius = std::sqrt(static_cast<double>(*deepest));
  // The image ends half a voxel before the layer around it.
  const ImageGeometry& image = mask.GetGeometry();
  const Eigen::Vector3d index = image.ToIndex(ball.Center);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double voxels = std::min(index[axis], image.Dimensions[axis] - 1 - index[axis]) + 0.5;
    ball.Radius = std::min(ball.Radius, voxels * image.Spacing[axis]);
  }
  // A seed is no smaller, though sheets and rows are.
  ball.Radius = std::max(ball.Radius, image.Spacing.minCoeff());
  return ball;
}

} // namespace FlipFree
