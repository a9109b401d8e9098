/**
 * How much of the surfaces of two masks is near each other (S. Nikolov et al.: Clinically
 * applicable segmentation of head and neck anatomy for radiotherapy, 2021).
 */
#ifndef SurfaceDice_h
#define SurfaceDice_h

#include "Geometry/DistanceQuery.h"
#include "Measures/MaskSurface.h"

/// The part of the area of both surfaces that is no farther from the other one than a tolerance, in
/// millimeters. Each triangle, which is as small as a voxel, is where its center is.
inline double SurfaceDiceOf(const FlipFree::BitMask& one, const FlipFree::BitMask& other,
  double tolerance)
{
  if (one.Count() == 0 || other.Count() == 0)
  {
    return one.Count() == other.Count() ? 1 : 0;
  }
  const FlipFree::MaskSurface surfaces[2] = { FlipFree::SurfaceOf(one),
    FlipFree::SurfaceOf(other) };
  double all = 0;
  double near = 0;
  for (const int from : { 0, 1 })
  {
    const FlipFree::MaskSurface& surface = surfaces[from];
    FlipFree::PointList centers(surface.Triangles.rows(), 3);
    Eigen::VectorXd areas(surface.Triangles.rows());
    for (Eigen::Index triangle = 0; triangle < surface.Triangles.rows(); ++triangle)
    {
      const auto corner = [&](int index) -> Eigen::Vector3d
      { return surface.Points.row(surface.Triangles(triangle, index)).transpose(); };
      centers.row(triangle) = (corner(0) + corner(1) + corner(2)).transpose() / 3;
      areas[triangle] = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    }
    const FlipFree::MaskSurface& to = surfaces[1 - from];
    const Eigen::VectorXd distances =
      FlipFree::DistanceQuery(to.Points, to.Triangles).DistancesOf(centers);
    all += areas.sum();
    near += ((distances.array() <= tolerance).cast<double>() * areas.array()).sum();
  }
  return near / all;
}

#endif
