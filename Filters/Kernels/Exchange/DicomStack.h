/**
 * Frames that lie one behind the other: the grid that they make up, with a third axis that leans
 * where the gantry was tilted, and how they stray from an even stack.
 */
#ifndef FlipFreeDicomStack_h
#define FlipFreeDicomStack_h

#include "Exchange/DicomFrame.h"

#include "KernelTypes.h"

#include <functional>
#include <string>
#include <vector>

namespace FlipFree
{

/// What a message calls a frame.
using DicomFrameName = std::function<std::string(const DicomFrame&)>;

struct DicomStack
{
  ImageGeometry Geometry;
  /// Whole sentences; empty where there is nothing to say. With a problem, the frames are no
  /// volume.
  std::string Problem;
  std::string Warning;
  bool HasGap = false; ///< which is the problem: a slice may be missing
};

/// Orders frames of one grid along their normal, in the sense that makes the axes right-handed.
void SortAlongNormal(std::vector<DicomFrame>& frames);

/// How many frames lie at the place where most do; of ordered frames.
std::size_t GreatestRepetition(const std::vector<DicomFrame>& frames);

/// Whether two frames are at one place along the normal.
bool AreAtOnePlace(const DicomFrame& a, const DicomFrame& b);

/// The volume that ordered frames make up. From 1 % of the slice spacing on, a deviation is a
/// warning, and from half of it on a problem; so are gaps, wherever they are.
DicomStack StackOf(const std::vector<DicomFrame>& frames, const DicomFrameName& nameOf);

} // namespace FlipFree

#endif
