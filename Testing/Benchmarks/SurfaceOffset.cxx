#include "SurfaceOffset.h"

#include "LabelAdapter.h"
#include "Measures/MaskSurface.h"
#include "Mesh/SurfaceTopology.h"
#include "MeshAdapter.h"

#include "vtkImageData.h"
#include "vtkImplicitPolyDataDistance.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cmath>

namespace
{

constexpr double FARTHEST = 5; // mm

vtkNew<vtkPolyData> PolyDataOf(const FlipFree::MaskSurface& surface)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(FlipFree::MakePoints(surface.Points));
  data->SetPolys(FlipFree::MakePolys(FlipFree::FacesOf(surface.Triangles)));
  return data;
}

} // namespace

double MeanSignedOffset(vtkPolyData* surface, vtkImageData* reference, int label)
{
  const auto outline = PolyDataOf(
    FlipFree::SurfaceOf(FlipFree::LabelVolumeOf(reference, "the reference").MaskOf(label)));
  vtkNew<vtkImplicitPolyDataDistance> distance;
  distance->SetInput(outline);
  double sum = 0;
  int count = 0;
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    const double offset = distance->EvaluateFunction(surface->GetPoint(point));
    if (std::abs(offset) <= FARTHEST)
    {
      sum += offset;
      ++count;
    }
  }
  return count ? sum / count : 0;
}
