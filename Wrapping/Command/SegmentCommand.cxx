#include "AskQuestions.h"
#include "CommonOptions.h"
#include "Failure.h"
#include "LabelAdapter.h"
#include "Messages.h"
#include "OrganFilter.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentGroup.h"
#include "SegmentParameters.h"
#include "SegmentRequest.h"
#include "SegmentationReport.h"
#include "SessionFile.h"
#include "SessionVessel.h"
#include "Snapshot.h"
#include "Subcommands.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <sstream>

namespace Command
{
namespace
{

using Point = std::array<double, 3>;

void AnnounceOutputs(const SegmentRequest& request, OutputFiles& outputs)
{
  std::vector<std::string> kept = request.Corrections.StrokeFiles();
  kept.insert(kept.end(), { request.Input, request.StartLabels, request.Session });
  std::vector<std::string> inputs = kept;
  inputs.push_back(request.Corrections.Input());
  const auto announce =
    [&](const char* option, const std::string& name, const std::vector<std::string>& others)
  {
    if (!name.empty())
    {
      outputs.Announce(option, name, others);
    }
  };
  announce("--output", request.Surface, inputs);
  announce("--labels", request.Labels, inputs);
  announce("--convergence", request.Convergence, inputs);
  announce("--questions", request.Questions, inputs);
  announce("--snapshot", request.Snapshot, inputs);
  announce("--save-session", request.SessionOut, inputs);
  // All points may take the place of those that were given.
  announce("--save-points", request.Corrections.Output(), kept);
  if (!request.Snapshot.empty())
  {
    RequireDisplay();
  }
}

/// The seed of that number in LPS millimeters. Throws Failure for a voxel outside the volume.
Point SeedIn(vtkImageData* image, const SegmentRequest& request, std::size_t number)
{
  if (request.SeedVoxel.empty())
  {
    return request.Corrections.InLps(request.Seed.data() + 3 * number);
  }
  const int* const size = image->GetDimensions();
  const int* const index = request.SeedVoxel.data() + 3 * number;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] < 0 || index[axis] >= size[axis])
    {
      std::ostringstream text;
      text << "--seed-voxel: (" << index[0] << ", " << index[1] << ", " << index[2]
           << ") lies outside '" << request.Input << "', which has " << size[0] << " x " << size[1]
           << " x " << size[2] << " voxels. The indices of a voxel count from 0.";
      throw Failure(text.str());
    }
  }
  Point seed;
  image->TransformIndexToPhysicalPoint(index, seed.data());
  return seed;
}

void WriteResults(const OrganFilter& filter, vtkImageData* image, const SegmentRequest& request,
  OutputFiles& outputs)
{
  const auto write =
    [&outputs](const std::string& name, const std::function<void(const std::string&)>& how)
  {
    if (!name.empty())
    {
      outputs.Write(name, how);
    }
  };
  write(request.Surface,
    [&](const std::string& name) { WriteSurface(name, filter.Surface(), NamesOf(request)); });
  write(request.Convergence,
    [&](const std::string& name) { WriteTable(name, filter.Convergence()); });
  if (auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(filter.Algorithm()))
  {
    write(request.Questions,
      [&](const std::string& name) { WriteTable(name, organ->GetQuestions()); });
  }
  write(request.Snapshot,
    [&](const std::string& name) { WriteSnapshot(name, image, filter.Surface()); });
}

using FilterPointer = std::unique_ptr<OrganFilter>;

FilterPointer MakeVesselFilter(const SegmentRequest& request)
{
  try
  {
    const auto filter = VesselFilterOf(request.Repeated);
    filter->SetLabelValue(request.Label);
    return std::make_unique<OrganFilterOf<vtkFlipFreeVesselSegmentation>>(filter);
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + request.Session + "': " + request.Repeated.Name + ": " + failure.what() +
      ". Correct it, or remove it.");
  }
}

/// Throws WrongUsage for parameters that the filter does not take.
FilterPointer FilterOf(const SegmentRequest& request)
{
  if (request.IsVessel())
  {
    return MakeVesselFilter(request);
  }
  auto filter = vtkSmartPointer<vtkFlipFreeSegmentation>::New();
  request.Parameters.Apply(filter);
  filter->SetLabelValue(request.Label);
  filter->SetKeepForCorrections(request.Asks);
  AddPoints(request.Session.empty() ? request.Corrections.Points() : request.Repeated.Corrections,
    filter);
  return std::make_unique<OrganFilterOf<vtkFlipFreeSegmentation>>(filter);
}

void AddSeeds(vtkImageData* image, const SegmentRequest& request, vtkFlipFreeSegmentation* filter)
{
  for (std::size_t number = 0; number < request.Radius.size(); ++number)
  {
    const auto [x, y, z] = SeedIn(image, request, number);
    if (number == 0)
    {
      filter->SetSeedCenter(x, y, z);
      filter->SetSeedRadius(request.Radius[number]);
    }
    else
    {
      filter->AddSeed(x, y, z, request.Radius[number]);
    }
  }
}

/// A choice among several labels that nobody made.
void WarnOfOtherLabels(vtkImageData* labels, const SegmentRequest& request)
{
  if (!request.StartLabel.empty())
  {
    return;
  }
  const FlipFree::LabelValues values = FlipFree::LabelVolumeOf(labels, "it").Values();
  if (values.Labels.Get().size() > 1 && !values.AreNoLabels()) // which the filter has said
  {
    PrintWarning("'" + request.StartLabels + "' has the labels " + TextOf(values.Labels) +
      "; the surface fills label 1; to fill another one, set --start-label.");
  }
}

void Update(const SegmentRequest& request, const OrganFilter& filter)
{
  const std::string title = TitleOf(request);
  try
  {
    Run(filter.Algorithm(), request.Organ.empty() ? "segmenting" : request.Organ,
      QuantitiesOf(request));
  }
  catch (const Failure& failure)
  {
    throw Failure(title + ": " + failure.what());
  }
  if (filter.Surface()->GetNumberOfPolys() == 0)
  {
    throw Failure(
      title + ": no surface was found. Check that the seed sphere lies within the organ.");
  }
  if (filter.StopReason() == vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
  {
    throw Failure(
      title + ": No segmentation: " + (request.IsVessel() ? NoVesselBoundaryText : NoBoundaryText));
  }
}

std::string WhyNoQuestions(const SegmentRequest& request, vtkFlipFreeSegmentation* organ)
{
  if (!request.StartLabels.empty())
  {
    return "a start from labels has no questions";
  }
  return organ->GetFeature()->GetCarving() ? "no part alone is in doubt"
                                           : "questions come with --carving";
}

/// Asks once, segments again by the answers, and returns their points.
std::vector<CorrectionPoint> Ask(const SegmentRequest& request, const OrganFilter& filter)
{
  auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(filter.Algorithm());
  if (organ->GetQuestions()->GetNumberOfRows() == 0)
  {
    WriteToUser("--ask: there is nothing to ask; " + WhyNoQuestions(request, organ) + ".\n");
  }
  std::vector<CorrectionPoint> answers = AskQuestions(organ->GetQuestions());
  if (!answers.empty())
  {
    AddPoints(answers, organ);
    Update(request, filter);
  }
  return answers;
}

void RunOn(vtkImageData* image, const SegmentRequest& request, const OrganFilter& filter)
{
  vtkSmartPointer<vtkImageData> startLabels;
  vtkAlgorithm* const algorithm = filter.Algorithm();
  algorithm->SetInputDataObject(image);
  if (auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(algorithm))
  {
    if (request.StartLabels.empty())
    {
      AddSeeds(image, request, organ);
    }
    else
    {
      const ChosenLabels chosen = ReadLabels(request.StartLabels, request.StartLabel);
      startLabels = chosen.Map;
      organ->SetStartLabelsData(startLabels);
      organ->SetStartLabel(chosen.Label < 0 ? 1 : chosen.Label);
    }
  }
  Update(request, filter);
  if (startLabels)
  {
    WarnOfOtherLabels(startLabels, request); // voxels and label are proper, or it had failed
  }
}

/// One label map of all organs. A voxel in several belongs to the first of them.
vtkSmartPointer<vtkImageData> LabelMapOf(const std::vector<FilterPointer>& filters)
{
  vtkSmartPointer<vtkImageData> all = filters.front()->LabelMap();
  auto* const labels = static_cast<unsigned char*>(all->GetScalarPointer());
  for (auto filter = filters.begin() + 1; filter != filters.end(); ++filter)
  {
    const auto* const more =
      static_cast<const unsigned char*>((*filter)->LabelMap()->GetScalarPointer());
    std::transform(labels, labels + all->GetNumberOfPoints(), more, labels,
      [](unsigned char first, unsigned char second) { return first != 0 ? first : second; });
  }
  return all;
}

OriginNames AllNamesOf(const std::vector<SegmentRequest>& organs)
{
  OriginNames all;
  for (const SegmentRequest& organ : organs)
  {
    const OriginNames names = NamesOf(organ);
    all.Organs.push_back(names.Organs.front());
    all.Colors.push_back(names.Colors.front());
  }
  return all;
}

void SegmentOrgans(std::vector<SegmentRequest> organs, const Session* session)
{
  std::vector<FilterPointer> filters;
  OutputFiles outputs;
  for (const SegmentRequest& organ : organs)
  {
    AnnounceOutputs(organ, outputs);
    filters.push_back(FilterOf(organ));
  }
  const SegmentRequest& first = organs.front();
  vtkSMPTools::Initialize(first.Threads);

  const auto start = std::chrono::steady_clock::now();
  const vtkSmartPointer<vtkImageData> image = ReadVolume(first.Input, first.SeriesUID);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
  if (session)
  {
    RequireImageOf(*session, first.Input, image);
  }

  for (SegmentRequest& organ : organs)
  {
    organ.SeriesUID = SeriesOf(image);
  }

  std::vector<CorrectionPoint> answers;
  for (std::size_t organ = 0; organ < organs.size(); ++organ)
  {
    RunOn(image, organs[organ], *filters[organ]);
    if (organs[organ].Asks)
    {
      answers = Ask(organs[organ], *filters[organ]);
    }
    WriteResults(*filters[organ], image, organs[organ], outputs);
  }
  if (!first.Labels.empty())
  {
    outputs.Write(first.Labels,
      [&](const std::string& name)
      {
        const vtkSmartPointer<vtkImageData> labels = LabelMapOf(filters);
        NameSegments(labels, first.Label, AllNamesOf(organs));
        WriteVolume(name, labels);
      });
  }
  if (!first.SessionOut.empty())
  {
    std::vector<std::string> sessions;
    for (std::size_t organ = 0; organ < organs.size(); ++organ)
    {
      sessions.push_back(
        NamedProvenance(ProvenanceOf(filters[organ]->Surface()), NamesOf(organs[organ])));
    }
    outputs.Write(first.SessionOut,
      [&sessions](const std::string& name) { WriteSession(name, sessions); });
  }
  if (!first.Corrections.Output().empty())
  {
    std::vector<CorrectionPoint> points = first.Corrections.Points();
    points.insert(points.end(), answers.begin(), answers.end());
    outputs.Write(first.Corrections.Output(),
      [&points](const std::string& name) { WritePoints(name, points); });
  }
  outputs.Commit();
  for (std::size_t organ = 0; organ < organs.size(); ++organ)
  {
    Report(*filters[organ], organs[organ], reading.count());
  }
}

void Segment(const SegmentRequest& request)
{
  if (request.Quiet)
  {
    ProgressBar::Disable();
  }
  ValidateRequest(request);
  if (request.Several.HasOrgans())
  {
    SegmentGroup(request, request.Several.Organs(request.Corrections),
      request.Several.FixedSurfaces(), nullptr);
    return;
  }
  if (request.Session.empty())
  {
    SegmentOrgans({ request }, nullptr);
    return;
  }
  const Session session = ReadSession(request.Session);
  SegmentRequest given = request;
  if (given.Input.empty())
  {
    given.Input = ImageBeside(session);
  }
  if (given.SeriesUID.empty() && MayHoldSeries(given.Input))
  {
    given.SeriesUID = session.SeriesUID;
  }
  if (session.Together)
  {
    const std::vector<GivenOrgan> organs = GroupOf(session, given);
    SegmentGroup(given, organs, FixedOf(session), &session);
    return;
  }
  SegmentOrgans(OrgansOf(session, given), &session);
}

const char* const SegmentFooter =
  "Either all output files are written or none. The picture of --snapshot shows the contour on\n"
  "axial, sagittal and coronal slices through the surface's center, and the surface; it needs a\n"
  "display (or xvfb-run -a).\n"
  "\n"
  "Examples:\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 -o liver.vtp\n"
  "  flipfree segment ct.nii.gz --seed-voxel 120 140 60 --radius 15 -o spleen.stl \\\n"
  "      --labels spleen.nii.gz --convergence spleen.csv --snapshot spleen.png\n"
  "  flipfree segment dicom/ --series 1.2.840.1 --seed 90 20 -640 --radius 12 -o kidney.vtp\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 --preset naive -o flips.ply\n"
  "  flipfree segment ct.nii.gz --start-labels network.nii.gz --start-label 6 -o liver.stl\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 --ask -o liver.vtp\n"
  "  flipfree segment ct.nii.gz --session session.json -o organ.stl --labels organs.nii.gz\n"
  "  flipfree segment ct.nii.gz --organ liver 83 -154 321 26 --organ spleen 250 -110 360 14 \\\n"
  "      --outside 240 -80 350 -o organ.vtp --labels organs.nii.gz\n"
  "\n"
  "The seed sphere should lie within the organ and have at least half the radius of the largest\n"
  "sphere that fits there: the organ's intensities are learned from its voxels, and the surface\n"
  "starts from it.\n";

void AddFiles(CLI::App* command, SegmentRequest& request)
{
  command->add_option("INPUT", request.Input,
    "Volume (.nii .nii.gz .nrrd .nhdr .mha .mhd), folder of a DICOM series, or DICOM file of "
    "several frames; with --session, by "
    "default, the session's image beside it");
  command
    ->add_option("--session", request.Session,
      "Session that the page in the browser or --save-session has saved (.json): image, seeds, "
      "parameters, and corrections of organs, and the points of vessels. Of several organs, each "
      "has its name in the names of its files, as in out-liver.vtp, and a label of its own")
    ->type_name("FILE");
  command
    ->add_option("--series", request.SeriesUID,
      "Series Instance UID, if the folder holds several series; by default, the one with the most "
      "slices; of one with several volumes, UID#1, UID#2 and so on ('flipfree series' lists them)")
    ->type_name("UID");
  command
    ->add_option("--seed", request.Seed,
      "Center of the seed sphere, in LPS millimeters; can be repeated for further spheres within "
      "the organ, each with a --radius")
    ->type_name("X Y Z")
    ->expected(3, CLI::detail::expected_max_vector_size)
    ->allow_extra_args(false); // --seed takes exactly three each time
  command
    ->add_option("--seed-voxel", request.SeedVoxel,
      "The same as the indices of a voxel, which count from 0")
    ->type_name("I J K")
    ->expected(3, CLI::detail::expected_max_vector_size)
    ->allow_extra_args(false);
  command
    ->add_option("--radius", request.Radius,
      "Radius of the seed sphere, in millimeters; can be repeated, in the order of the seeds")
    ->type_name("MM")
    ->expected(1, CLI::detail::expected_max_vector_size)
    ->allow_extra_args(false);
  command
    ->add_option("--start-labels", request.StartLabels,
      "Label map with the image's voxels, cropped or not (of a network, an atlas, an earlier "
      "result), "
      "that the surface fills, in place of a seed; points correct it (.nii .nii.gz .nrrd .nhdr "
      ".mha "
      ".mhd)")
    ->type_name("FILE");
  AddLabelOption(*command, "--start-label", request.StartLabel,
    "The organ in --start-labels: its value, by default 1, or 0 for all nonzero voxels; or the "
    "name "
    "of a segment of 3D Slicer (.seg.nrrd)")
    ->needs("--start-labels");
  command->add_option("-o,--output", request.Surface, "Surface (.vtp .stl .ply .obj)")
    ->type_name("FILE");
  command
    ->add_option("--labels", request.Labels,
      "Label map (.nii.gz .nii .nrrd .mha; .seg.nrrd: a segmentation of 3D Slicer, with the "
      "organs' "
      "names and colors)")
    ->type_name("FILE");
  AddConvergenceOption(*command, request.Convergence);
  command
    ->add_option("--questions", request.Questions,
      "Table of the parts of which the result is not sure, at most five, those first where an "
      "answer is worth most (.csv): place, volume, whether it is included, and the margin. Yes is "
      "--inside X Y Z, no --outside X Y Z. Of several organs, each has a table with its name, as "
      "in "
      "out-liver.csv; vessels of a session have none")
    ->type_name("FILE");
  command->add_flag("--ask", request.Asks,
    "Ask these questions at the terminal, and segment again by the answers, which are points "
    "inside and outside; --save-points writes them");
  AddSnapshotOption(*command, request.Snapshot);
  AddSaveSessionOption(*command, request.SessionOut);
  command
    ->add_option("--label-value", request.Label,
      "Value of the organ in the label map, 1 to 255; of several, of the first")
    ->type_name("N")
    ->check(CLI::Range(1, 255))
    ->capture_default_str();
  AddThreadsOption(*command, request.Threads);
  AddQuietOption(*command, request.Quiet);
}

} // namespace

void AddSegmentCommand(CLI::App& program)
{
  const auto request = std::make_shared<SegmentRequest>();
  CLI::App* command =
    program.add_subcommand("segment", "Segment an organ, starting from a sphere inside it");
  AddFiles(command, *request);
  request->Corrections.AddOptions(*command, "organ");
  request->Several.AddOptions(*command);
  request->Parameters.AddOptions(*command);
  command->footer(SegmentFooter);
  command->callback([request]() { Segment(*request); });
}

} // namespace Command
