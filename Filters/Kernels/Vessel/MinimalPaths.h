/**
 * The tree of fastest paths that joins points: first the two that are closest to each other in
 * travel time, then repeatedly the next one to the tree so far.
 */
#ifndef FlipFreeMinimalPaths_h
#define FlipFreeMinimalPaths_h

#include "Image/SeedRegion.h"

#include <string>
#include <vector>

namespace FlipFree
{

struct MinimalPath
{
  PointList
    Line; ///< from the point, or place on an earlier path, where it begins, to another point
  int Parent = -1;           ///< the earlier path on which it begins; none for the first
  Eigen::Index Junction = 0; ///< the place on the parent's line
};

/// A point on the way, at whose end a path would begin anew, prolongs the path: within `prolong`
/// millimeters of an end, a path goes on rather than branches off. Throws Error if a point cannot
/// be reached, named as in `names`; no paths if the monitor stops it.
std::vector<MinimalPath> JoinPoints(const ImageView<float>& speed, const PointList& points,
  const PointList& names, double prolong, const Monitor& monitor);

} // namespace FlipFree

#endif
