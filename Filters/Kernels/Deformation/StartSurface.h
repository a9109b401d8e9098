/**
 * The surface from which a segmentation starts: a sphere, or a surface that the user provides.
 */
#ifndef FlipFreeStartSurface_h
#define FlipFreeStartSurface_h

#include "Error.h"
#include "Geometry/FaceHulls.h"
#include "Mesh/ContourMesh.h"

#include <string>

namespace FlipFree
{

struct DeformableSurface
{
  ContourMesh Mesh;
  PointList Points;
};

/// A surface as somebody gives it.
struct GivenSurface
{
  std::string Name; ///< in messages
  PointList Points;
  FaceList Faces;
};

/// A quad sphere with n vertices along an edge of a side.
DeformableSurface MakeStartSphere(int n, const Eigen::Vector3d& center, double radius);

/// Returns make(). Errors of kernels get `name` in front.
template <typename Make>
auto NamingSurface(const std::string& name, const Make& make)
{
  try
  {
    return make();
  }
  catch (const Error& error)
  {
    throw Error(error.GetCode(), name + ": " + error.GetText());
  }
}

/// Throws Error, naming the surface by `name`, when it intersects itself or is inside out. `hulls`
/// are those of the mesh's faces.
void RequireEmbedded(const ContourMesh& mesh, const FaceHulls& hulls, const PointList& points,
  const std::string& name, const ParallelFor& parallelFor);

/// The surface itself if every vertex has four neighbors, and else its midpoint mesh
/// (Mesh/MidpointMesh.h), relaxed where faces around a vertex are not convex, since the surface has
/// to be embedded for any cut; where corners that it cuts off meet others, of the surface with each
/// triangle cut into four. Points that no face uses are left out. Throws Error, naming the surface,
/// when it has no points, is not a closed and consistently oriented 2-manifold, or, if asked, is
/// not embedded.
DeformableSurface MakeStartSurface(const GivenSurface& given, bool requireEmbedded,
  const ParallelFor& parallelFor);

/// A surface that stays as it is, whatever the neighbors of its vertices: its mesh is one at rest
/// (BuildMeshAtRest). Throws Error, naming the surface, when it has no points, is not closed and
/// consistently oriented, or is not embedded.
DeformableSurface MakeFixedSurface(const GivenSurface& given, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
