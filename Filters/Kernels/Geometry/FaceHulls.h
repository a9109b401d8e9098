/**
 * Which parts of a surface must stay apart for it to be embedded, however its faces are cut into
 * triangles.
 *
 * A quad in space has no surface until it is cut, and every writer, reader and renderer cuts it in
 * its own way. So all cuts along diagonals are considered at once.
 *
 * Claim: whatever the cuts, two triangles of the surface meet only in the vertex or edge that they
 * share, and no edge belongs to more than two, if no two faces overlap and the convex hulls of
 * these pairs of vertex sets are apart:
 *   (a) two faces without a common vertex;
 *   (b) for two faces F and G with the common vertices S, and each subset P of S, F without S but
 *       with P, and G without P;
 *   (c) within one face, sets of corners that have none in common and do not cross (around the
 *       face, all of one come before all of the other): in a triangle, one corner and the other
 *       two; in a larger face, one and three, two and two, two and three corners.
 * Two faces overlap, wherever their vertices lie, if they share three vertices, and so a triangle,
 * or two that are neighbors in one of them at most: along these, both can be cut, or one of them
 * where the other has an edge. That edge would belong to three triangles or four.
 *
 * Proof. Let a point of two triangles T and U not lie in the hull of their common vertices. It is a
 * convex combination of the vertices of T, and another of those of U. Taking away from both what
 * they have in common at common vertices leaves, after scaling, a point common to the hulls of A,
 * of vertices of T, and B, of vertices of U, which have no vertex in common. If T and U belong to
 * faces F and G without a common vertex, that is excluded by (a). If these are adjacent, let P be
 * the vertices of S in A: A is part of F without S but with P, and B of G without P, which (b)
 * excludes. If T and U are triangles of one cut of one face, A and B do not cross. If one of
 * them is a single corner, or both are two, or one is two and the other three, (c) lists them or
 * sets that contain them. If both are three, an edge of one meets the other: two and three.
 *
 * By (a) and (b), the hulls of two faces meet only in the hull of their common vertices. Any two
 * patches in the hulls of different faces, such as bilinear ones, therefore meet only there.
 *
 * A face of more than eight corners has too many cuts. It stands for the triangles of its fan, as
 * Triangulate makes it.
 */
#ifndef FlipFreeFaceHulls_h
#define FlipFreeFaceHulls_h

#include "Geometry/AdjacentParts.h"
#include "Geometry/TriangleTree.h"

namespace FlipFree
{

class FaceHulls
{
public:
  /// Of no faces.
  FaceHulls() = default;

  /// The tree over the faces is built with `layout`, as TriangleTree says. The faces must have
  /// valid indices and three corners or more.
  FaceHulls(const PointList& layout, const FaceList& faces);

  int NumberOfHulls() const { return static_cast<int>(this->Hulls.rows()); }
  Hull HullAt(int index) const
  {
    const int* const v = this->Hulls.row(index).data();
    return { { v[0], v[1], v[2], v[3] } };
  }
  int FaceOf(int hull) const { return this->Faces[hull]; }

  /// The tree over the hulls: one for a face of at most four corners, some that cover it for a
  /// larger one. Those without a common vertex are the pairs (a), and, of larger faces, some of
  /// (b).
  const TriangleTree& Tree() const { return this->TreeOfHulls; }
  std::vector<TriangleBox> RefitBoxes(const PointList& points) const
  {
    return this->TreeOfHulls.RefitBoxes(points, this->Hulls);
  }
  bool AreDisjoint(int one, int two) const;

  /// Nodes of the tree that stand for the pairs (a), see TriangleTree::DisjointPairs.
  std::vector<TriangleTree::NodePair> DisjointPairs(const PointList& layout) const
  {
    return this->TreeOfHulls.DisjointPairs(layout, this->Hulls);
  }

  /// Calls visit(pairs) with block after block of the pairs (b) and (c). A pair is covered if its
  /// sets also lie in those of another pair, which is tested anyway: it can only add names of
  /// faces. `covered` selects such pairs, or else the others. Returns the pairs of faces that
  /// overlap, which are in no pair (b).
  std::vector<std::pair<int, int>> VisitAdjacentPairs(bool covered,
    const HullPairVisitor& visit) const;

  /// Those pairs of faces alone.
  std::vector<std::pair<int, int>> FindOverlappingFaces() const;

private:
  using HullList = Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>;

  int NumberOfPoints = 0;
  FaceList Polygons;
  HullList Hulls;
  std::vector<int> Faces;
  TriangleTree TreeOfHulls;
};

/// The pairs for which accept(pair) holds; it is called from several threads at once.
template <typename Accept>
std::vector<HullPair> Select(const std::vector<HullPair>& pairs, const Accept& accept,
  const ParallelFor& parallelFor)
{
  std::vector<char> isAccepted(pairs.size(), 0);
  parallelFor(0, static_cast<std::ptrdiff_t>(pairs.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        isAccepted[index] = accept(pairs[index]) ? 1 : 0;
      }
    });
  std::vector<HullPair> accepted;
  for (std::size_t index = 0; index < pairs.size(); ++index)
  {
    if (isAccepted[index] != 0)
    {
      accepted.push_back(pairs[index]);
    }
  }
  return accepted;
}

} // namespace FlipFree

#endif
