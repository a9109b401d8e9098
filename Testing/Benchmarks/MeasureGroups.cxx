// Segments all organs of a volume together, and each of them alone, over the volumes of a list of
// cases: the Dice scores of both, how many voxels the organs alone have in common, whether surfaces
// meet (counted exactly, on their union), and how much longer together takes.
//
//   MeasureGroups [--data DIR] [--cases FILE] [--only TEXT] [--threads N]
#include "CaseList.h"
#include "OrganMasks.h"
#include "Statistics.h"

#include "GrayImageAdapter.h"
#include "LabelAdapter.h"

#include "Deformation/OrganGroup.h"
#include "Deformation/StopReason.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/MeshUnion.h"
#include "Stopwatch.h"

#include "vtkImageData.h"
#include "vtkSMPTools.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

using namespace FlipFree;

namespace
{

struct Options
{
  std::string Data = DefaultDataFolder();
  std::string Cases = "development.csv"; ///< in that folder
  std::string Only;
  int Threads = 0;
};

std::ptrdiff_t CountContacts(const std::vector<VolumeSegmentation>& organs)
{
  ContourMesh mesh;
  PointList points(0, 3);
  for (const VolumeSegmentation& organ : organs)
  {
    AppendMesh(organ.Organ.Mesh, mesh);
    AppendPoints(organ.Organ.Points, points);
  }
  return CountSelfIntersections(points, mesh.Faces);
}

struct Score
{
  double Alone = 0;
  double Together = 0;
};

// Returns the ratio of the seconds.
double MeasureVolume(const std::vector<Case>& rows, const Options& options,
  std::map<std::string, std::vector<Score>>& scores)
{
  const std::string& name = rows.front().Image;
  const auto image = ReadVolume(options.Data + "/" + name);
  const GrayVolume volume = GrayVolumeOf(image, name);
  std::vector<BitMask> references;
  std::vector<BitMask> alone;
  std::vector<SeededOrgan> organs;
  Stopwatch watch;
  double seconds = 0;
  for (const Case& row : rows)
  {
    const auto labels = ReadVolume(options.Data + "/" + row.Labels);
    references.push_back(LabelVolumeOf(labels, row.Labels).MaskOf(row.Label));
    organs.push_back({ row.Name, { Eigen::Vector3d(row.Seed.data()), row.Radius } });
    watch.Lap();
    const VolumeSegmentation run =
      VolumeSegmenter(volume, name, organs.back().Seed, nullptr, {}, SMPThreading())
        .Segment({}, NeverStop, [](const auto&, const auto&, const auto&, const auto&) {});
    seconds += watch.Lap();
    alone.push_back(MaskOfRuns(run.Voxels, volume.Geometry));
  }
  watch.Lap();
  OrganGroup group(volume, name, organs, {}, {}, SMPThreading());
  const std::vector<VolumeSegmentation> together =
    group.Segment(std::vector<ConstraintList>(rows.size()), NeverStop,
      [](std::size_t, const auto&, const auto&, const auto&, const auto&) {});
  const double ratio = watch.Lap() / seconds;
  std::size_t twice = 0;
  for (std::size_t organ = 0; organ < rows.size(); ++organ)
  {
    for (std::size_t other = 0; other < organ; ++other)
    {
      BitMask both = alone[organ];
      both.Intersect(alone[other]);
      twice += both.Count();
    }
  }
  std::printf("| %s | %zu | %td | %.2f |\n", name.c_str(), twice, CountContacts(together), ratio);
  for (std::size_t organ = 0; organ < rows.size(); ++organ)
  {
    const OrganSurface& surface = together[organ].Organ;
    double guarded = 0;
    for (const IterationRecord& record : surface.Iterations)
    {
      guarded += record.Step.Guarded;
    }
    const Score score{ DiceOf(alone[organ], references[organ]),
      DiceOf(MaskOfRuns(together[organ].Voxels, volume.Geometry), references[organ]) };
    scores[rows[organ].Organ].push_back(score);
    std::printf("|   %-26s | %.3f | %.3f | %+.3f | %zu iterations, %.0f guarded, %s | %.2f |\n",
      rows[organ].Name.c_str(), score.Alone, score.Together, score.Together - score.Alone,
      surface.Iterations.size(), guarded, ToString(surface.Reason),
      std::floor(100 * together[organ].Confidence.OfSurface) / 100);
  }
  std::fflush(stdout);
  return ratio;
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  CLI::App app("Measures organs segmented together over the volumes of a list of cases.");
  app.add_option("--data", options.Data, "folder with volumes and lists")->capture_default_str();
  app.add_option("--cases", options.Cases, "list of cases in that folder")->capture_default_str();
  app.add_option("--only", options.Only, "rows whose name contains this text");
  app.add_option("--threads", options.Threads, "number of threads");
  CLI11_PARSE(app, argc, argv);
  vtkSMPTools::Initialize(options.Threads);

  std::map<std::string, std::vector<Case>> volumes;
  for (const Case& row : ReadCases(options.Data + "/" + options.Cases))
  {
    if (row.Name.find(options.Only) != std::string::npos)
    {
      volumes[row.Image].push_back(row);
    }
  }
  std::puts(
    "| volume | voxels that organs alone share | contacts | time ratio |\n"
    "|   organ | Dice alone | together | difference | run | confidence |\n|---|---|---|---|");
  std::map<std::string, std::vector<Score>> scores;
  std::vector<double> ratios;
  for (const auto& [name, rows] : volumes)
  {
    ratios.push_back(MeasureVolume(rows, options, scores));
  }
  for (const auto& [organ, of] : scores)
  {
    std::vector<double> alone;
    std::vector<double> together;
    for (const Score& score : of)
    {
      alone.push_back(score.Alone);
      together.push_back(score.Together);
    }
    std::printf("median Dice, %s: alone %.3f, together %.3f, of %zu\n", organ.c_str(),
      Median(alone), Median(together), of.size());
  }
  std::printf("time ratio: median %.2f\n", ratios.empty() ? 0 : Median(ratios));
  return 0;
}
