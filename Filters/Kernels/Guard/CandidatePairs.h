/**
 * The broad phase of the guard: which parts of a moving surface have to be tested against each
 * other.
 *
 * Claim: a surface whose faces do not overlap stays embedded, however they are cut, as long as each
 * pair of hulls that FaceHulls names stays apart. Pairs of faces without a common vertex are found
 * by a tree over boxes of motions. Pairs of parts of adjacent faces, or of a single one, are all
 * candidates. Proof: at each time, FaceHulls.h applies.
 */
#ifndef FlipFreeCandidatePairs_h
#define FlipFreeCandidatePairs_h

#include "Geometry/FaceHulls.h"
#include "Guard/MotionBox.h"

#include <functional>
#include <utility>
#include <vector>

namespace FlipFree
{

class CandidatePairs
{
public:
  CandidatePairs(int numberOfPoints, const FaceList& faces,
    const ParallelFor& parallelFor = SerialFor);

  const FaceHulls& Hulls() const { return this->HullsOfFaces; }

  /// Parts of adjacent faces, or of one.
  const std::vector<HullPair>& AdjacentPairs() const { return this->Adjacent; }

  /// FaceHulls::FindOverlappingFaces(): nothing keeps them apart.
  const std::vector<std::pair<int, int>>& OverlappingFaces() const { return this->Overlapping; }

  /// Calls visit(one, two) for the pairs of disjoint hulls that may come nearer to each other
  /// than `gap` during the motion and of which a vertex is marked as changed. `boxes` is the
  /// caller's cache from the last call; it is updated. `visit` is called from several threads.
  void VisitDisjointHulls(const Motion& motion, double gap, const std::vector<char>& changed,
    std::vector<MotionBox>& boxes,
    const std::function<void(const Hull& one, const Hull& two)>& visit,
    const ParallelFor& parallelFor) const;

private:
  void ListDisjoint(const PointList& layout, const FaceList& faces);
  void ListAdjacent(int numberOfPoints, const FaceList& faces);

  FaceHulls HullsOfFaces;
  std::vector<HullPair> Adjacent;
  std::vector<std::pair<int, int>> Overlapping;
  // The pairs of nodes that stand for the disjoint hulls, in both orders: the partners of a node
  // are Partners[FirstPartner[node]] to, not including, Partners[FirstPartner[node + 1]].
  std::vector<int> FirstPartner;
  std::vector<int> Partners;
};

} // namespace FlipFree

#endif
