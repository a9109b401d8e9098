#include "vtkConstraintPointSource.h"

#include "FilterReport.h"
#include "Image/PointConstraint.h"
#include "MessageText.h"
#include "StageProperties.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

vtkStandardNewMacro(vtkConstraintPointSource);

static_assert(vtkConstraintPointSource::SEED == static_cast<int>(FlipFree::ConstraintKind::Seed) &&
    vtkConstraintPointSource::BOUNDARY == static_cast<int>(FlipFree::ConstraintKind::Boundary),
  "the public enumeration follows the kernel's");

vtkConstraintPointSource::vtkConstraintPointSource()
{
  this->SetNumberOfInputPorts(0);
}

void vtkConstraintPointSource::SetRadius(double value)
{
  FlipFree::SetSeedRadius(this, value, this->Radius);
}

int vtkConstraintPointSource::RequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->Enabled)
  {
    return 1;
  }
  const bool isSeed = this->Kind == SEED;
  if (!Eigen::Vector3d(this->Position).allFinite())
  {
    FlipFreeErrorMacro("No point: ",
      FlipFree::Error(FlipFree::ErrorCode::NonFiniteValue,
        "{Position} " + FlipFree::TextOf(Eigen::Vector3d(this->Position)) +
          " must be finite numbers; set it, in millimeters"),
      ".");
    return 0;
  }
  if (isSeed && !std::isfinite(this->Radius))
  {
    FlipFreeErrorMacro("No point: ",
      FlipFree::Error(FlipFree::ErrorCode::NonFiniteValue,
        "{Radius} (" + FlipFree::TextOf(this->Radius) +
          ") of a seed must be a finite number; set it, in millimeters"),
      ".");
    return 0;
  }
  vtkPolyData* const output = vtkPolyData::GetData(outputVector);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble(); // a handle's place, to the bit
  points->InsertNextPoint(this->Position);
  output->SetPoints(points);
  vtkNew<vtkCellArray> vertices; // to be seen
  const vtkIdType vertex = 0;
  vertices->InsertNextCell(1, &vertex);
  output->SetVerts(vertices);

  vtkNew<vtkUnsignedCharArray> kind;
  kind->SetName("Constraint");
  kind->InsertNextValue(static_cast<unsigned char>(this->Kind));
  output->GetPointData()->AddArray(kind);
  vtkNew<vtkDoubleArray> radius;
  radius->SetName("Radius");
  radius->InsertNextValue(isSeed ? this->Radius : 0);
  output->GetPointData()->AddArray(radius);
  vtkNew<vtkIntArray> organ;
  organ->SetName("Organ");
  organ->InsertNextValue(this->Organ);
  output->GetPointData()->AddArray(organ);
  return 1;
}

void vtkConstraintPointSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kind: " << this->Kind << "\n";
  os << indent << "Position: (" << this->Position[0] << ", " << this->Position[1] << ", "
     << this->Position[2] << ")\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Organ: " << this->Organ << "\n";
  os << indent << "Enabled: " << this->Enabled << "\n";
}
