/**
 * The distances between the faces of a surface, for all ways to cut them (FaceHulls.h).
 */
#ifndef FlipFreeSurfaceGap_h
#define FlipFreeSurfaceGap_h

#include "Geometry/FaceHulls.h"

namespace FlipFree
{

/// The minimum distance (mm) of the hulls of two faces that share no vertex (of large faces, of
/// parts that share none: FaceHulls.h); infinite if there are none. Indices must be valid, and the
/// surface must not intersect itself.
double MeasureMinimumGap(const PointList& points, const FaceHulls& hulls,
  const ParallelFor& parallelFor = SerialFor);

/// The pairs (FaceHulls.h) whose distance is not proven to be at least `gap` (mm). `adjacent` are
/// the pairs of parts of adjacent faces, or of one (CandidatePairs.h). If the gap is well above
/// rounding errors, and there are no such pairs, the surface is embedded.
std::vector<HullPair> FindPairsNearerThan(double gap, const PointList& points,
  const FaceHulls& hulls, const std::vector<HullPair>& adjacent, const ParallelFor& parallelFor);

/// FindPairsNearerThan() for a surface of which only small parts move between one search and the
/// next: looks at pairs with a corner that has moved since, and remembers the others.
class NearPairSearch
{
public:
  /// Keeps references to `hulls` and `adjacent`.
  NearPairSearch(double gap, const FaceHulls& hulls, const std::vector<HullPair>& adjacent)
    : Gap(gap)
    , Hulls(hulls)
    , Adjacent(adjacent)
  {
  }

  /// The same pairs, in any order.
  const std::vector<HullPair>& Find(const PointList& points, const ParallelFor& parallelFor);

private:
  void Renew(const PointList& points, const std::vector<char>& moved,
    const ParallelFor& parallelFor);

  const double Gap;
  const FaceHulls& Hulls;
  const std::vector<HullPair>& Adjacent;
  PointList Points; // of the search before
  std::vector<HullPair> Near;
};

} // namespace FlipFree

#endif
