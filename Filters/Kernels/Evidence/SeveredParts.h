/**
 * The parts that a cut severs from an organ, and what the image shows along the cut: whether it
 * follows an edge, and whether the gray values on its two sides differ. A part whose gray values go
 * on unchanged across a cut without an edge is the organ's own (its left lobe, behind a neck); a
 * neighbor differs, by a few Hounsfield units at least.
 */
#ifndef FlipFreeSeveredParts_h
#define FlipFreeSeveredParts_h

#include "Image/BlockNetwork.h"

#include <functional>
#include <optional>
#include <vector>

namespace FlipFree
{

struct SeveredPart
{
  std::vector<std::size_t> Blocks;
  double Volume = 0; ///< mm3
  double Area = 0;   ///< of the cut, without the organ's blurred rim, mm2; may be zero
  double Edge = 0;   ///< 0 without an edge along the cut, up to 1
  /// Mean gray value of the part less that of the rest, 2 to 8 mm from the blocks at the cut, from
  /// face to face, and without the rim.
  double Step = 0;
  int Samples = 0; ///< blocks on the side that has fewer of them
};

/// Evidence, in CT, that a severed part is a neighbor of the organ: it is one from 1 on. It grows
/// with the squares of step and edge. There is none of a part without samples, or without a cut
/// outside the rim.
std::optional<double> EvidenceOfNeighbor(const SeveredPart& part);

/// The connected parts of the nodes that are not kept. `smooth` are the blocks' gray values
/// (SmoothBlockMeans()).
std::vector<SeveredPart> FindSeveredParts(const ImageGeometry& blocks, const BlockNodes& nodes,
  const std::vector<float>& smooth, const std::vector<float>& squaredDepth, double edgeContrast,
  const std::function<bool(std::size_t block)>& isKept);

} // namespace FlipFree

#endif
