/**
 * What `flipfree segment` is asked for, one organ or vessel at a time.
 */
#ifndef FlipFreeCommandSegmentation_h
#define FlipFreeCommandSegmentation_h

#include "OrganOptions.h"
#include "PointOptions.h"
#include "SegmentParameters.h"
#include "SessionFile.h"

#include <string>
#include <vector>

namespace Command
{

struct Segmentation
{
  std::string Input;
  std::string Session;
  std::string Organ; // of a session of several
  std::string SeriesUID;
  std::vector<double> Seed;
  std::vector<int> SeedVoxel;
  double Radius = 0;
  std::string StartLabels; // in place of the seed
  int StartLabel = 1;
  std::string Surface;
  std::string Labels;
  std::string Convergence;
  std::string Snapshot;
  int Label = 1;
  int Threads = 0;
  bool Quiet = false;
  SegmentParameters Parameters;
  PointOptions Corrections;
  OrganOptions Several;  // in place of the seed
  SessionOrgan Repeated; // of a session

  bool IsVessel() const { return !this->Repeated.Points.empty(); }
};

/// Checks all that can be checked before a file is read; throws WrongUsage.
void RequireSense(const Segmentation& segmentation);

/// How messages call what is segmented.
std::string TitleOf(const Segmentation& segmentation, const char* quote = "'");

/// The name of an organ's own file: `out-liver.vtp` for `out.vtp`. Empty for none.
std::string NameFor(const std::string& organ, const std::string& name);

/// One for each organ of the session.
std::vector<Segmentation> OrgansOf(const Session& session, const Segmentation& given);

} // namespace Command

#endif
