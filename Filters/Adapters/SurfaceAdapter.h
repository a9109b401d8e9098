/**
 * Private to the modules, never installed: a vtkPolyData as the checked surface that kernels
 * measure.
 */
#ifndef FlipFreeSurfaceAdapter_h
#define FlipFreeSurfaceAdapter_h

#include "Error.h"
#include "Mesh/SurfaceTopology.h"
#include "MeshAdapter.h"

#include <string>

namespace FlipFree
{

struct PolygonalSurface
{
  PointList Points;
  FaceList Faces;         ///< one per polygon, in their order
  TriangleList Triangles; ///< of the faces, in their order
};

/// Throws Error, naming the surface by `name`, when it has no points or has triangle strips.
inline void RequirePolygons(vtkPolyData* data, const std::string& name)
{
  if (data->GetNumberOfPoints() == 0)
  {
    throw Error(ErrorCode::InvalidMesh,
      name + " has no points; connect a filter that makes a surface");
  }
  if (data->GetNumberOfStrips() > 0)
  {
    throw Error(ErrorCode::InvalidInput,
      name + " has triangle strips; convert them to polygons by vtkTriangleFilter");
  }
}

/// Copies a surface. Throws Error, naming the surface by `name`, when it has no points or no
/// polygons, has triangle strips, or is not valid (RequireValidFaces).
inline PolygonalSurface SurfaceOf(vtkPolyData* data, const std::string& name)
{
  RequirePolygons(data, name);
  PolygonalSurface surface;
  surface.Points = CopyPoints(data);
  surface.Faces = CopyPolys(data, name);
  RequireValidFaces(surface.Points, surface.Faces, name);
  surface.Triangles = Triangulate(surface.Faces);
  return surface;
}

} // namespace FlipFree

#endif
