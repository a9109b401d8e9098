/**
 * What `flipfree segment` is asked for, one organ or vessel at a time. SegmentPlan.h says what is
 * to be done.
 */
#ifndef FlipFreeCommandSegmentRequest_h
#define FlipFreeCommandSegmentRequest_h

#include "OrganOptions.h"
#include "OutputNames.h"
#include "PointOptions.h"
#include "SegmentParameters.h"
#include "SessionFile.h"
#include "SessionRecord.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace Command
{

struct SegmentRequest
{
  std::string Input;
  std::string Session;
  std::string Organ; // of a session of several
  std::string SeriesUID;
  std::vector<double> Seed;   // three numbers of each
  std::vector<int> SeedVoxel; // likewise
  std::vector<double> Radius; // one of each
  std::string StartLabels;    // in place of the seed
  std::string StartLabel;     // a segment's name or a value; empty where nobody has chosen
  std::string Surface;
  std::string Labels;
  std::string Convergence;
  std::string Questions;
  std::string Snapshot;
  std::string SessionOut; // where all is to be written that repeats the run
  int Label = 1;
  int Threads = 0;
  bool Quiet = false;
  bool Asks = false; // the questions, and segments again by the answers
  SegmentParameters Parameters;
  PointOptions Corrections;
  OrganOptions Several;  // in place of the seed
  SessionOrgan Repeated; // of a session

  bool HasSeed() const
  {
    return !this->Seed.empty() || !this->SeedVoxel.empty() || !this->Radius.empty();
  }
  bool IsVessel() const { return !this->Repeated.Points.empty(); }

  /// The points that correct it, those of a file first. Throws Failure where that cannot be read.
  std::vector<CorrectionPoint> Points() const;

  /// The seeds in LPS millimeters in a volume of so many voxels, whose places `placeOf` knows.
  /// Throws Failure for a voxel outside it.
  std::vector<CorrectionPoint> Seeds(const std::array<int, 3>& size,
    const std::function<std::array<double, 3>(const std::array<int, 3>&)>& placeOf) const;
};

/// Checks all that can be checked before a file is read; throws WrongUsage.
void ValidateRequest(const SegmentRequest& request);

/// How messages call what is segmented.
std::string TitleOf(const SegmentRequest& request, const char* quote = "'");

/// What messages call quantities. Their points are in LPS, and no values of options with --ras.
FlipFree::QuantityNames QuantitiesOf(const SegmentRequest& request);

/// What files say of an organ, or of one of a session, apart from how it was found.
OriginNames NamesOf(const SegmentRequest& request);

/// What is written of it, apart from points.
std::vector<RequestedFile> OutputsOf(const SegmentRequest& request);

/// Adds the subcommand's options, whose values the request gets.
void AddOptions(CLI::App& command, SegmentRequest& request);

} // namespace Command

#endif
