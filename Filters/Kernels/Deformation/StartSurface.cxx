#include "Deformation/StartSurface.h"

#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/MidpointMesh.h"
#include "Mesh/QuadSphere.h"
#include "Mesh/SurfaceTopology.h"
#include "MessageText.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace FlipFree
{
namespace
{

// Each cuts corners off at half the distance, and takes four times as many vertices.
constexpr int MaximumSplits = 2;

// Of the vertices around faces that are not convex; one is usually enough.
constexpr int MaximumRelaxations = 8;

PolygonMesh PolygonsOf(const GivenSurface& given)
{
  if (given.Points.rows() == 0)
  {
    throw Error(ErrorCode::InvalidMesh, given.Name + " has no points; give one that has");
  }
  RequireValidFaces(given.Points, given.Faces, given.Name);
  return WithoutUnusedPoints({ given.Points, given.Faces });
}

// Whether each vertex is a corner of four faces.
bool IsFourValent(const PolygonMesh& mesh)
{
  std::vector<int> corners(mesh.Points.rows(), 0);
  for (const int vertex : mesh.Faces.Connectivity)
  {
    ++corners[vertex];
  }
  return std::all_of(corners.begin(), corners.end(), [](int count) { return count == 4; });
}

DeformableSurface FourValentSurface(PolygonMesh mesh, const std::string& name)
{
  const auto size = static_cast<int>(mesh.Points.rows());
  return { NamingSurface(name, [&] { return BuildContourMesh(size, mesh.Faces); }),
    std::move(mesh.Points) };
}

DeformableSurface SurfaceAtRest(const PolygonMesh& mesh)
{
  return { BuildMeshAtRest(static_cast<int>(mesh.Points.rows()), mesh.Faces), mesh.Points };
}

void RequireEmbedded(const DeformableSurface& surface, const std::string& name,
  const ParallelFor& parallelFor)
{
  RequireEmbedded(surface.Mesh, FaceHulls(surface.Points, surface.Mesh.Faces), surface.Points, name,
    parallelFor);
}

DeformableSurface Midpoints(const PolygonMesh& mesh, const std::string& name)
{
  return FourValentSurface(MakeMidpointMesh(mesh, name), name);
}

bool HaveCommonVertex(const FaceList& faces, int one, int two)
{
  const int* const begin = faces.Face(one);
  const int* const end = begin + faces.FaceSize(one);
  return std::find_first_of(begin, end, faces.Face(two), faces.Face(two) + faces.FaceSize(two)) !=
    end;
}

// Where some cut of a face around a vertex meets its neighbors, as it does if the face is not
// convex: moves the vertices there halfway to the mean of their neighbors, again and again. False
// if that does not help, or if other parts of the surface meet, which could pass each other.
bool RelaxUntilEmbedded(DeformableSurface& surface, const ParallelFor& parallelFor)
{
  const FaceList& faces = surface.Mesh.Faces;
  const FaceHulls hulls(surface.Points, faces);
  std::set<int> involved;
  for (int relaxation = 0; relaxation <= MaximumRelaxations; ++relaxation)
  {
    const auto pairs = FindSelfIntersections(surface.Points, hulls, parallelFor);
    if (pairs.empty())
    {
      return true;
    }
    for (const auto& [one, two] : pairs)
    {
      if (!HaveCommonVertex(faces, one, two))
      {
        return false;
      }
      involved.insert(faces.Face(one), faces.Face(one) + faces.FaceSize(one));
      involved.insert(faces.Face(two), faces.Face(two) + faces.FaceSize(two));
    }
    const PointList before = surface.Points;
    for (const int vertex : involved)
    {
      surface.Points.row(vertex) *= 0.5;
      for (const int neighbor : surface.Mesh.Neighbors[vertex])
      {
        surface.Points.row(vertex) += 0.125 * before.row(neighbor);
      }
    }
  }
  return false;
}

// Where relaxation does not help since corners that are cut off meet others, they are cut off
// nearer to their ends.
DeformableSurface EmbeddedMidpoints(PolygonMesh mesh, const std::string& name,
  const ParallelFor& parallelFor)
{
  DeformableSurface surface = Midpoints(mesh, name); // refuses what is no 2-manifold
  RequireEmbedded(SurfaceAtRest(mesh), name, parallelFor);
  for (int split = 0; !RelaxUntilEmbedded(surface, parallelFor); ++split)
  {
    if (split == MaximumSplits)
    {
      throw Error(ErrorCode::SelfIntersecting,
        name +
          " has corners so sharp that the mesh of the midpoints of its edges intersects "
          "itself; refine it there, or give a mesh with four neighbors at every vertex");
    }
    mesh = SplitTriangles(mesh);
    surface = Midpoints(mesh, name);
  }
  RequireOutward(surface.Points, surface.Mesh.Triangles, name);
  return surface;
}

} // namespace

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
    const auto overlapping = hulls.FindOverlappingFaces();
    if (!overlapping.empty())
    {
      throw Error(ErrorCode::InvalidMesh,
        "of " + name + ", " + NameOfOverlap(overlapping[0]) + ", near " +
          TextOf(points.row(mesh.Faces.Face(overlapping[0].first)[0])) +
          " mm; cut one of them along another diagonal, or refine the surface there");
    }
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
  PolygonMesh mesh = PolygonsOf(given);
  if (!IsFourValent(mesh))
  {
    return requireEmbedded ? EmbeddedMidpoints(std::move(mesh), given.Name, parallelFor)
                           : Midpoints(mesh, given.Name);
  }
  DeformableSurface surface = FourValentSurface(std::move(mesh), given.Name);
  if (requireEmbedded)
  {
    RequireEmbedded(surface, given.Name, parallelFor);
  }
  return surface;
}

DeformableSurface MakeFixedSurface(const GivenSurface& given, const ParallelFor& parallelFor)
{
  const PolygonMesh mesh = PolygonsOf(given);
  RequireManifoldEdges(mesh.Faces, CollectEdges(static_cast<int>(mesh.Points.rows()), mesh.Faces),
    given.Name);
  DeformableSurface surface = SurfaceAtRest(mesh);
  RequireEmbedded(surface, given.Name, parallelFor);
  return surface;
}

} // namespace FlipFree
