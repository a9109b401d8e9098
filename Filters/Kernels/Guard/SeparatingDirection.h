/**
 * A quick sufficient test of whether two hulls stay apart while they move: some directions are
 * tried, four at once in single precision. It makes the motion test unnecessary for nearly all
 * pairs.
 */
#ifndef FlipFreeSeparatingDirection_h
#define FlipFreeSeparatingDirection_h

#include "Guard/MotionTest.h"

#include <vector>

namespace FlipFree
{

/// A motion in single precision. The origin matters for rounding only: it should be near the
/// points.
struct SinglePrecisionMotion
{
  SinglePrecisionMotion(Eigen::Index count, const Eigen::Vector3d& origin);

  /// Takes this vertex from the motion.
  void Update(const Motion& motion, int vertex);

  // Three coordinates, and the greatest of their absolute values.
  std::vector<Eigen::Array4f> Ends[2];
  Eigen::Vector3d Origin;
};

/// True if a direction was found along which the hulls are separated by more than `gap` at the
/// start and at the end of the motion, and so throughout (MotionTest.h).
bool HaveSeparatingDirection(const SinglePrecisionMotion& motion, const Hull& one, const Hull& two,
  double gap);

} // namespace FlipFree

#endif
