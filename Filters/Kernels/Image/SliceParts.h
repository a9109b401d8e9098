/**
 * Threads, and passes over the slices of an image that can be stopped in between.
 */
#ifndef FlipFreeSliceParts_h
#define FlipFreeSliceParts_h

#include "KernelTypes.h"

#include <algorithm>

namespace FlipFree
{

/// How work is shared among threads. Results depend on neither.
struct Threading
{
  ParallelFor For = SerialFor;
  int Number = 1; ///< of the threads that For has
};

/// Runs body(first, last) over parts of the slices [begin, end) of an image, a few slices at a
/// time: some ten milliseconds of work that is done once for each voxel. The monitor is asked
/// before each time. Returns false if it stopped it.
inline bool ForSlices(const Threading& threading, std::ptrdiff_t begin, std::ptrdiff_t end,
  std::ptrdiff_t voxelsOfSlice, const Monitor& monitor, const RangeBody& body)
{
  constexpr std::ptrdiff_t voxelsAtOnce = 1 << 22;
  const std::ptrdiff_t atOnce = std::max<std::ptrdiff_t>(threading.Number,
    voxelsAtOnce / std::max<std::ptrdiff_t>(1, voxelsOfSlice));
  for (std::ptrdiff_t first = begin; first < end; first += atOnce)
  {
    if (!monitor(static_cast<double>(first - begin) / static_cast<double>(end - begin)))
    {
      return false;
    }
    threading.For(first, std::min(end, first + atOnce), body);
  }
  return true;
}

} // namespace FlipFree

#endif
