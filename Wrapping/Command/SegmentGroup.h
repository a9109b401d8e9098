/**
 * `flipfree segment` with several organs, which are segmented together.
 */
#ifndef FlipFreeCommandSegmentGroup_h
#define FlipFreeCommandSegmentGroup_h

#include "Segmentation.h"

namespace Command
{

/// Segments, writes and reports the organs of --organ. Throws Failure.
void SegmentGroup(const Segmentation& segmentation);

} // namespace Command

#endif
