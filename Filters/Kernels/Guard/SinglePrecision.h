/**
 * Positions that files of single precision hold exactly. What the guard certifies is then what is
 * written.
 */
#ifndef FlipFreeSinglePrecision_h
#define FlipFreeSinglePrecision_h

#include "KernelTypes.h"

namespace FlipFree
{

/// The rounded position, if that is at most a thousandth of the mean edge length (mm) away, and
/// else, where single precision is too coarse for the surface, the position itself.
inline Eigen::RowVector3d RoundToSingle(const Eigen::RowVector3d& position, double edgeLength)
{
  if (!(position.cwiseAbs().maxCoeff() / (1 << 24) < 1e-3 * edgeLength))
  {
    return position;
  }
  // Veltkamp's splitting leaves the upper 24 of 53 bits. A cast to float and back would do the
  // same, but GCC 12.2 drops it where it has vectorized what surrounds it.
  constexpr double Splitter = (1 << 29) + 1;
  const Eigen::RowVector3d scaled = Splitter * position;
  return scaled - (scaled - position);
}

} // namespace FlipFree

#endif
