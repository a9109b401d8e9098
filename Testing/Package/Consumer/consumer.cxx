#include <FlipFreeErrorCode.h>

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkQuadSphereSource.h>

#include <cmath>
#include <iostream>

int main()
{
  vtkNew<vtkQuadSphereSource> bad;
  bad->GlobalWarningDisplayOff();
  bad->SetCenter(0, 0, std::nan(""));
  bad->Update();
  const auto expected = static_cast<unsigned long>(FlipFree::ErrorCode::NonFiniteValue);
  if (bad->GetErrorCode() != vtkErrorCode::UserError + expected)
  {
    std::cerr << "the error code is " << bad->GetErrorCode() << "\n";
    return 1;
  }
  vtkNew<vtkQuadSphereSource> sphere;
  sphere->Update();
  std::cout << sphere->GetOutput()->GetNumberOfPoints() << " points\n";
  return 0;
}
