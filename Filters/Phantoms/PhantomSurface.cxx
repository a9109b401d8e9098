#include "PhantomSurface.h"

#include "ExecutionAdapter.h"
#include "MeshAdapter.h"
#include "Phantom/ShapeCube.h"

#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"

namespace FlipFree
{
vtkSmartPointer<vtkPolyData> MakePhantomSurface(const ImplicitShape& shape, const Ball& ball,
  const ImageGeometry& geometry)
{
  const ShapeCube cube = CubeAround(ball);
  vtkNew<vtkImageData> samples;
  samples->SetDimensions(ShapeCube::Size, ShapeCube::Size, ShapeCube::Size);
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfValues(samples->GetNumberOfPoints());
  SampleInCube(shape, cube, SMPFor, values->GetPointer(0));
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
  surface->SetPoints(MakePoints(OntoSurface(shape, cube, CopyPoints(surface), geometry)));
  return surface;
}

} // namespace FlipFree
