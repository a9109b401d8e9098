#include "SurfaceOffset.h"

#include "LabelAdapter.h"
#include "Measures/LabelSurface.h"
#include "MeshAdapter.h"

#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkImplicitPolyDataDistance.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cmath>

namespace
{

constexpr double FARTHEST = 5; // mm

vtkNew<vtkPolyData> PolyDataOf(const FlipFree::LabelSurface& surface)
{
  vtkNew<vtkCellArray> triangles;
  for (const auto& triangle : surface.Triangles.rowwise())
  {
    triangles->InsertNextCell({ triangle(0), triangle(1), triangle(2) });
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(FlipFree::MakePoints(surface.Points));
  data->SetPolys(triangles);
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
