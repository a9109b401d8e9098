/**
 * A deformed mesh with the checkerboard it was born with, as Fig. 1 of the paper draws them.
 */
#ifndef FlipFreeCheckerboardView_h
#define FlipFreeCheckerboardView_h

#include "ImageTest.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <vector>

namespace ImageTest
{

/// Cuts each face into one quad per corner, colored by the corner's value in the array
/// Checkerboard: the fields' borders then run midway between vertices, sharp.
inline vtkSmartPointer<vtkPolyData> CheckerboardOf(vtkPolyData* mesh)
{
  vtkDataArray* checkerboard = mesh->GetPointData()->GetArray("Checkerboard");
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType face = 0; face < mesh->GetNumberOfPolys(); ++face)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    mesh->GetPolys()->GetCellAtId(face, size, corners);
    // Center, then per corner the corner itself and the middle of the edge that follows it.
    const vtkIdType center = points->InsertNextPoint(0, 0, 0);
    double sum[3] = { 0, 0, 0 };
    for (vtkIdType corner = 0; corner < size; ++corner)
    {
      double here[3];
      double next[3];
      mesh->GetPoint(corners[corner], here);
      mesh->GetPoint(corners[(corner + 1) % size], next);
      points->InsertNextPoint(here);
      points->InsertNextPoint((here[0] + next[0]) / 2, (here[1] + next[1]) / 2,
        (here[2] + next[2]) / 2);
      for (int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += here[axis] / static_cast<double>(size);
      }
    }
    points->SetPoint(center, sum);
    for (vtkIdType corner = 0; corner < size; ++corner)
    {
      const vtkIdType before = (corner + size - 1) % size;
      quads->InsertNextCell(
        { center, center + 2 * before + 2, center + 2 * corner + 1, center + 2 * corner + 2 });
      const Color& color = checkerboard->GetTuple1(corners[corner]) > 0 ? Blue : Sand;
      colors->InsertNextTuple3(255 * color[0], 255 * color[1], 255 * color[2]);
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(quads);
  result->GetCellData()->SetScalars(colors);
  return result;
}

/// The mesh's faces in the colors of its checkerboard, and its edges as lines.
inline void AddCheckerboard(vtkRenderer* view, vtkPolyData* mesh)
{
  AddSurface(view, CheckerboardOf(mesh), White)->GetMapper()->ScalarVisibilityOn();
  AddLines(view, mesh, Ink);
}

} // namespace ImageTest

#endif
