// The sides of a minimum cut as a vector, for comparisons.
#ifndef SourceSide_h
#define SourceSide_h

#include "Image/MinimumCut.h"

#include <utility>
#include <vector>

namespace FlipFree
{

/// For each node, 1 if it is on the source's side. Empty if the monitor stopped the cut.
inline std::vector<unsigned char> SourceSide(CutNetwork network, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  MinimumCut cut(std::move(network));
  std::vector<unsigned char> side;
  if (cut.Execute(parallelFor, monitor))
  {
    for (int node = 0; node < cut.NumberOfNodes(); ++node)
    {
      side.push_back(cut.IsOnSourceSide(node) ? 1 : 0);
    }
  }
  return side;
}

} // namespace FlipFree

#endif
