/**
 * The topology of a polygonal surface, manifold or not: whether it is closed and consistently
 * oriented, and its Euler number.
 */
#ifndef FlipFreeSurfaceTopology_h
#define FlipFreeSurfaceTopology_h

#include "Mesh/ContourMesh.h"

#include <string>
#include <vector>

namespace FlipFree
{

struct SurfaceEdge
{
  int Lower = 0; ///< its vertices
  int Higher = 0;
  int Forward = 0;  ///< number of faces that traverse it from its lower to its higher vertex
  int Backward = 0; ///< and in the opposite direction
  std::array<int, 2> Faces{ { -1, -1 } }; ///< the first two of these faces
};

struct SurfaceTopology
{
  int Vertices = 0; ///< only those that a face uses
  int Edges = 0;
  int Faces = 0;
  int BoundaryEdges = 0;    ///< on one face only
  int NonManifoldEdges = 0; ///< on three faces or more
  int MisorientedEdges = 0; ///< on two faces that traverse it in the same direction

  /// V - E + F; 2 for a sphere.
  int EulerNumber() const { return this->Vertices - this->Edges + this->Faces; }
};

FaceList FacesOf(const TriangleList& triangles);

/// Every edge once, ordered by its lower vertex and then by its higher one. A vertex repeated
/// within a face makes no edge. The faces must be valid (RequireValidFaces).
std::vector<SurfaceEdge> CollectEdges(int numberOfPoints, const FaceList& faces);

/// Counts, given CollectEdges of the same faces.
SurfaceTopology MeasureTopology(const FaceList& faces, const std::vector<SurfaceEdge>& edges);

/// Throws Error, naming the surface by `name`, when it has no polygon, a polygon has fewer than
/// three vertices, names a point that does not exist, or a point that is not finite.
void RequireValidFaces(const Eigen::Ref<const PointList>& points, const FaceList& faces,
  const std::string& name);

/// Throws Error, naming the first bad edge, unless every edge is traversed equally often in both
/// directions: then the surface is the boundary of a volume.
void RequireClosed(int numberOfPoints, const TriangleList& triangles, const std::string& name);

/// Throws Error, naming the first bad edge, unless every edge is on two faces, which traverse it in
/// opposite directions. `edges` are those of CollectEdges, of valid faces.
void RequireManifoldEdges(const FaceList& faces, const std::vector<SurfaceEdge>& edges,
  const std::string& name);

/// What a closed surface holds, in the cube of its unit: the sum of the signed tetrahedra between
/// the triangles and a point. Negative where the surface is inside out.
double EnclosedVolume(const Eigen::Ref<const PointList>& points, const TriangleList& triangles);

/// Throws Error when a closed surface is inside out, its faces clockwise seen from outside.
void RequireOutward(const PointList& points, const TriangleList& triangles,
  const std::string& name);

} // namespace FlipFree

#endif
