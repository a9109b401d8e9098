/**
 * What `flipfree segment` is asked for, one organ or vessel at a time.
 */
#ifndef FlipFreeCommandSegmentRequest_h
#define FlipFreeCommandSegmentRequest_h

#include "OrganOptions.h"
#include "PointOptions.h"
#include "SegmentParameters.h"
#include "SessionFile.h"
#include "SessionRecord.h"

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
};

/// Checks all that can be checked before a file is read; throws WrongUsage.
void ValidateRequest(const SegmentRequest& request);

/// How messages call what is segmented.
std::string TitleOf(const SegmentRequest& request, const char* quote = "'");

/// What messages call quantities. Their points are in LPS, and no values of options with --ras.
FlipFree::QuantityNames QuantitiesOf(const SegmentRequest& request);

/// The name of an organ's own file: `out-liver.vtp` for `out.vtp`. Empty for none.
std::string NameFor(const std::string& organ, const std::string& name);

/// What files say of an organ, or of one of a session, apart from how it was found.
OriginNames NamesOf(const SegmentRequest& request);

/// One for each organ of the session.
std::vector<SegmentRequest> OrgansOf(const Session& session, const SegmentRequest& given);

/// The organs of a session that were segmented together; `given` gets their parameters.
std::vector<GivenOrgan> GroupOf(const Session& session, SegmentRequest& given);

/// The files of the surfaces that they kept off.
std::vector<std::string> FixedOf(const Session& session);

} // namespace Command

#endif
