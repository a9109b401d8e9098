/**
 * The network of blocks of voxels whose minimum cut follows the edges of the image.
 */
#ifndef FlipFreeBlockNetwork_h
#define FlipFreeBlockNetwork_h

#include "Image/BlockGrid.h"
#include "Image/BlockNodes.h"
#include "Image/ImagePart.h"
#include "Image/MinimumCut.h"

#include <functional>

namespace FlipFree
{

/// The blocks' mean gray values, slightly smoothed, in which edges are looked for.
std::vector<float> SmoothBlockMeans(const ImagePart& image, const BlockGrid& grid,
  const ParallelFor& parallelFor);

struct BlockLinks
{
  double PerArea = 1;      ///< what a cut costs, per mm2, where there is no edge
  double EdgeContrast = 1; ///< the difference of gray values that makes an edge
};

/// What a capacity of 1 costs.
double CapacityUnit(const ImageGeometry& blocks, const BlockLinks& links);

/// `unary` is what a block's being on the source's side is worth, per mm3; `side` says for a block
/// that is no node on which side it is: 1 with the source, -1 with the sink. Both are asked in
/// parallel.
CutNetwork MakeBlockNetwork(const ImageGeometry& blocks, const BlockNodes& nodes,
  const std::vector<float>& smooth, const BlockLinks& links,
  const std::function<double(std::size_t block)>& unary,
  const std::function<double(std::size_t block)>& side, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
