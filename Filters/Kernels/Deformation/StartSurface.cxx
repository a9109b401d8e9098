#include "Deformation/StartSurface.h"

#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/QuadSphere.h"
#include "Mesh/SurfaceTopology.h"
#include "MessageText.h"

namespace FlipFree
{

DeformableSurface MakeStartSphere(int n, const Eigen::Vector3d& center, double radius)
{
  const QuadSphere sphere = MakeQuadSphere(n, center, radius, QuadSphereSpacing::Equiangular);
  return { BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces), sphere.Points };
}

void RequireEmbedded(const ContourMesh& mesh, const FaceHulls& hulls, const PointList& points,
  const std::string& name, const ParallelFor& parallelFor)
{
  const auto pairs = FindSelfIntersections(points, hulls, parallelFor);
  if (!pairs.empty())
  {
    throw Error(ErrorCode::SelfIntersecting,
      name + " intersects itself in " + std::to_string(pairs.size()) +
        " pairs of faces, for some way to cut them into triangles, the first near " +
        TextOf(points.row(mesh.Faces.Face(pairs[0].first)[0])) +
        " mm; start from an embedded surface, or switch {Guard} (of a refinement: {Check}) off");
  }
  RequireOutward(points, mesh.Triangles, name);
}

DeformableSurface MakeStartSurface(const GivenSurface& given, bool requireEmbedded,
  const ParallelFor& parallelFor)
{
  const std::string& name = given.Name;
  if (given.Points.rows() == 0)
  {
    throw Error(ErrorCode::InvalidMesh, name + " has no points; give one that has");
  }
  RequireValidFaces(given.Points, given.Faces, name);
  DeformableSurface surface;
  surface.Points = given.Points;
  surface.Mesh = NamingSurface(name,
    [&given] { return BuildContourMesh(static_cast<int>(given.Points.rows()), given.Faces); });
  if (requireEmbedded)
  {
    RequireEmbedded(surface.Mesh, FaceHulls(surface.Points, surface.Mesh.Faces), surface.Points,
      name, parallelFor);
  }
  return surface;
}

} // namespace FlipFree
