/**
 * The broad phase of the guard: which parts of a moving surface have to be tested against each
 * other.
 *
 * Claim: a closed surface that is embedded at the start stays embedded as long as every vertex
 * keeps a positive distance to every triangle without it, and every edge to every edge without a
 * common vertex. Closed means that each edge belongs to exactly two triangles, which differ in
 * their third vertex.
 *
 * Proof. Let two different points of the surface coincide in space: two convex combinations of
 * vertices, with equal sums. Taking away from both what they have in common at shared vertices
 * leaves, after scaling, two coinciding points of simplices without a common vertex. So the surface
 * is embedded exactly while all pairs of vertex-disjoint simplices (faces of its triangles) are
 * apart. As long as two of these are apart, their distance is that of a vertex to the other simplex
 * or of two edges; there are finitely many such pairs, so at the first contact the distance of one
 * of them tends to zero. Hence the first contact is one of a vertex and a triangle or of two edges,
 * and it is excluded by assumption. (A vertex against the opposite edge of its own triangle is
 * covered by the vertex against the other triangle of that edge.)
 *
 * A pair of features that belongs to a pair of disjoint triangles, triangles without a common
 * vertex, is covered when these stay apart. All others are listed one by one.
 */
#ifndef FlipFreeCandidatePairs_h
#define FlipFreeCandidatePairs_h

#include "Geometry/TriangleTree.h"
#include "Guard/MotionBox.h"

namespace FlipFree
{

struct VertexFacePair
{
  std::array<int, 1> Vertex;
  std::array<int, 3> Face;
};

struct EdgeEdgePair
{
  std::array<int, 2> One;
  std::array<int, 2> Two;
};

class CandidatePairs
{
public:
  CandidatePairs(int numberOfPoints, const TriangleList& triangles);

  /// The features without a common vertex that are in no pair of disjoint triangles.
  const std::vector<VertexFacePair>& VertexFacePairs() const { return this->VertexFaces; }
  const std::vector<EdgeEdgePair>& EdgeEdgePairs() const { return this->EdgeEdges; }

  /// Calls visit(one, two) for the pairs of disjoint triangles that may come nearer to each other
  /// than `gap` during the motion and of which a vertex is marked as changed. `boxes` is the
  /// caller's cache from the last call; it is updated. `visit` is called from several threads.
  void VisitDisjointTriangles(const Motion& motion, double gap, const std::vector<char>& changed,
    std::vector<MotionBox>& boxes, const std::function<void(int one, int two)>& visit,
    const ParallelFor& parallelFor) const;

  /// The tree over the triangles.
  const TriangleTree& Tree() const { return this->TreeOfTriangles; }

private:
  void ListDisjointTriangles();
  void ListUncoveredPairs(int numberOfPoints);

  TriangleList Triangles;
  PointList Layout;
  TriangleTree TreeOfTriangles;
  // The pairs of nodes that stand for the disjoint triangles, in both orders: the partners of a
  // node are Partners[FirstPartner[node]] to, not including, Partners[FirstPartner[node + 1]].
  std::vector<int> FirstPartner;
  std::vector<int> Partners;
  std::vector<VertexFacePair> VertexFaces;
  std::vector<EdgeEdgePair> EdgeEdges;
};

} // namespace FlipFree

#endif
