/**
 * Threads for the kernels, where there are no VTK's.
 *
 * Whoever calls For() works along, and waits only for parts that another thread has begun. So work
 * gets done however few threads there are, be they fewer than asked for because the system starts
 * no more, several callers may come at once, and what a part calls in turn runs in the part's own
 * thread.
 */
#ifndef FlipFreeThreadPool_h
#define FlipFreeThreadPool_h

#include "Image/SliceParts.h"

namespace FlipFree
{

/// As many as the machine has, unless set.
int NumberOfThreads();

/// From the next work on.
void SetNumberOfThreads(int number);

/// The kernels' ParallelFor. What a body throws is thrown again here, of several the first.
void PoolFor(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body);

Threading PoolThreading();

/// In a process that was forked, the threads have stayed behind. Must be called there before any
/// other of these functions.
void ForgetThreads();

} // namespace FlipFree

#endif
