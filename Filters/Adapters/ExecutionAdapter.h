/**
 * Private to the modules, never installed: threading, progress and abort, as kernels know them.
 * This is the one place that bridges the differences between VTK versions.
 */
#ifndef FlipFreeExecutionAdapter_h
#define FlipFreeExecutionAdapter_h

#include "KernelTypes.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"
#include "vtkVersionMacros.h"

#include <algorithm>

namespace FlipFree
{

/// ParallelFor by VTK's threads.
inline void SMPFor(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
{
  vtkSMPTools::For(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end),
    [&body](vtkIdType first, vtkIdType last) { body(first, last); });
}

/// How many threads SMPFor has.
inline int NumberOfThreads()
{
  return vtkSMPTools::GetEstimatedNumberOfThreads();
}

/// Runs body(first, last) over parts of the slices [begin, end) of an image by VTK's threads, a few
/// slices at a time: some ten milliseconds of work that is done once for each voxel. The monitor is
/// asked before each time. Returns false if it stopped it.
inline bool SMPForSlices(std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t voxelsOfSlice,
  const Monitor& monitor, const RangeBody& body)
{
  constexpr std::ptrdiff_t voxelsAtOnce = 1 << 22;
  const std::ptrdiff_t atOnce = std::max<std::ptrdiff_t>(NumberOfThreads(),
    voxelsAtOnce / std::max<std::ptrdiff_t>(1, voxelsOfSlice));
  for (std::ptrdiff_t first = begin; first < end; first += atOnce)
  {
    if (!monitor(static_cast<double>(first - begin) / static_cast<double>(end - begin)))
    {
      return false;
    }
    SMPFor(first, std::min(end, first + atOnce), body);
  }
  return true;
}

inline bool IsAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220827)
  return algorithm->CheckAbort();
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

/// A Monitor that maps a kernel's progress to the part [first, last] of the filter's own.
inline Monitor MonitorOf(vtkAlgorithm* algorithm, double first = 0, double last = 1)
{
  return [=](double fraction)
  {
    algorithm->UpdateProgress(first + fraction * (last - first));
    return !IsAborted(algorithm);
  };
}

} // namespace FlipFree

#endif
