/**
 * Doo-Sabin refinement of a four-valent mesh into one of four times as many vertices (D. Doo and
 * M. Sabin, Behaviour of recursive division surfaces near extraordinary points, 1978). Every corner
 * of every face becomes a vertex, which again has four neighbors; the sphere of resolution n
 * becomes that of 2 n.
 *
 * No two refined faces overlap (Geometry/FaceHulls.h), even if old ones do. Proof: a refined face
 * is that of an old face, vertex or edge. Those of two faces share nothing, nor do those of two
 * vertices; those of a face and a vertex share at most the corners that the face has there, and
 * each of them is one refined vertex. That of an edge shares two neighbors with those of its ends
 * and of its faces. Those of two edges share a refined vertex if the edges follow each other around
 * a face; they do so only once, as no two edges have the same ends.
 */
#ifndef FlipFreeMeshRefinement_h
#define FlipFreeMeshRefinement_h

#include "Mesh/ContourMesh.h"

namespace FlipFree
{

struct RefinedMesh
{
  FaceList Faces;
  /// Per new vertex: the old vertex from which it originates.
  std::vector<int> Parents;
};

/// The faces of the refined mesh. Vertex c of it is corner c of the old connectivity list.
RefinedMesh RefineFaces(const ContourMesh& mesh);

/// The points of the refined mesh. A `reach` of 1 gives Doo-Sabin points, which lie above or below
/// the old triangles. Smaller values, one per old vertex, pull them to their parents and into the
/// old triangles. For small values the new surface is the old one with its edges slightly beveled.
PointList RefinePoints(const ContourMesh& mesh, const PointList& points,
  const Eigen::VectorXd& reach);
PointList RefinePoints(const ContourMesh& mesh, const PointList& points, double reach);

} // namespace FlipFree

#endif
