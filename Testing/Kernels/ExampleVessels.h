/**
 * Tubes of known course and radius in volumes: gray values of a contrast CT, with noise.
 */
#ifndef FlipFreeExampleVessels_h
#define FlipFreeExampleVessels_h

#include "Deformation/VolumeSegmentation.h"
#include "ExampleMasks.h"
#include "Vessel/VesselSegmentation.h"

#include <functional>
#include <random>
#include <vector>

namespace FlipFree
{

/// A course of a tube and its radius at each point.
struct ExampleTube
{
  PointList Line;
  std::vector<double> Radii;
};

/// `at` gives the point and `radius` the radius for parameters from 0 to 1.
inline ExampleTube MakeTube(const std::function<Eigen::Vector3d(double)>& at,
  const std::function<double(double)>& radius, int points = 200)
{
  ExampleTube tube;
  tube.Line.resize(points, 3);
  for (int point = 0; point < points; ++point)
  {
    const double place = point / (points - 1.0);
    tube.Line.row(point) = at(place);
    tube.Radii.push_back(radius(place));
  }
  return tube;
}

/// Whether a point lies in a tube that ends flat.
inline bool IsInTube(const ExampleTube& tube, const Eigen::Vector3d& point)
{
  Eigen::Index nearest = 0;
  (tube.Line.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  const Eigen::Index last = tube.Line.rows() - 1;
  const Eigen::RowVector3d tangent = tube.Line.row(std::min(last, nearest + 1)) -
    tube.Line.row(std::max<Eigen::Index>(0, nearest - 1));
  const double along = (point.transpose() - tube.Line.row(nearest)).dot(tangent);
  if ((nearest == 0 && along < 0) || (nearest == last && along > 0))
  {
    return false;
  }
  return (point.transpose() - tube.Line.row(nearest)).norm() < tube.Radii[nearest];
}

/// Tubes of 150 in a background of 40, air of -1000 in the first slices, so that it looks like CT.
inline FloatImage VolumeOfTubes(const std::vector<ExampleTube>& tubes,
  const ImageGeometry& geometry, double noise)
{
  FloatImage volume;
  volume.Geometry = geometry;
  volume.Voxels.resize(geometry.NumberOfVoxels());
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  for (int k = 0; k < geometry.Dimensions[2]; ++k)
  {
    for (int j = 0; j < geometry.Dimensions[1]; ++j)
    {
      for (int i = 0; i < geometry.Dimensions[0]; ++i)
      {
        const Eigen::Vector3d point = geometry.ToPhysical(Eigen::Vector3d(i, j, k));
        double value = k < 2 ? -1000 : 40;
        for (const ExampleTube& tube : tubes)
        {
          value = IsInTube(tube, point) ? 150 : value;
        }
        volume.Voxels[geometry.Offset(i, j, k)] =
          static_cast<float>(value + noise * normal(random));
      }
    }
  }
  return volume;
}

inline GrayVolume GrayVolumeOf(const FloatImage& image)
{
  return GrayVolumeOf(image.View());
}

inline PointList Points(const std::vector<Eigen::Vector3d>& points)
{
  PointList list(static_cast<Eigen::Index>(points.size()), 3);
  for (Eigen::Index point = 0; point < list.rows(); ++point)
  {
    list.row(point) = points[point];
  }
  return list;
}

/// Where tubes are clicked: they go on beyond, as vessels do.
constexpr Eigen::Index FirstClick = 15;
constexpr Eigen::Index LastClick = 184;

inline PointList ClicksIn(const ExampleTube& tube)
{
  return Points({ tube.Line.row(FirstClick).transpose(), tube.Line.row(LastClick).transpose() });
}

inline ExampleTube BetweenClicks(const ExampleTube& tube, Eigen::Index first = FirstClick)
{
  ExampleTube part;
  part.Line = tube.Line.middleRows(first, LastClick - first + 1);
  part.Radii.assign(tube.Radii.begin() + first, tube.Radii.begin() + LastClick + 1);
  return part;
}

/// Against tubes that end flat.
inline double DiceOf(const VesselSegmentation& result, const std::vector<ExampleTube>& tubes,
  const ImageGeometry& geometry)
{
  std::vector<unsigned char> labels(geometry.NumberOfVoxels(), 0);
  FillRuns(result.Voxels, static_cast<unsigned char>(1), geometry, labels.data());
  double both = 0;
  double sum = 0;
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      bool truth = false;
      for (const ExampleTube& tube : tubes)
      {
        truth = truth || IsInTube(tube, geometry.ToPhysical(Eigen::Vector3d(i, j, k)));
      }
      const bool found = labels[geometry.Offset(i, j, k)] != 0;
      both += truth && found;
      sum += truth + found;
    });
  return 2 * both / sum;
}

inline VesselSegmentationSettings LumenSettings()
{
  VesselSegmentationSettings settings;
  settings.Path.WallThickness = 0;
  return settings;
}

} // namespace FlipFree

#endif
