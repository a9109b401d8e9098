/**
 * What `flipfree trace` is asked for.
 */
#ifndef FlipFreeCommandTraceRequest_h
#define FlipFreeCommandTraceRequest_h

#include "Options.h"
#include "OutputNames.h"
#include "PointOptions.h"
#include "SessionRecord.h"

#include "Vessel/VesselSegmentation.h"

#include <array>
#include <string>
#include <vector>

namespace Command
{

struct TraceRequest
{
  std::string Input;
  std::string SeriesUID;
  std::vector<double> Points; // three numbers each
  PointOptions Corrections;
  GivenParameters<FlipFree::VesselSegmentationSettings> Parameters;
  std::string Surface;
  std::string Labels;
  std::string Centerline;
  std::string Convergence;
  std::string Snapshot;
  std::string SessionOut;
  int Threads = 0;
  bool Quiet = false;

  /// The vessel's points in LPS millimeters.
  std::vector<std::array<double, 3>> Places() const;

  /// Throws WrongUsage for a value out of range.
  FlipFree::VesselSegmentationSettings Settings() const;
};

/// Checks all that can be checked before a file is read; throws WrongUsage.
void ValidateRequest(const TraceRequest& request);

/// What is written of it, apart from points.
std::vector<RequestedFile> OutputsOf(const TraceRequest& request);

/// Tells of all files that are to be written, before the work is done.
void AnnounceOutputs(const TraceRequest& request, const Announce& announce);

/// What files say of the vessel, apart from how it was found.
OriginNames NamesOf(const TraceRequest& request);

/// Adds the subcommand's options, whose values the request gets.
void AddOptions(CLI::App& command, TraceRequest& request);

} // namespace Command

#endif
