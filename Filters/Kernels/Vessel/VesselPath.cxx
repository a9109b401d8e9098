#include "Vessel/VesselPath.h"

#include "Image/ImageInterpolation.h"
#include "Vessel/MinimalPaths.h"
#include "Vessel/Polyline.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

PointList Snap(const ImageView<float>& image, const PointList& points, double distance)
{
  PointList snapped = points;
  for (Eigen::Index point = 0; point < points.rows() && distance > 0; ++point)
  {
    std::size_t best = 0;
    float most = -std::numeric_limits<float>::infinity();
    for (const std::size_t voxel :
      VoxelsInSphere(image.Geometry, { points.row(point).transpose(), distance }))
    {
      if (image.Data[voxel] > most)
      {
        most = image.Data[voxel];
        best = voxel;
      }
    }
    const auto& size = image.Geometry.Dimensions;
    snapped.row(point) = image.Geometry.ToPhysical(Eigen::Vector3d(static_cast<double>(best % size[0]),
      static_cast<double>(best / size[0] % size[1]),
      static_cast<double>(best / size[0] / size[1])));
  }
  return snapped;
}

// First guesses at the radii from the depth along the line.
Eigen::VectorXd FirstRadii(const FloatImage& depth, const PointList& line)
{
  Eigen::VectorXd along(line.rows());
  for (Eigen::Index place = 0; place < line.rows(); ++place)
  {
    along[place] = InterpolateClamped(depth.View(),
      depth.Geometry.ToIndex(line.row(place).transpose()));
  }
  std::vector<double> sorted(along.data(), along.data() + along.size());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return (1.15 * MedianAlong(along, 4)).cwiseMin(1.5 * *middle).cwiseMax(1.0);
}

} // namespace

VesselTree TraceVessel(const VoxelReader& read, const ImageGeometry& geometry,
  const PointList& clicked, const VesselPathSettings& settings, const Threading& threading,
  const Monitor& monitor)
{
  const VoxelBox box = BoxAroundPoints(geometry, clicked, settings.Margin);
  const VesselImage image = MakeVesselImage(ReadBox(read, geometry, box, threading.For),
    settings.SmoothingDeviation, settings.GridSpacing, threading.For);
  const PointList points = Snap(image.Cubes.View(), clicked, settings.SnapDistance);
  VesselTree tree;
  tree.Radius = settings.Radius;
  const VesselIntensities intensities =
    IntensitiesAtPoints(image.Cubes.View(), points, 0.7 * tree.Radius, settings.Speed);
  FloatImage depth;
  depth.Geometry = image.Cubes.Geometry;
  depth.Voxels = DepthOf(image.Cubes.View(), intensities, threading.For);
  const FloatImage speed = MakeVesselSpeed(image.Cubes, intensities, depth.Voxels, tree.Radius,
    settings.Speed, threading.For);
  for (const MinimalPath& path : JoinPoints(speed.View(), points, 15, monitor))
  {
    PointList line = path.Line;
    line = SmoothLine(line, 2);
    line = ResampleLine(line, settings.Sections.SectionStep);
    line = SmoothLine(line, 2);
    line = ResampleLine(line, settings.Sections.SectionStep);
    VesselBranch branch;
    branch.Sections = FitSections(image.Own.View(), line, FirstRadii(depth, line),
      settings.Sections, threading.For);
    branch.Sections.Radii.array() += settings.Wall;
    branch.Parent = path.Parent;
    tree.Branches.push_back(std::move(branch));
  }
  return tree;
}

} // namespace FlipFree
