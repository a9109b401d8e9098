#include "AskQuestions.h"
#include "Failure.h"
#include "FilterPoints.h"
#include "FilterSettings.h"
#include "ImageAdapter.h"
#include "LabelAdapter.h"
#include "Messages.h"
#include "OrganFilter.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentGroup.h"
#include "SegmentPlan.h"
#include "SegmentationReport.h"
#include "Snapshot.h"
#include "Subcommands.h"
#include "Summary.h"
#include "SurfaceFile.h"
#include "SurfaceOrigin.h"
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

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

namespace Command
{
namespace
{

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
  auto filter = vtkSmartPointer<vtkFlipFreeVesselSegmentation>::New();
  for (const auto& [x, y, z] : request.Repeated.Points)
  {
    filter->AddPoint(x, y, z);
  }
  AddPoints(request.Repeated.Corrections, filter);
  FlipFree::FilterSettings::Set(filter, VesselSettingsOf(request));
  filter->SetLabelValue(request.Label);
  return std::make_unique<OrganFilterOf<vtkFlipFreeVesselSegmentation>>(filter);
}

/// Throws WrongUsage for parameters that the filter does not take.
FilterPointer FilterOf(const SegmentRequest& request)
{
  if (request.IsVessel())
  {
    return MakeVesselFilter(request);
  }
  auto filter = vtkSmartPointer<vtkFlipFreeSegmentation>::New();
  FlipFree::FilterSettings::Set(filter, request.Parameters.Settings());
  filter->SetLabelValue(request.Label);
  filter->SetKeepForCorrections(request.Asks);
  AddPoints(request.Points(), filter);
  return std::make_unique<OrganFilterOf<vtkFlipFreeSegmentation>>(filter);
}

void AddSeeds(vtkImageData* image, const SegmentRequest& request, vtkFlipFreeSegmentation* filter)
{
  const int* const size = image->GetDimensions();
  const std::vector<CorrectionPoint> seeds = request.Seeds({ { size[0], size[1], size[2] } },
    [image](const std::array<int, 3>& index)
    {
      std::array<double, 3> place;
      image->TransformIndexToPhysicalPoint(index.data(), place.data());
      return place;
    });
  const auto& [x, y, z] = seeds.front().Place;
  filter->SetSeedCenter(x, y, z);
  filter->SetSeedRadius(seeds.front().Radius);
  AddPoints({ seeds.begin() + 1, seeds.end() }, filter);
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

/// Asks once, segments again by the answers, and returns their points.
std::vector<CorrectionPoint> Ask(const SegmentRequest& request, const OrganFilter& filter)
{
  auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(filter.Algorithm());
  if (organ->GetQuestions()->GetNumberOfRows() == 0)
  {
    WriteToUser(
      NothingToAskText(!request.StartLabels.empty(), organ->GetFeature()->GetCarving() != 0));
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

void SegmentOrgans(std::vector<SegmentRequest> organs, const std::optional<Session>& session,
  OutputFiles& outputs)
{
  std::vector<FilterPointer> filters;
  filters.reserve(organs.size());
  for (const SegmentRequest& organ : organs)
  {
    filters.push_back(FilterOf(organ));
  }
  const SegmentRequest& first = organs.front();
  vtkSMPTools::Initialize(first.Threads);

  const auto start = std::chrono::steady_clock::now();
  const vtkSmartPointer<vtkImageData> image = ReadVolume(first.Input, first.SeriesUID);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
  if (session)
  {
    RequireImageOf(*session, first.Input, FlipFree::GeometryOf(image));
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
      [&sessions](const std::string& name) { WriteText(name, SessionText(name, sessions)); });
  }
  if (!first.Corrections.Output().empty())
  {
    std::vector<CorrectionPoint> points = first.Corrections.Points();
    points.insert(points.end(), answers.begin(), answers.end());
    outputs.Write(first.Corrections.Output(),
      [&points](const std::string& name) { WriteText(name, TextOfPoints(name, points)); });
  }
  outputs.Commit();
  for (std::size_t organ = 0; organ < organs.size(); ++organ)
  {
    Report(*filters[organ], organs[organ], reading.count());
  }
}

} // namespace

void Segment(const SegmentRequest& request)
{
  if (request.Quiet)
  {
    ProgressBar::Disable();
  }
  const SegmentPlan plan = PlanOf(request);
  OutputFiles outputs;
  AnnounceOutputs(plan, outputs.Announcing());
  if (!request.Snapshot.empty())
  {
    RequireDisplay();
  }
  if (plan.Group.empty())
  {
    SegmentOrgans(plan.Organs, plan.From, outputs);
  }
  else
  {
    SegmentGroup(plan, outputs);
  }
}

} // namespace Command
