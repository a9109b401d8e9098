#include "Coordinates.h"
#include "Failure.h"
#include "MessageText.h"
#include "Messages.h"
#include "Options.h"
#include "OutputFile.h"
#include "PointOptions.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentationReport.h"
#include "SessionRecord.h"
#include "Snapshot.h"
#include "Subcommands.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "FilterSettings.h"
#include "Vessel/VesselParameters.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Command
{
namespace
{

struct Trace
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
};

struct Output
{
  const char* Option;
  const std::string* Name;
  std::vector<std::string> Endings;
  std::function<void(const std::string&)> Write;
};

OriginNames NamesOf(const Trace& trace)
{
  OriginNames names;
  names.Image = trace.Input;
  names.Series = trace.SeriesUID;
  for (const std::string* file :
    { &trace.Surface, &trace.Labels, &trace.Centerline, &trace.SessionOut })
  {
    if (names.Organs.empty() && !file->empty())
    {
      names.Organs = { OrganOfFile(*file) };
    }
  }
  return names;
}

/// The files asked for.
std::vector<Output> OutputsOf(const Trace& trace, vtkFlipFreeVesselSegmentation* filter,
  vtkImageData* image)
{
  const OriginNames names = NamesOf(trace);
  const std::vector<Output> all = {
    { "--output", &trace.Surface, SurfaceEndings(),
      [=](const std::string& name) { WriteSurface(name, filter->GetSurface(), names); } },
    { "--labels", &trace.Labels, VolumeEndings(),
      [=](const std::string& name)
      {
        NameSegments(filter->GetLabelMap(), filter->GetLabelValue(), names);
        WriteVolume(name, filter->GetLabelMap());
      } },
    { "--centerline", &trace.Centerline, { ".vtp" },
      [=](const std::string& name) { WriteLines(name, filter->GetCenterline()); } },
    { "--convergence", &trace.Convergence, { ".csv" },
      [=](const std::string& name) { WriteTable(name, filter->GetConvergence()); } },
    { "--snapshot", &trace.Snapshot, { ".png" },
      [=](const std::string& name) { WriteSnapshot(name, image, filter->GetSurface()); } },
    { "--save-session", &trace.SessionOut, { ".json" },
      [=](const std::string& name)
      { WriteSession(name, { NamedProvenance(ProvenanceOf(filter->GetSurface()), names) }); } },
  };
  std::vector<Output> wanted;
  for (const Output& output : all)
  {
    if (!output.Name->empty())
    {
      wanted.push_back(output);
    }
  }
  return wanted;
}

/// Checks all that can be checked before the volume is read.
void ValidateRequest(const Trace& trace)
{
  RequireCoordinates("--point", trace.Points);
  if (trace.Points.size() < 6)
  {
    throw WrongUsage("A vessel needs at least two points. Give one at each end: "
                     "--point X Y Z --point X Y Z (LPS mm).");
  }
  trace.Corrections.Validate();
  const std::vector<Output> outputs = OutputsOf(trace, nullptr, nullptr);
  if (outputs.empty())
  {
    throw WrongUsage("No output is requested. Give at least one of --output, --labels, "
                     "--centerline, --convergence, --snapshot and --save-session.");
  }
  for (const Output& output : outputs)
  {
    RequireEnding(output.Option, *output.Name, output.Endings);
  }
}

/// Other parameters are refused as everywhere.
void RefuseLength(const FlipFree::Parameter<FlipFree::VesselSegmentationSettings>& parameter,
  double value)
{
  if (parameter.Words.Unit == std::string("MM"))
  {
    throw WrongUsage(OptionsOf(parameter.Name).front() + " must be a number of millimeters, " +
      FlipFree::TextOf(parameter.Minimum) + " to " + FlipFree::TextOf(parameter.Maximum) +
      ", not " + FlipFree::TextOf(value) + "." +
      (parameter.Name == "Radius" ? " 0 finds it." : ""));
  }
}

void Configure(const Trace& trace, vtkFlipFreeVesselSegmentation* filter)
{
  for (std::size_t first = 0; first + 2 < trace.Points.size(); first += 3)
  {
    const auto [x, y, z] = trace.Corrections.InLps(trace.Points.data() + first);
    filter->AddPoint(x, y, z);
  }
  AddPoints(trace.Corrections.Points(), filter);
  FlipFree::VesselSegmentationSettings settings;
  trace.Parameters.Apply(settings, RefuseLength);
  FlipFree::FilterSettings::Set(filter, settings);
}

void PrintSummary(vtkFlipFreeVesselSegmentation* filter, const Trace& trace)
{
  vtkPolyData* line = filter->GetCenterline();
  double seconds[4];
  filter->GetStageSeconds(seconds);
  const auto branches = static_cast<int>(line->GetNumberOfLines());
  std::printf(
    "%s: %d %s, %d vertices, %s, %d self-intersections, support %.2f; path %.2f s, start %.2f s, "
    "deformation %.2f s, label map %.2f s\n",
    InputTitle(trace.Input, trace.SeriesUID).c_str(), branches,
    branches == 1 ? "branch" : "branches",
    static_cast<int>(filter->GetSurface()->GetNumberOfPoints()), filter->GetStopReasonAsString(),
    filter->GetNumberOfSelfIntersections(), filter->GetSupport(), seconds[0], seconds[1],
    seconds[2], seconds[3]);
  std::fflush(stdout);
}

void TraceVessel(Trace trace)
{
  if (trace.Quiet)
  {
    ProgressBar::Disable();
  }
  ValidateRequest(trace);
  OutputFiles files;
  std::vector<std::string> kept = trace.Corrections.StrokeFiles();
  kept.push_back(trace.Input);
  std::vector<std::string> inputs = kept;
  inputs.push_back(trace.Corrections.Input());
  for (const Output& output : OutputsOf(trace, nullptr, nullptr))
  {
    files.Announce(output.Option, *output.Name, inputs);
  }
  if (!trace.Corrections.Output().empty())
  {
    files.Announce("--save-points", trace.Corrections.Output(), kept);
  }
  vtkNew<vtkFlipFreeVesselSegmentation> filter;
  Configure(trace, filter);
  if (!trace.Snapshot.empty())
  {
    RequireDisplay();
  }
  vtkSMPTools::Initialize(trace.Threads);
  const vtkSmartPointer<vtkImageData> image = ReadVolume(trace.Input, trace.SeriesUID);
  trace.SeriesUID = SeriesOf(image);
  filter->SetInputData(image);
  try
  {
    Run(filter, "tracing", OptionNames(FlipFree::VesselParameters()));
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + trace.Input + "': " + failure.what());
  }
  if (filter->GetStopReason() == vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
  {
    throw Failure("'" + trace.Input + "': No segmentation: " + NoVesselBoundaryText);
  }
  for (const Output& output : OutputsOf(trace, filter, image))
  {
    files.Write(*output.Name, output.Write);
  }
  if (!trace.Corrections.Output().empty())
  {
    files.Write(trace.Corrections.Output(),
      [&trace](const std::string& name) { WritePoints(name, trace.Corrections.Points()); });
  }
  files.Commit();
  if (!trace.Quiet)
  {
    PrintSummary(filter, trace);
  }
}

} // namespace

void AddTraceCommand(CLI::App& program)
{
  const auto trace = std::make_shared<Trace>();
  CLI::App* command = AddCommand(program, "trace");
  AddOption(*command, "INPUT", trace->Input);
  AddOption(*command, "--series", trace->SeriesUID);
  AddOption(*command, "--point", trace->Points);
  AddOption(*command, "--output", trace->Surface);
  AddOption(*command, "--labels", trace->Labels);
  AddOption(*command, "--centerline", trace->Centerline);
  AddOption(*command, "--convergence", trace->Convergence);
  AddOption(*command, "--snapshot", trace->Snapshot);
  AddOption(*command, "--save-session", trace->SessionOut);
  trace->Parameters.AddOptions(*command, FlipFree::VesselParameters());
  AddThreadsOption(*command, trace->Threads);
  AddOption(*command, "--quiet", trace->Quiet);
  trace->Corrections.AddOptions(*command);
  command->callback([trace]() { TraceVessel(*trace); });
}

} // namespace Command
