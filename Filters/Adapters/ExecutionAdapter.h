/**
 * Private to the modules, never installed: threading, progress and abort, as kernels know them.
 * This is the one place that bridges the differences between VTK versions.
 */
#ifndef FlipFreeExecutionAdapter_h
#define FlipFreeExecutionAdapter_h

#include "Image/SliceParts.h"
#include "KernelTypes.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"
#include "vtkVersionMacros.h"

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

inline Threading SMPThreading()
{
  return { SMPFor, NumberOfThreads() };
}

/// ForSlices() by VTK's threads.
inline bool SMPForSlices(std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t voxelsOfSlice,
  const Monitor& monitor, const RangeBody& body)
{
  return ForSlices(SMPThreading(), begin, end, voxelsOfSlice, monitor, body);
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
