#include "CommonOptions.h"
#include "Coordinates.h"
#include "Failure.h"
#include "MessageText.h"
#include "Messages.h"
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
  double Radius = 0;
  double WallThickness = 0;
  int Modality = 0;
  int Levels = 0;
  int Iterations = 0;
  std::string Surface;
  std::string Labels;
  std::string Centerline;
  std::string Convergence;
  std::string Snapshot;
  std::string SessionOut;
  int Label = 1;
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

void Configure(const Trace& trace, vtkFlipFreeVesselSegmentation* filter)
{
  for (std::size_t first = 0; first + 2 < trace.Points.size(); first += 3)
  {
    const auto [x, y, z] = trace.Corrections.InLps(trace.Points.data() + first);
    filter->AddPoint(x, y, z);
  }
  AddPoints(trace.Corrections.Points(), filter);
  filter->SetRadius(trace.Radius);
  if (filter->GetRadius() != trace.Radius)
  {
    throw WrongUsage("--radius must be a number of millimeters, 0 to 100, not " +
      FlipFree::TextOf(trace.Radius) + ". 0 finds it.");
  }
  filter->SetWallThickness(trace.WallThickness);
  if (filter->GetWallThickness() != trace.WallThickness)
  {
    throw WrongUsage("--wall-thickness must be a number of millimeters, -5 to 5, not " +
      FlipFree::TextOf(trace.WallThickness) + ".");
  }
  filter->SetModality(trace.Modality);
  filter->SetLevels(trace.Levels);
  filter->SetMaximumIterations(trace.Iterations);
  filter->SetLabelValue(trace.Label);
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
    Run(filter, "tracing",
      { { "Radius", "--radius" }, { "WallThickness", "--wall-thickness" },
        { "Levels", "--levels" } });
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

const char* const TraceFooter =
  "Either all output files are written or none. Points lie in the vessel: one at each end, more\n"
  "along it or at the ends of its branches, in any order. Points 5 mm off do little harm.\n"
  "\n"
  "Examples:\n"
  "  flipfree trace ct.nii.gz --point 212 -143 480 --point 171 -168 228 -o aorta.vtp\n"
  "  flipfree trace ct.nii.gz --point 274 -141 318 --point 145 -212 315 --point 105 -113 345 \\\n"
  "      -o portal.stl --labels portal.nii.gz --centerline portal-line.vtp\n"
  "  flipfree trace ct.nii.gz --point 212 -143 480 --point 171 -168 228 --outside 190 -150 350 \\\n"
  "      -o aorta.vtp\n"
  "\n"
  "The poly lines of --centerline have the radius at each point, and the length up to it.\n";

void AddFiles(CLI::App* command, Trace& trace)
{
  command
    ->add_option("INPUT", trace.Input,
      "Volume (.nii .nii.gz .nrrd .nhdr .mha .mhd), folder of a DICOM series, or DICOM file of "
      "several frames")
    ->required();
  command
    ->add_option("--series", trace.SeriesUID,
      "Series Instance UID, if the folder holds several series; by default, the one with the most "
      "slices; of one with several volumes, UID#1, UID#2 and so on ('flipfree series' lists them)")
    ->type_name("UID");
  command
    ->add_option("--point", trace.Points,
      "A point in the vessel, in LPS millimeters; two or more are needed")
    ->type_name("X Y Z")
    ->expected(3, CLI::detail::expected_max_vector_size)
    ->allow_extra_args(false); // of the three that each time has
  command->add_option("-o,--output", trace.Surface, "Surface (.vtp .stl .ply .obj)")
    ->type_name("FILE");
  command
    ->add_option("--labels", trace.Labels,
      "Label map (.nii.gz .nii .nrrd .mha; .seg.nrrd: a segmentation of 3D Slicer, with the "
      "vessel's "
      "name)")
    ->type_name("FILE");
  command->add_option("--centerline", trace.Centerline, "Poly lines with radii (.vtp)")
    ->type_name("FILE");
  AddConvergenceOption(*command, trace.Convergence);
  AddSnapshotOption(*command, trace.Snapshot);
  AddSaveSessionOption(*command, trace.SessionOut);
}

void AddParameters(CLI::App* command, Trace& trace)
{
  vtkNew<vtkFlipFreeVesselSegmentation> defaults;
  trace.Radius = defaults->GetRadius();
  trace.WallThickness = defaults->GetWallThickness();
  trace.Modality = defaults->GetModality();
  trace.Levels = defaults->GetLevels();
  trace.Iterations = defaults->GetMaximumIterations();
  command
    ->add_option("--radius", trace.Radius,
      "The vessel's approximate radius, up to 100; 0: found in the volume")
    ->type_name("MM")
    ->capture_default_str();
  command
    ->add_option("--wall-thickness", trace.WallThickness,
      "Added to the outline, which gray values show without the vessel's wall, -5 to 5; less than "
      "0 makes the vessel thinner, of which 0.5 mm must remain")
    ->type_name("MM")
    ->capture_default_str();
  command
    ->add_option("--modality", trace.Modality,
      "Scale of the gray values, by which the contrast across the outline is judged; 0: automatic, "
      "1: CT, 2: MR")
    ->type_name("N")
    ->check(CLI::Range(0, 2))
    ->capture_default_str();
  command->add_option("--levels", trace.Levels, "Levels from coarse to fine")
    ->type_name("N")
    ->check(CLI::Range(1, 4))
    ->capture_default_str();
  command
    ->add_option("--iterations,--maximum-iterations", trace.Iterations,
      "Maximum number of iterations at each level")
    ->type_name("N")
    ->check(CLI::Range(0, 1000))
    ->capture_default_str();
  command
    ->add_option("--label-value", trace.Label, "Value of the vessel in the label map, 1 to 255")
    ->type_name("N")
    ->check(CLI::Range(1, 255))
    ->capture_default_str();
  AddThreadsOption(*command, trace.Threads);
  AddQuietOption(*command, trace.Quiet);
}

} // namespace

void AddTraceCommand(CLI::App& program)
{
  const auto trace = std::make_shared<Trace>();
  CLI::App* command =
    program.add_subcommand("trace", "Segment a vessel, or a tree of vessels, between points");
  AddFiles(command, *trace);
  AddParameters(command, *trace);
  trace->Corrections.AddOptions(*command, "vessel");
  command->footer(TraceFooter);
  command->callback([trace]() { TraceVessel(*trace); });
}

} // namespace Command
