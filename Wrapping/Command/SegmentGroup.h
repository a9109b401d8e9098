/**
 * `flipfree segment` with several organs, which are segmented together.
 */
#ifndef FlipFreeCommandSegmentGroup_h
#define FlipFreeCommandSegmentGroup_h

#include "SegmentRequest.h"

namespace Command
{

/// Segments, writes and reports organs that keep off each other and the files of surfaces that are
/// `fixed`; the session that they come from may be null. Throws Failure.
void SegmentGroup(const SegmentRequest& request, const std::vector<GivenOrgan>& organs,
  const std::vector<std::string>& fixedSurfaces, const Session* session);

} // namespace Command

#endif
