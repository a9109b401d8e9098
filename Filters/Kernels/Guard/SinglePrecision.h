/**
 * Positions that files of single precision hold exactly (numbers below 1e-38 aside). What the guard
 * certifies is then what is written.
 */
#ifndef FlipFreeSinglePrecision_h
#define FlipFreeSinglePrecision_h

#include "KernelTypes.h"

namespace FlipFree
{

/// The rounded position, if that is at most a thousandth of the typical edge length (mm) away along
/// each axis, and else, where single precision is too coarse for the surface, the position itself.
Eigen::RowVector3d RoundToSingle(const Eigen::RowVector3d& position, double edgeLength);

} // namespace FlipFree

#endif
