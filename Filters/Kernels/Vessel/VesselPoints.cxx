#include "Vessel/VesselPoints.h"

#include "Error.h"
#include "Image/NoData.h"
#include "Image/PointCheck.h"
#include "Image/VoxelOffsets.h"
#include "MessageText.h"

#include <algorithm>
#include <limits>

namespace FlipFree
{
namespace
{

constexpr double LeastDistance = 3; // between two points, mm

// Lets a line begin on the plane across it through a point near its begin: shortens or prolongs it.
void BeginAt(const Eigen::RowVector3d& point, PointList& line)
{
  constexpr Eigen::Index places = 8; // more than a point is snapped by
  const Eigen::Index looked = std::min<Eigen::Index>(places, line.rows() - 2);
  Eigen::Index nearest = 0;
  (line.topRows(looked).rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
  if (nearest > 0)
  {
    line = PointList(line.bottomRows(line.rows() - nearest));
    return;
  }
  const Eigen::RowVector3d outward = (line.row(0) - line.row(1)).normalized();
  const double beyond = (point - line.row(0)).dot(outward);
  constexpr double least = 0.01; // mm; nearer, two points would be one but for rounding
  if (beyond > least)
  {
    PointList longer(line.rows() + 1, 3);
    longer << line.row(0) + beyond * outward, line;
    line = longer;
  }
}

} // namespace

void RequirePoints(const GrayVolume& volume, const PointList& points, const std::string& name)
{
  const ImageGeometry& geometry = volume.Geometry;
  if (points.rows() < 2)
  {
    throw Error(ErrorCode::OutOfRange,
      "a vessel needs at least two points, not " + std::to_string(points.rows()) +
        "; give one at each end");
  }
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    RequirePoint(geometry, points.row(point).transpose(),
      "the point " + TextOf(points.row(point)) + " mm", name);
    for (Eigen::Index other = 0; other < point; ++other)
    {
      if ((points.row(point) - points.row(other)).norm() < LeastDistance)
      {
        throw Error(ErrorCode::OutOfRange,
          "the points " + TextOf(points.row(other)) + " and " + TextOf(points.row(point)) +
            " mm are closer than " + std::to_string(static_cast<int>(LeastDistance)) +
            " mm; keep one of them");
      }
    }
    RequireData(volume.Read, geometry, points.row(point).transpose(),
      "the point " + TextOf(points.row(point)) + " mm");
  }
}

PointList Snap(const VesselImage& image, const PointList& points, double distance)
{
  const ImageView<float> cubes = image.Cubes.View();
  PointList snapped = points;
  for (Eigen::Index point = 0; point < points.rows() && distance > 0; ++point)
  {
    float brightest = -std::numeric_limits<float>::infinity();
    for (const std::size_t voxel :
      VoxelsInSphere(cubes.Geometry, { points.row(point).transpose(), distance }))
    {
      if (cubes.Data[voxel] > brightest &&
        !std::binary_search(image.WithoutData.begin(), image.WithoutData.end(), voxel))
      {
        brightest = cubes.Data[voxel];
        snapped.row(point) = CenterOf(voxel, cubes.Geometry);
      }
    }
  }
  return snapped;
}

void EndAtPoints(const PointList& snapped, const PointList& clicked, bool hasParent,
  PointList& line)
{
  for (int end = hasParent ? 1 : 0; end < 2; ++end)
  {
    Eigen::Index nearest = 0;
    const Eigen::RowVector3d place = line.row(end == 0 ? 0 : line.rows() - 1);
    (snapped.rowwise() - place).rowwise().squaredNorm().minCoeff(&nearest);
    if (end == 1)
    {
      line = PointList(line.colwise().reverse());
    }
    BeginAt(clicked.row(nearest), line);
    if (end == 1)
    {
      line = PointList(line.colwise().reverse());
    }
  }
}

} // namespace FlipFree
