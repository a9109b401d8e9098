#include "Vessel/TreeDepth.h"

#include "Vessel/TubeOccupancy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// The voxels of a cubic grid around all sections.
ImageGeometry GridAround(const VesselTree& tree, double edge)
{
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (const VesselBranch& branch : tree.Branches)
  {
    for (std::size_t section = 0; section < branch.Sections.Frames.size(); ++section)
    {
      const double radius =
        branch.Sections.Radii.row(static_cast<Eigen::Index>(section)).maxCoeff() + 2 * edge + 2;
      const Eigen::Array3d center = branch.Sections.Frames[section].Origin.array();
      low = low.min(center - radius);
      high = high.max(center + radius);
    }
  }
  ImageGeometry grid;
  grid.Spacing.setConstant(edge);
  grid.Origin = low.matrix();
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Dimensions[axis] = static_cast<int>(std::ceil((high[axis] - low[axis]) / edge)) + 1;
  }
  return grid;
}

} // namespace

FloatImage DepthOnGrid(const VesselTree& tree, double edge, double margin,
  const ParallelFor& parallelFor)
{
  FloatImage depth;
  depth.Geometry = GridAround(tree, edge);
  depth.Voxels.assign(depth.Geometry.NumberOfVoxels(), static_cast<float>(-margin));
  for (const VesselBranch& branch : tree.Branches)
  {
    MergeTubeDepth(branch.Sections, margin, branch.Parent >= 0, false, parallelFor, depth);
  }
  return depth;
}

double SmallestRadius(const VesselTree& tree)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const VesselBranch& branch : tree.Branches)
  {
    Eigen::VectorXd mean = branch.Sections.MeanRadii();
    std::nth_element(mean.data(), mean.data() + mean.size() / 4, mean.data() + mean.size());
    smallest = std::min(smallest, mean[mean.size() / 4]);
  }
  return smallest;
}

} // namespace FlipFree
