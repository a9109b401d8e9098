/**
 * Progress from the kernels to Python, and the wish to stop back.
 */
#ifndef FlipFreeReport_h
#define FlipFreeReport_h

#include "KernelTypes.h"

#include <nanobind/nanobind.h>

namespace FlipFree
{

/// A Monitor for work without Python's lock, by a function that takes the fraction done and returns
/// whether to go on. It catches what its own parts raise, and Ctrl-C with it.
inline Monitor MonitorOf(nanobind::handle report, double first = 0, double last = 1)
{
  return [report, first, last](double fraction)
  {
    const nanobind::gil_scoped_acquire locked;
    return nanobind::cast<bool>(report(first + fraction * (last - first)));
  };
}

} // namespace FlipFree

#endif
