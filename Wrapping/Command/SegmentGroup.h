/**
 * `flipfree segment` with several organs, which are segmented together.
 */
#ifndef FlipFreeCommandSegmentGroup_h
#define FlipFreeCommandSegmentGroup_h

#include "OutputFile.h"
#include "SegmentPlan.h"

namespace Command
{

/// Segments, writes and reports the organs of the plan; its files have been announced. Throws
/// Failure.
void SegmentGroup(const SegmentPlan& plan, OutputFiles& outputs);

} // namespace Command

#endif
