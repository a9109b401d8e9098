#include "Failure.h"
#include "FilterPoints.h"
#include "FilterSettings.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentationReport.h"
#include "Snapshot.h"
#include "Subcommands.h"
#include "Summary.h"
#include "SurfaceFile.h"
#include "SurfaceOrigin.h"
#include "TableFile.h"
#include "TraceRequest.h"
#include "VolumeFile.h"

#include "Vessel/VesselParameters.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"

#include <string>
#include <vector>

namespace Command
{
namespace
{

void Configure(const TraceRequest& request, vtkFlipFreeVesselSegmentation* filter)
{
  for (const auto& [x, y, z] : request.Places())
  {
    filter->AddPoint(x, y, z);
  }
  const std::vector<CorrectionPoint> points = request.Corrections.Points();
  RequireNoSeeds(points);
  AddPoints(points, filter);
  FlipFree::FilterSettings::Set(filter, request.Settings());
}

void WriteResults(const TraceRequest& request, vtkFlipFreeVesselSegmentation* filter,
  vtkImageData* image, OutputFiles& files)
{
  const OriginNames names = NamesOf(request);
  const auto write = [&files](const std::string& name, const auto& how)
  {
    if (!name.empty())
    {
      files.Write(name, how);
    }
  };
  write(request.Surface,
    [&](const std::string& name) { WriteSurface(name, filter->GetSurface(), names); });
  write(request.Labels,
    [&](const std::string& name)
    {
      NameSegments(filter->GetLabelMap(), filter->GetLabelValue(), names);
      WriteVolume(name, filter->GetLabelMap());
    });
  write(request.Centerline,
    [&](const std::string& name) { WriteLines(name, filter->GetCenterline()); });
  write(request.Convergence,
    [&](const std::string& name) { WriteTable(name, filter->GetConvergence()); });
  write(request.Snapshot,
    [&](const std::string& name) { WriteSnapshot(name, image, filter->GetSurface()); });
  write(request.SessionOut,
    [&](const std::string& name)
    {
      const std::string session = NamedProvenance(ProvenanceOf(filter->GetSurface()), names);
      WriteText(name, SessionText(name, { session }));
    });
  write(request.Corrections.Output(),
    [&](const std::string& name)
    { WriteText(name, TextOfPoints(name, request.Corrections.Points())); });
}

std::string SummaryOf(const TraceRequest& request, vtkFlipFreeVesselSegmentation* filter)
{
  StageSeconds seconds;
  filter->GetStageSeconds(seconds.data());
  const TraceSummary summary{ InputTitle(request.Input, request.SeriesUID),
    static_cast<int>(filter->GetCenterline()->GetNumberOfLines()),
    static_cast<int>(filter->GetSurface()->GetNumberOfPoints()), filter->GetStopReasonAsString(),
    filter->GetNumberOfSelfIntersections(), filter->GetSupport() };
  return TraceText(summary, seconds);
}

} // namespace

void Trace(const TraceRequest& given)
{
  TraceRequest request = given;
  if (request.Quiet)
  {
    ProgressBar::Disable();
  }
  ValidateRequest(request);
  OutputFiles files;
  AnnounceOutputs(request, files.Announcing());
  vtkNew<vtkFlipFreeVesselSegmentation> filter;
  Configure(request, filter);
  if (!request.Snapshot.empty())
  {
    RequireDisplay();
  }
  vtkSMPTools::Initialize(request.Threads);
  const vtkSmartPointer<vtkImageData> image = ReadVolume(request.Input, request.SeriesUID);
  request.SeriesUID = SeriesOf(image);
  filter->SetInputData(image);
  try
  {
    Run(filter, "tracing", OptionNames(FlipFree::VesselParameters()));
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + request.Input + "': " + failure.what());
  }
  if (filter->GetStopReason() == vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
  {
    throw Failure("'" + request.Input + "': No segmentation: " + NoVesselBoundaryText);
  }
  WriteResults(request, filter, image, files);
  files.Commit();
  if (!request.Quiet)
  {
    PrintSummary(SummaryOf(request, filter));
  }
}

} // namespace Command
