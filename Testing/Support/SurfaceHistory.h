/**
 * The surfaces of all iterations of a segmentation with history, and the corners that flip between
 * them.
 */
#ifndef FlipFreeSurfaceHistory_h
#define FlipFreeSurfaceHistory_h

#include "vtkFlipFreeSegmentation.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkSurfaceValidity.h"
#include "vtkTable.h"

#include <vector>

namespace FlipFree
{

/// One of the measures of vtkSurfaceValidity.
inline int CountDefects(const char* column, vtkPolyData* surface, vtkPolyData* before = nullptr)
{
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(surface);
  if (before)
  {
    validity->SetReferenceSurfaceData(before);
  }
  validity->Update();
  return validity->GetMeasures()->GetValueByName(0, column).ToInt();
}

inline std::vector<vtkSmartPointer<vtkPolyData>> HistoryOf(vtkFlipFreeSegmentation* filter)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  vtkInformation* info = filter->GetOutputInformation(0);
  const int size = info->Length(Pipeline::TIME_STEPS());
  for (int step = 0; step < size; ++step)
  {
    filter->UpdateTimeStep(info->Get(Pipeline::TIME_STEPS(), step));
    surfaces.push_back(vtkSmartPointer<vtkPolyData>::New());
    surfaces.back()->DeepCopy(filter->GetSurface());
  }
  return surfaces;
}

/// Corners whose normal turned by 90 degrees or more in one step, all steps together. Where the
/// mesh was refined, it has no corners in common with the one before.
inline int CountFlippedCorners(const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces)
{
  int flipped = 0;
  for (std::size_t step = 1; step < surfaces.size(); ++step)
  {
    if (surfaces[step]->GetNumberOfPoints() == surfaces[step - 1]->GetNumberOfPoints())
    {
      flipped += CountDefects("FlippedCorners", surfaces[step], surfaces[step - 1]);
    }
  }
  return flipped;
}

} // namespace FlipFree

#endif
