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

#include <algorithm>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace FlipFree
{

/// How many threads the system starts besides those that there are, up to a number.
inline int StartableThreads(int wanted)
{
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::vector<std::thread> threads;
  try
  {
    while (static_cast<int>(threads.size()) < wanted)
    {
      threads.emplace_back([ended] { ended.wait(); });
    }
  }
  catch (const std::system_error&)
  {
    // As in a container that limits them.
  }
  end.set_value();
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  return static_cast<int>(threads.size());
}

/// Asks VTK for no more threads than the system starts, where it has to, since VTK's libraries of
/// threads fail there. One of those that it starts is left for the reading of files.
inline void LimitThreads()
{
  static const bool isDone = []
  {
    const int wanted = vtkSMPTools::GetEstimatedNumberOfThreads() - 1;
    const int startable = StartableThreads(wanted);
    if (startable < wanted)
    {
      vtkSMPTools::Initialize(std::max(1, startable));
    }
    return true;
  }();
  static_cast<void>(isDone);
}

/// ParallelFor by VTK's threads.
inline void SMPFor(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
{
  LimitThreads();
  vtkSMPTools::For(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end),
    [&body](vtkIdType first, vtkIdType last) { body(first, last); });
}

/// How many threads SMPFor has.
inline int NumberOfThreads()
{
  LimitThreads();
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
