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
  const bool isFineEnough = position.cwiseAbs().maxCoeff() / (1 << 24) < 1e-3 * edgeLength;
  return isFineEnough ? Eigen::RowVector3d(position.cast<float>().cast<double>()) : position;
}

} // namespace FlipFree

#endif
