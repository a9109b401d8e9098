/**
 * What the subcommands are asked for that neither segment nor trace.
 */
#ifndef FlipFreeCommandOtherRequests_h
#define FlipFreeCommandOtherRequests_h

#include "Options.h"

#include "LabelSurface/LabelSurfaceParameters.h"
#include "Phantom/PhantomVolume.h"

#include <array>
#include <string>
#include <vector>

namespace Command
{

struct SurfacesRequest
{
  std::string LabelMap;
  std::string Folder;
  std::string Format;
  std::string Names;
  std::vector<int> Labels;
  GivenParameters<FlipFree::LabelSurfaceSettings> Parameters;
  int Threads = 0;
  bool Quiet = false;
};

struct EvaluateRequest
{
  std::string Segmentation;
  std::string Reference;
  std::string Label;
  std::string SegmentationLabel;
  std::string ReferenceLabel;
  std::string Csv;
  bool Voxelize = false;
  bool Quiet = false;

  /// The label that is inside, by its own option or by that of both.
  const std::string& LabelOfSegmentation() const;
  const std::string& LabelOfReference() const;
};

struct SeriesRequest
{
  std::string Folder;
  std::string Csv;
  bool Quiet = false;
};

struct PhantomRequest
{
  std::string Name;
  std::string Folder;
  std::array<int, 3> Dimensions{ { 0, 0, 0 } };
  std::array<double, 3> Spacing{ { 0, 0, 0 } };
  double Noise = 0;
  int RandomSeed = 0;
  int Lesions = 0;
  bool Quiet = false;
};

/// Of the command that pip installs; the toolkit's has none.
struct CohortRequest
{
  std::string Table;
  std::string Folder;
  std::string Scheduler;
  int Workers = 0;
  int Threads = 1;
  bool Quiet = false;
};

/// The settings of the phantom. Throws WrongUsage for a name that there is not.
FlipFree::PhantomSettings SettingsOf(const PhantomRequest& request);

/// What is printed of a phantom: what `flipfree segment` and `flipfree trace` take.
std::string PhantomText(const PhantomRequest& request);

// Add the options of a subcommand, whose values the request gets.
void AddOptions(CLI::App& command, SurfacesRequest& request);
void AddOptions(CLI::App& command, EvaluateRequest& request);
void AddOptions(CLI::App& command, SeriesRequest& request);
void AddOptions(CLI::App& command, PhantomRequest& request);
void AddOptions(CLI::App& command, CohortRequest& request);

} // namespace Command

#endif
