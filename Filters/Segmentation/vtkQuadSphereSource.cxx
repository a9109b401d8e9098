#include "vtkQuadSphereSource.h"

#include "FilterReport.h"
#include "Mesh/QuadSphere.h"
#include "MeshAdapter.h"
#include "MessageText.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

vtkStandardNewMacro(vtkQuadSphereSource);

vtkQuadSphereSource::vtkQuadSphereSource()
{
  this->SetNumberOfInputPorts(0);
}

int vtkQuadSphereSource::RequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!Eigen::Vector3d(this->Center).allFinite() || !std::isfinite(this->Radius))
  {
    FlipFreeErrorMacro("No sphere: ",
      FlipFree::Error(FlipFree::ErrorCode::NonFiniteValue,
        "{Center} " + FlipFree::TextOf(Eigen::Vector3d(this->Center)) + " and {Radius} (" +
          FlipFree::TextOf(this->Radius) + ") must be finite numbers; set them, in millimeters"),
      ".");
    return 0;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    const FlipFree::QuadSphere sphere =
      FlipFree::MakeQuadSphere(this->Resolution, Eigen::Vector3d(this->Center), this->Radius,
        static_cast<FlipFree::QuadSphereSpacing>(this->Spacing));
    output->SetPoints(FlipFree::MakePoints(sphere.Points));
    output->SetPolys(FlipFree::MakePolys(sphere.Faces));

    vtkNew<vtkUnsignedCharArray> checkerboard;
    checkerboard->SetName("Checkerboard");
    checkerboard->SetNumberOfValues(sphere.Points.rows());
    const std::vector<unsigned char> fields = FlipFree::CheckerboardOf(sphere);
    std::copy(fields.begin(), fields.end(), checkerboard->GetPointer(0));
    output->GetPointData()->SetScalars(checkerboard);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("No sphere: ", error,
      "; lower {Resolution} (" + std::to_string(this->Resolution) +
        "), on which the memory depends.");
    return 0;
  }
  return 1;
}

void vtkQuadSphereSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Spacing: " << this->Spacing << "\n";
}
