#include "SegmentationReport.h"

#include "MeshAdapter.h"
#include "Messages.h"
#include "Summary.h"

#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include "Mesh/SurfaceTopology.h"

#include <cstdio>

namespace Command
{
namespace
{

std::string SummaryOf(const OrganFilter& filter, const SegmentRequest& request,
  double readingSeconds)
{
  const OrganSummary summary{ TitleOf(request, ""), VolumeInMilliliters(filter.Surface()),
    static_cast<int>(filter.Convergence()->GetNumberOfRows()), filter.StopReasonText(),
    filter.SelfIntersections() };
  if (auto* const vessel = vtkFlipFreeVesselSegmentation::SafeDownCast(filter.Algorithm()))
  {
    return VesselText(summary, vessel->GetSupport(), readingSeconds, filter.StageSeconds());
  }
  auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(filter.Algorithm());
  return OrganText(summary, organ->GetConfidence(), readingSeconds, filter.StageSeconds());
}

bool IsGuarded(const OrganFilter& filter)
{
  auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(filter.Algorithm());
  return !organ || organ->GetDeform()->GetGuard();
}

} // namespace

void PrintSummary(const std::string& text)
{
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

double VolumeInMilliliters(vtkPolyData* surface)
{
  FlipFree::PointList copy;
  return FlipFree::EnclosedVolume(FlipFree::ViewPoints(surface, copy),
           FlipFree::Triangulate(FlipFree::CopyPolys(surface))) /
    1000;
}

void Report(const OrganFilter& filter, const SegmentRequest& request, double readingSeconds)
{
  if (!IsGuarded(filter) && filter.SelfIntersections() == 0)
  {
    PrintWarning(NotCertifiedText);
  }
  if (!request.Quiet)
  {
    PrintSummary(SummaryOf(filter, request, readingSeconds));
  }
}

} // namespace Command
