// Runs the segmentation over every row of a list of cases, one setting for all, and prints a table:
// accuracy against the reference label, iterations, seconds, stop reason, validity, and the mean
// signed offset from the reference's boundary (SurfaceOffset.h); then medians and peak memory.
//
//   MeasureCases [--data DIR] [--cases FILE] [--only TEXT] [--preset default|published|naive]
//                [--seeds N | --fill] [--surfaces DIR] [--threads N] [--set Name=value ...]
//                [--gate FILE] [--write-gate FILE]
//
// With --seeds N each row is run from N random seeds in the organ, at least their radius away from
// its border, and the spread of the Dice score is printed. With --fill the surface fills the
// reference itself, in place of a foreground found in the image: its surface. With
// --gate, results are compared with a table of earlier ones (AccuracyGate.h), and the exit code is
// 1 where too much is lost. --cases may be given more than once.
#include "AccuracyGate.h"
#include "CaseList.h"
#include "SegmentationRun.h"
#include "Statistics.h"
#include "SurfaceOffset.h"

#include "Deformation/SegmentationParameters.h"
#include "FilterSettings.h"

#include "vtkDoubleArray.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSegmentationMetrics.h"
#include "vtkSurfaceValidity.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"
#include "vtkXMLPolyDataWriter.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

struct Options
{
  std::string Data = DefaultDataFolder();
  std::vector<std::string> Cases{ "cases.csv" }; ///< in that folder
  std::string Only;
  std::string Preset = "default";
  std::string Surfaces;
  std::string Gate;
  std::string WriteGate;
  int Seeds = 0;
  bool Fill = false;
  int Threads = 0;
  std::vector<std::string> Parameters;
};

void ApplyPreset(const std::string& preset, vtkFlipFreeSegmentation* filter)
{
  if (preset == "published")
  {
    filter->UsePublishedParameters();
  }
  else if (preset == "naive")
  {
    filter->UseNaiveParameters();
  }
}

// Name=value: a parameter that a study varies.
void SetParameter(const std::string& assignment, vtkFlipFreeSegmentation* filter)
{
  const std::size_t equals = assignment.find('=');
  const auto* const parameter =
    FlipFree::FindParameter(FlipFree::SegmentationParameters(), assignment.substr(0, equals));
  auto settings = FlipFree::FilterSettings::Of(filter);
  if (!parameter || !parameter->Take(settings, { std::stod(assignment.substr(equals + 1)) }))
  {
    throw std::out_of_range(assignment);
  }
  FlipFree::FilterSettings::Set(filter, settings);
}

void Configure(const Options& options, vtkFlipFreeSegmentation* filter)
{
  ApplyPreset(options.Preset, filter);
  for (const std::string& assignment : options.Parameters)
  {
    SetParameter(assignment, filter);
  }
}

double Dice(vtkFlipFreeSegmentation* filter, vtkImageData* reference, int label)
{
  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputData(filter->GetLabelMap());
  metrics->SetReferenceData(reference);
  metrics->SetReferenceLabel(label);
  metrics->Update();
  return metrics->GetDice();
}

struct RowResult
{
  double Dice = 0;
  double Offset = 0; // mm
  std::string Hash;
};

// From the seed of the row: one line of the table.
RowResult MeasureRow(const Case& row, const Options& options)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  const auto image = ReadVolume(options.Data + "/" + row.Image);
  const double read = vtkTimerLog::GetUniversalTime();
  vtkNew<vtkFlipFreeSegmentation> filter;
  Configure(options, filter);
  filter->SetInputDataObject(image);
  filter->SetSeedCenter(row.Seed.data());
  filter->SetSeedRadius(row.Radius);
  const auto reference = ReadVolume(options.Data + "/" + row.Labels);
  if (options.Fill)
  {
    filter->SetStartLabelsData(reference);
    filter->SetStartLabel(row.Label);
  }
  const double start = vtkTimerLog::GetUniversalTime();
  filter->Update();
  const double end = vtkTimerLog::GetUniversalTime();
  if (filter->GetSurface()->GetNumberOfPoints() == 0)
  {
    std::printf("| %-26s | no surface |\n", row.Name.c_str());
    return {};
  }

  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputData(filter->GetLabelMap());
  metrics->SetReferenceData(reference);
  metrics->SetReferenceLabel(row.Label);
  metrics->Update();
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(filter->GetSurface());
  validity->Update();
  const StageSeconds stages = StageSecondsOf(filter);
  const double offset = MeanSignedOffset(filter->GetSurface(), reference, row.Label);
  std::printf("| %-26s | %.3f | %.3f | %5.2f | %6.2f | %+5.2f | %3d | %4.2f | %4.2f | %4.2f %4.2f "
              "%4.2f %4.2f | %4.2f %4.2f %4.2f %4.2f | %d | %6.0f | %s | %.2f | %+.2f |\n",
    row.Name.c_str(), metrics->GetDice(), metrics->GetJaccard(), metrics->GetASD(),
    metrics->GetHD95(), metrics->GetRelativeVolumeDifference(), stages.Iterations, read - begin,
    end - start, stages.Smoothing, stages.Feature, stages.Deformation, stages.Labels, stages.Search,
    stages.Flips, stages.Solve, stages.Guard, filter->GetNumberOfSelfIntersections(),
    SumOfColumn(filter->GetConvergence(), "Guarded"), filter->GetStopReasonAsString(),
    std::floor(100 * filter->GetConfidence()) / 100, offset);
  std::fflush(stdout);
  if (!options.Surfaces.empty())
  {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(filter->GetSurface());
    std::filesystem::create_directories(options.Surfaces);
    writer->SetFileName((options.Surfaces + "/" + row.Name + ".vtp").c_str());
    writer->Write();
  }
  return { metrics->GetDice(), offset, HashOf(filter->GetSurface()) };
}

void MeasureSeeds(const Case& row, const Options& options)
{
  const auto image = ReadVolume(options.Data + "/" + row.Image);
  const auto reference = ReadVolume(options.Data + "/" + row.Labels);
  std::vector<double> scores;
  for (const RandomSeed& seed : RandomSeeds(reference, row.Label, row.Radius, options.Seeds))
  {
    vtkNew<vtkFlipFreeSegmentation> filter;
    Configure(options, filter);
    filter->SetInputDataObject(image);
    filter->SetSeedCenter(seed.Center.data());
    filter->SetSeedRadius(seed.Radius);
    filter->Update();
    scores.push_back(
      filter->GetSurface()->GetNumberOfPoints() ? Dice(filter, reference, row.Label) : 0);
  }
  if (scores.empty())
  {
    std::printf("| %-26s | no place for a seed |\n", row.Name.c_str());
    return;
  }
  std::sort(scores.begin(), scores.end());
  std::printf("| %-26s | %2zu | %.3f | %.3f | %.3f |", row.Name.c_str(), scores.size(),
    scores.front(), Median(scores), scores.back());
  for (double score : scores)
  {
    std::printf(" %.2f", score);
  }
  std::printf(" |\n");
  std::fflush(stdout);
}

} // namespace

int main(int argc, char* argv[])
try
{
  Options options;
  CLI::App app("Measures the segmentation over the rows of a list of cases.");
  app.add_option("--data", options.Data, "folder with volumes and lists")->capture_default_str();
  app.add_option("--cases", options.Cases, "lists of cases in that folder")->capture_default_str();
  app.add_option("--only", options.Only, "rows whose name contains this text");
  app.add_option("--preset", options.Preset, "default, published, or naive")
    ->check(CLI::IsMember({ "default", "published", "naive" }));
  app.add_option("--seeds", options.Seeds, "random seeds per row in place of the row's own");
  app.add_flag("--fill", options.Fill, "fill the reference label in place of a segmentation");
  app.add_option("--surfaces", options.Surfaces, "folder that takes the surfaces");
  app.add_option("--gate", options.Gate, "table of earlier results to compare with")
    ->excludes("--seeds");
  app.add_option("--write-gate", options.WriteGate, "file that takes such a table")
    ->excludes("--seeds");
  app.add_option("--threads", options.Threads, "number of threads");
  app.add_option("--set", options.Parameters, "Name=value of a parameter, as its setter is called");
  CLI11_PARSE(app, argc, argv);
  vtkSMPTools::Initialize(options.Threads);

  if (options.Seeds > 0)
  {
    std::puts("| case | seeds | minimum | median | maximum | all |\n|---|---|---|---|---|---|");
  }
  else
  {
    std::puts("| case | Dice | Jaccard | ASD mm | HD95 mm | volume | iterations | read s | run s | "
              "smoothing, feature, deformation, labels s | search, flips, solve, guard s | "
              "self-intersections | guarded | stop reason | confidence | offset mm |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  }
  std::map<std::string, std::vector<double>> scores;
  std::map<std::string, std::vector<double>> offsets;
  std::vector<GateRow> rowsBefore;
  std::vector<GateRow> rowsAfter;
  std::vector<Case> cases;
  if (!options.Gate.empty())
  {
    rowsBefore = ReadGate(options.Gate); // a wrong file is told before minutes of work
  }
  for (const std::string& list : options.Cases)
  {
    const std::vector<Case> rows = ReadCases(options.Data + "/" + list);
    if (rows.empty())
    {
      std::fprintf(stderr, "MeasureCases: there is no case in %s/%s\n", options.Data.c_str(),
        list.c_str());
      return 1;
    }
    cases.insert(cases.end(), rows.begin(), rows.end());
  }
  for (const Case& row : cases)
  {
    if (row.Name.find(options.Only) == std::string::npos)
    {
      continue;
    }
    if (options.Seeds > 0)
    {
      MeasureSeeds(row, options);
    }
    else
    {
      const RowResult result = MeasureRow(row, options);
      scores[row.Organ].push_back(result.Dice);
      offsets[row.Organ].push_back(result.Offset);
      rowsAfter.push_back({ row.Name, row.Organ, result.Dice, result.Hash });
    }
  }
  for (const auto& organ : scores)
  {
    std::printf("median Dice, %s: %.3f of %zu; median offset %+.2f mm\n", organ.first.c_str(),
      Median(organ.second), organ.second.size(), Median(offsets[organ.first]));
  }
  std::vector<double> globular = scores["liver"];
  globular.insert(globular.end(), scores["spleen"].begin(), scores["spleen"].end());
  std::printf("median Dice, liver and spleen: %.3f\n", Median(globular));
  std::printf("peak memory: %.0f MB\n", PeakMemory() / 1e6);
  if (!options.WriteGate.empty())
  {
    WriteGate(options.WriteGate, rowsAfter);
  }
  return options.Gate.empty() || PassesGate(rowsBefore, rowsAfter) ? 0 : 1;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "MeasureCases: %s\n", error.what());
  return 1;
}
