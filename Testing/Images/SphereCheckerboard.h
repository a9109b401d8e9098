/**
 * The checkerboard of the sphere on a surface that has grown from it, level by level.
 */
#ifndef FlipFreeSphereCheckerboard_h
#define FlipFreeSphereCheckerboard_h

#include "vtkFlipFreeRefinement.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkQuadSphereSource.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"
#include "vtkUnsignedCharArray.h"

namespace ImageTest
{

/// Gives the segmentation's surface the array Checkerboard. Refinement numbers vertices anew, so a
/// sphere is refined in the same way, and each of its vertices takes the value of the nearest one
/// on a sphere that was made fine.
inline vtkSmartPointer<vtkPolyData> WithCheckerboard(vtkFlipFreeSegmentation* segmentation)
{
  vtkNew<vtkQuadSphereSource> fine;
  fine->SetResolution(segmentation->GetResolution());
  fine->Update();
  vtkNew<vtkStaticPointLocator> nearest;
  nearest->SetDataSet(fine->GetOutput());
  vtkDataArray* pattern = fine->GetOutput()->GetPointData()->GetArray("Checkerboard");

  vtkNew<vtkQuadSphereSource> coarse;
  coarse->SetResolution(segmentation->GetResolution() >> (segmentation->GetLevels() - 1));
  coarse->Update();
  vtkSmartPointer<vtkPolyData> sphere = coarse->GetOutput();
  for (int level = 1; level < segmentation->GetLevels(); ++level)
  {
    vtkNew<vtkFlipFreeRefinement> refine;
    refine->SetInputData(sphere);
    refine->Update();
    sphere = refine->GetOutput();
  }

  vtkNew<vtkUnsignedCharArray> checkerboard;
  checkerboard->SetName("Checkerboard");
  for (vtkIdType vertex = 0; vertex < sphere->GetNumberOfPoints(); ++vertex)
  {
    const vtkIdType twin = nearest->FindClosestPoint(sphere->GetPoint(vertex));
    checkerboard->InsertNextValue(static_cast<unsigned char>(pattern->GetTuple1(twin)));
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(segmentation->GetSurface());
  surface->GetPointData()->AddArray(checkerboard);
  return surface;
}

} // namespace ImageTest

#endif
