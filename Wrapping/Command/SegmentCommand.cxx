#include "AskQuestions.h"
#include "Failure.h"
#include "LabelAdapter.h"
#include "Messages.h"
#include "Options.h"
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

#include "Deformation/SegmentationParameters.h"
#include "ParameterTable.h"

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

} // namespace

void AddSegmentCommand(CLI::App& program)
{
  const auto request = std::make_shared<SegmentRequest>();
  CLI::App* command = AddCommand(program, "segment");
  AddOption(*command, "INPUT", request->Input);
  AddOption(*command, "--session", request->Session);
  AddOption(*command, "--series", request->SeriesUID);
  AddOption(*command, "--seed", request->Seed);
  AddOption(*command, "--seed-voxel", request->SeedVoxel);
  AddOption(*command, "--radius", request->Radius);
  AddOption(*command, "--start-labels", request->StartLabels);
  AddOption(*command, "--start-label", request->StartLabel)->needs("--start-labels");
  AddOption(*command, "--output", request->Surface);
  AddOption(*command, "--labels", request->Labels);
  AddOption(*command, "--convergence", request->Convergence);
  AddOption(*command, "--questions", request->Questions);
  AddOption(*command, "--ask", request->Asks);
  AddOption(*command, "--snapshot", request->Snapshot);
  AddOption(*command, "--save-session", request->SessionOut);
  const auto* const label =
    FlipFree::FindParameter(FlipFree::SegmentationParameters(), "LabelValue");
  AddOption(*command, "--label-value", request->Label)
    ->check(CLI::Range(static_cast<int>(label->Minimum), static_cast<int>(label->Maximum)));
  AddThreadsOption(*command, request->Threads);
  AddOption(*command, "--quiet", request->Quiet);
  request->Corrections.AddOptions(*command);
  request->Several.AddOptions(*command);
  request->Parameters.AddOptions(*command);
  command->callback([request]() { Segment(*request); });
}

} // namespace Command
