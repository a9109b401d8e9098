/**
 * What `flipfree segment` is to do: the organs and vessels of the command line or of a session, one
 * after the other or together.
 */
#ifndef FlipFreeCommandSegmentPlan_h
#define FlipFreeCommandSegmentPlan_h

#include "SegmentRequest.h"

#include "Vessel/VesselSegmentation.h"

#include <optional>
#include <string>
#include <vector>

namespace Command
{

struct SegmentPlan
{
  SegmentRequest Given; ///< with the image, and of organs together the parameters
  std::optional<Session> From;
  std::vector<SegmentRequest> Organs; ///< one after the other
  std::vector<GivenOrgan> Group;      ///< in their place, organs together
  std::vector<std::string> Fixed;     ///< files of surfaces that the group keeps off
};

/// Checks the request and reads the session. Throws WrongUsage or Failure.
SegmentPlan PlanOf(const SegmentRequest& request);

/// Tells of all files that are to be written, before the work is done.
void AnnounceOutputs(const SegmentPlan& plan, const Announce& announce);

/// The same request with the names of an organ's own files: `out-liver.vtp` for `out.vtp`.
SegmentRequest WithFilesOf(const std::string& organ, const SegmentRequest& given);

/// The settings of a vessel of a session. Throws Failure for a parameter that there is not, and a
/// value out of its range.
FlipFree::VesselSegmentationSettings VesselSettingsOf(const SegmentRequest& request);

} // namespace Command

#endif
