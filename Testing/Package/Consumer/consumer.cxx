#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkQuadSphereSource.h>

#include <iostream>

int main()
{
  vtkNew<vtkQuadSphereSource> sphere;
  sphere->Update();
  std::cout << sphere->GetOutput()->GetNumberOfPoints() << " points\n";
  return 0;
}
