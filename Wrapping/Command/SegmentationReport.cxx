#include "SegmentationReport.h"

#include "MeshAdapter.h"
#include "Messages.h"

#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include "Mesh/SurfaceTopology.h"

#include <cmath>
#include <cstdio>

namespace Command
{
namespace
{

/// How far an organ or a vessel can be trusted.
std::string TrustText(const OrganFilter& filter)
{
  auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(filter.Algorithm());
  auto* const vessel = vtkFlipFreeVesselSegmentation::SafeDownCast(filter.Algorithm());
  if (organ)
  {
    return ", confidence " + ConfidenceText(organ->GetConfidence());
  }
  char text[32] = "";
  if (vessel)
  {
    std::snprintf(text, sizeof(text), ", support %.2f", vessel->GetSupport());
  }
  return text;
}

void PrintSummary(const OrganFilter& filter, const SegmentRequest& request, double readingSeconds)
{
  const auto [first, second, third, fourth] = filter.StageSeconds();
  const bool isVessel = request.IsVessel();
  std::printf("%s: volume %.1f ml, %d iterations, %s, %d self-intersections%s; reading %.2f s, "
              "%s %.2f s, %s %.2f s, deformation %.2f s, label map %.2f s\n",
    TitleOf(request, "").c_str(), VolumeInMilliliters(filter.Surface()),
    static_cast<int>(filter.Convergence()->GetNumberOfRows()), filter.StopReasonText().c_str(),
    filter.SelfIntersections(), TrustText(filter).c_str(), readingSeconds,
    isVessel ? "path" : "smoothing", first, isVessel ? "start" : "feature", second, third, fourth);
  std::fflush(stdout);
}

bool IsGuarded(const OrganFilter& filter)
{
  auto* const organ = vtkFlipFreeSegmentation::SafeDownCast(filter.Algorithm());
  return !organ || organ->GetDeform()->GetGuard();
}

} // namespace

std::string ConfidenceText(double confidence)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", std::floor(100 * confidence) / 100);
  return text;
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
    PrintWarning(
      "The surface is not certified: --guard is off. It does not intersect itself, though.");
  }
  if (!request.Quiet)
  {
    PrintSummary(filter, request, readingSeconds);
  }
}

} // namespace Command
