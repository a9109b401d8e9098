#include "Guard/SinglePrecision.h"

namespace FlipFree
{

// Compiled without contraction of products and sums, which would undo the splitting.
Eigen::RowVector3d RoundToSingle(const Eigen::RowVector3d& position, double edgeLength)
{
  // Rounding to 24 bits moves a coordinate x by at most 2^-24 |x|.
  if (!(position.cwiseAbs().maxCoeff() / (1 << 24) < 1e-3 * edgeLength))
  {
    return position;
  }
  // Veltkamp's splitting by 2^s + 1 rounds to the nearest number of 53 - s bits, here 24; ties may
  // go either way (S. Boldo, "Pitfalls of a full floating-point proof", 2006). It does not overflow
  // below 1e299. A cast to float and back would do the same, but GCC 12.2 drops it where it has
  // vectorized what surrounds it.
  constexpr double Splitter = (1 << 29) + 1;
  const Eigen::RowVector3d scaled = Splitter * position;
  return scaled - (scaled - position);
}

} // namespace FlipFree
