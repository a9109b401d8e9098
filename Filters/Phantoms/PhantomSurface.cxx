#include "PhantomSurface.h"

#include "ExecutionAdapter.h"

#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"

namespace FlipFree
{
vtkSmartPointer<vtkPolyData> MakePhantomSurface(const ImplicitShape& shape, const Ball& ball,
  const ImageGeometry& geometry)
{
  using Eigen::Vector3d;
  const int cells = 128;
  const int size = cells + 1;
  const double cell = 2 * ball.Radius / cells;
  const Vector3d first = ball.Center - Vector3d::Constant(ball.Radius);
  vtkNew<vtkImageData> samples;
  samples->SetDimensions(size, size, size);
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfValues(samples->GetNumberOfPoints());
  SMPFor(0, size,
    [&](std::ptrdiff_t from, std::ptrdiff_t to)
    {
      float* value = values->GetPointer(from * size * size);
      for (std::ptrdiff_t k = from; k < to; ++k)
      {
        for (int j = 0; j < size; ++j)
        {
          for (int i = 0; i < size; ++i)
          {
            *value++ = static_cast<float>(-shape(first + cell * Vector3d(i, j, k)));
          }
        }
      }
    });
  samples->GetPointData()->SetScalars(values);

  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(samples);
  contour->SetValue(0, 0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  // Contours are counter-clockwise seen from the lesser samples, which here is from outside; a
  // left-handed grid mirrors them.
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputConnection(contour->GetOutputPort());
  reverse->ReverseNormalsOff();
  reverse->SetReverseCells(geometry.Direction.determinant() < 0);
  reverse->Update();

  vtkSmartPointer<vtkPolyData> surface = reverse->GetOutput();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(surface->GetNumberOfPoints());
  for (vtkIdType vertex = 0; vertex < points->GetNumberOfPoints(); ++vertex)
  {
    Vector3d at;
    surface->GetPoint(vertex, at.data());
    // The contour is interpolated between samples.
    const Vector3d onSurface = ProjectOntoSurface(shape, first + cell * at, 1e-4 * cell);
    points->SetPoint(vertex, GridToPhysical(geometry, onSurface).data());
  }
  surface->SetPoints(points);
  return surface;
}

} // namespace FlipFree
