/**
 * Where a point lies relative to a closed surface of triangles: on which side, and what is nearest.
 */
#ifndef FlipFreeWindingNumber_h
#define FlipFreeWindingNumber_h

#include "KernelTypes.h"

namespace FlipFree
{

/// How often a closed surface winds around a point: 1 inside an embedded, outward one, 0 outside.
/// The sum of the triangles' solid angles (A. Van Oosterom and J. Strackee, The solid angle of a
/// plane triangle, 1983) is a whole number up to rounding, so the answer is exact for a point
/// whose distance from the surface is well above rounding errors. There it is also the same for
/// all ways to cut the surface's faces if the point lies in the hull of none.
int WindingNumber(const PointList& points, const TriangleList& triangles,
  const Eigen::Vector3d& point);

struct SurfacePlace
{
  int Triangle = -1;
  Eigen::Vector3d Point = Eigen::Vector3d::Zero(); ///< on the surface
};

/// The place nearest to a point; the first one of several. There is at least one triangle.
SurfacePlace ClosestPlace(const PointList& points, const TriangleList& triangles,
  const Eigen::Vector3d& point);

/// The places nearest to many points, one row each; of several, any.
PointList ClosestPlaces(const PointList& points, const TriangleList& triangles,
  const PointList& queries, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
