/**
 * Refinement of a four-valent mesh into one of four times as many vertices, for working from coarse
 * to fine: the scheme of D. Doo and M. Sabin (Behavior of recursive division surfaces near
 * extraordinary points, 1978). Every corner of every face becomes a vertex, and each of these has
 * four neighbors again; the sphere of resolution n becomes that of 2 n.
 */
#ifndef FlipFreeMeshRefinement_h
#define FlipFreeMeshRefinement_h

#include "Mesh/ContourMesh.h"

namespace FlipFree
{

struct RefinedMesh
{
  FaceList Faces;
  /// Per new vertex: the old vertex it came from.
  std::vector<int> Parents;
};

/// The faces of the refined mesh. Vertex c of it is corner c of the old connectivity list.
RefinedMesh RefineFaces(const ContourMesh& mesh);

/// The points of the refined mesh. A `reach` of 1 gives those of Doo and Sabin; smaller values, one
/// per old vertex, pull them towards their parents, and from the places of Doo and Sabin, which lie
/// above or below the old triangles, into these. For small values the new surface is the old one
/// with its edges bevelled a little.
PointList RefinePoints(const ContourMesh& mesh, const PointList& points,
  const Eigen::VectorXd& reach);
PointList RefinePoints(const ContourMesh& mesh, const PointList& points, double reach);

} // namespace FlipFree

#endif
