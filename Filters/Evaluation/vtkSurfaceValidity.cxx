#include "vtkSurfaceValidity.h"

#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "Measures/ScoreSummary.h"
#include "Measures/SurfaceValidity.h"
#include "SurfaceAdapter.h"
#include "TableAdapter.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

vtkStandardNewMacro(vtkSurfaceValidity);

namespace
{

// Cells are ordered vertices, lines, polygons; what is not a polygon has no defect.
void AddCellArrays(vtkPolyData* output, const FlipFree::SurfaceValidity& validity)
{
  const vtkIdType firstPolygon = output->GetNumberOfVerts() + output->GetNumberOfLines();
  vtkNew<vtkUnsignedCharArray> defects;
  defects->SetName("Defects");
  defects->SetNumberOfValues(output->GetNumberOfCells());
  defects->FillValue(0);
  std::copy(validity.Defects.begin(), validity.Defects.end(), defects->GetPointer(firstPolygon));
  vtkNew<vtkDoubleArray> jacobians;
  jacobians->SetName("ScaledJacobian");
  jacobians->SetNumberOfValues(output->GetNumberOfCells());
  jacobians->FillValue(1);
  std::copy(validity.Quality.ScaledJacobians.begin(), validity.Quality.ScaledJacobians.end(),
    jacobians->GetPointer(firstPolygon));
  output->GetCellData()->AddArray(defects);
  output->GetCellData()->AddArray(jacobians);
}

void FillTable(vtkTable* table, const FlipFree::SurfaceValidity& validity)
{
  using FlipFree::AddColumn;
  const FlipFree::SurfaceQuality& quality = validity.Quality;
  AddColumn(table, "Valid", validity.IsValid() ? 1 : 0);
  AddColumn(table, "SelfIntersections", validity.SelfIntersections);
  AddColumn(table, "FlippedCorners", validity.FlippedCorners);
  AddColumn(table, "EulerNumber", quality.Topology.EulerNumber());
  AddColumn(table, "BoundaryEdges", quality.Topology.BoundaryEdges);
  AddColumn(table, "NonManifoldEdges", quality.Topology.NonManifoldEdges);
  AddColumn(table, "MisorientedEdges", quality.Topology.MisorientedEdges);
  AddColumn(table, "MinimumScaledJacobian", quality.MinimumScaledJacobian);
  AddColumn(table, "FirstPercentileScaledJacobian", quality.FirstPercentileScaledJacobian);
  AddColumn(table, "MinimumDihedralAngle", quality.MinimumDihedralAngle);
  AddColumn(table, "MinimumGap", validity.MinimumGap);
  AddColumn(table, "EdgeLengthVariation", quality.EdgeLengthVariation);
}

} // namespace

vtkSurfaceValidity::vtkSurfaceValidity()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

void vtkSurfaceValidity::SetReferenceSurfaceData(vtkPolyData* surface)
{
  this->SetInputData(1, surface);
}

void vtkSurfaceValidity::SetReferenceSurfaceConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

vtkTable* vtkSurfaceValidity::GetMeasures()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

bool vtkSurfaceValidity::IsValid()
{
  vtkTable* measures = this->GetMeasures();
  return measures->GetNumberOfRows() == 1 && measures->GetValueByName(0, "Valid").ToInt() == 1;
}

int vtkSurfaceValidity::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkSurfaceValidity::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkTable");
  return 1;
}

int vtkSurfaceValidity::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* inputReference = vtkPolyData::GetData(inputVector[1]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkTable* table = vtkTable::GetData(outputVector, 1);
  output->Initialize();
  table->Initialize();
  this->Summary.clear();
  try
  {
    const FlipFree::PolygonalSurface surface =
      FlipFree::SurfaceOf(input, "the surface{ on port 0}");
    FlipFree::PolygonalSurface reference;
    if (inputReference)
    {
      reference = FlipFree::SurfaceOf(inputReference, "the reference surface{ on port 1}");
      if (reference.Faces.Connectivity != surface.Faces.Connectivity ||
        reference.Faces.Offsets != surface.Faces.Offsets)
      {
        throw FlipFree::Error(FlipFree::ErrorCode::GeometryMismatch,
          "the reference surface{ on port 1} has other polygons than the "
          "surface{ on port 0}; connect the same mesh at other positions");
      }
    }
    const FlipFree::SurfaceValidity validity =
      FlipFree::MeasureValidity(surface.Points, surface.Faces,
        inputReference ? &reference.Points : nullptr, FlipFree::SMPFor, FlipFree::MonitorOf(this));
    if (!validity.Complete)
    {
      return 1;
    }
    output->ShallowCopy(input);
    AddCellArrays(output, validity);
    FillTable(table, validity);
    this->Summary = FlipFree::SummaryOf(validity);
  }
  catch (const std::exception& error)
  {
    FlipFreeErrorMacro("No measures of validity: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkSurfaceValidity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
