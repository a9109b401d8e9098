/**
 * Positions that files of single precision hold exactly. What the guard certifies is then what is
 * written.
 */
#ifndef FlipFreeSinglePrecision_h
#define FlipFreeSinglePrecision_h

#include "KernelTypes.h"

namespace FlipFree
{

/// The rounded position.
template <typename Position>
Eigen::RowVector3d RoundToSingle(const Position& position)
{
  return position.template cast<float>().template cast<double>();
}

/// Whether rounding moves positions up to this coordinate by less than a thousandth of the edge
/// length (both mm). Beyond that, the numbers are too coarse for the surface.
inline bool IsSinglePrecisionEnough(double maximumCoordinate, double edgeLength)
{
  return maximumCoordinate / (1 << 24) < 1e-3 * edgeLength;
}

} // namespace FlipFree

#endif
