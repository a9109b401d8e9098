#include "Guard/SinglePrecision.h"

namespace FlipFree
{

// Compiled without contraction of products and sums, which would undo the splitting.
Eigen::RowVector3d RoundToSingle(const Eigen::RowVector3d& position, double edgeLength)
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
