#include "vtkFlipFreeLabelSurfaces.h"

#include "ContourMeshAdapter.h"
#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "LabelAdapter.h"
#include "LabelSurface/LabelColumns.h"
#include "LabelSurface/LabelSurfaceParameters.h"
#include "PipelineAdapter.h"
#include "StageProperties.h"
#include "TableAdapter.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <map>

vtkStandardNewMacro(vtkFlipFreeLabelSurfaces);

namespace
{

using LabelNames = std::map<int, std::string>;

// By the field data of the label map.
LabelNames NamesIn(vtkImageData* image)
{
  LabelNames names;
  vtkFieldData* const fields = image->GetFieldData();
  vtkDataArray* const labels = fields->GetArray("SegmentLabels");
  auto* const texts = vtkStringArray::SafeDownCast(fields->GetAbstractArray("SegmentNames"));
  if (labels && texts && labels->GetNumberOfTuples() == texts->GetNumberOfValues())
  {
    for (vtkIdType index = 0; index < texts->GetNumberOfValues(); ++index)
    {
      names.emplace(static_cast<int>(labels->GetTuple1(index)), texts->GetValue(index));
    }
  }
  return names;
}

// In single precision, which holds the points.
void AttachTriangles(const FlipFree::PointList& points, const FlipFree::TriangleList& triangles,
  vtkPolyData* surface)
{
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(points.rows());
  std::transform(points.data(), points.data() + points.size(), coordinates->GetPointer(0),
    [](double value) { return static_cast<float>(value); });
  vtkNew<vtkPoints> vertices;
  vertices->SetData(coordinates);
  surface->SetPoints(vertices);

  vtkNew<vtkIdTypeArray> connectivity;
  connectivity->SetNumberOfValues(triangles.size());
  std::copy(triangles.data(), triangles.data() + triangles.size(), connectivity->GetPointer(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, connectivity);
  surface->SetPolys(cells);
  FlipFree::AttachCertificate(true, surface);
}

void FillWalls(const FlipFree::LabelSurfaces& surfaces, vtkPolyData* walls)
{
  AttachTriangles(surfaces.Walls.Points, surfaces.Walls.Triangles, walls);
  vtkNew<vtkIntArray> labels;
  labels->SetName("BoundaryLabels");
  labels->SetNumberOfComponents(2);
  labels->SetNumberOfTuples(static_cast<vtkIdType>(surfaces.Walls.Labels.size()));
  int* next = labels->GetPointer(0);
  for (const auto& pair : surfaces.Walls.Labels)
  {
    *next++ = surfaces.Values[pair[0]];
    *next++ = surfaces.Values[pair[1]];
  }
  walls->GetCellData()->AddArray(labels);
  FlipFree::AddFieldValues("WrongVoxels", { static_cast<double>(surfaces.WrongVoxels) }, walls);
  FlipFree::AddFieldValues("GreatestDistance", { surfaces.GreatestDistance }, walls);
  FlipFree::AddFieldValues("CollapseDistance", { surfaces.CollapseDistance }, walls);
}

void FillSurfaces(const FlipFree::LabelSurfaces& surfaces, const LabelNames& names,
  vtkMultiBlockDataSet* blocks)
{
  const FlipFree::TrianglesByLabel triangles(surfaces.Walls, surfaces.Values.size());
  for (unsigned int index = 0; index + 1 < surfaces.Values.size(); ++index)
  {
    const int label = surfaces.Values[index + 1];
    const FlipFree::LabelBoundary boundary = triangles.BoundaryOf(static_cast<int>(index) + 1);
    vtkNew<vtkPolyData> surface;
    AttachTriangles(boundary.Points, boundary.Triangles, surface);
    FlipFree::AddFieldValues("Label", { static_cast<double>(label) }, surface);
    blocks->SetBlock(index, surface);
    const auto name = names.find(label);
    blocks->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(),
      name == names.end() ? std::to_string(label) : name->second);
  }
}

void FillTable(const std::vector<FlipFree::LabelMeasures>& rows, const LabelNames& names,
  vtkTable* table)
{
  vtkNew<vtkStringArray> texts;
  texts->SetName("Name");
  for (const FlipFree::LabelMeasures& row : rows)
  {
    const auto name = names.find(row.Label);
    texts->InsertNextValue(name == names.end() ? std::string() : name->second);
  }
  for (const FlipFree::TableColumn<FlipFree::LabelMeasures>& column : FlipFree::LabelColumns())
  {
    if (column.IsCount)
    {
      FlipFree::AddColumnOf<vtkIdTypeArray>(table, column, rows); // a label may have many voxels
    }
    else
    {
      FlipFree::AddColumnOf<vtkDoubleArray>(table, column, rows);
    }
    if (table->GetNumberOfColumns() == 1)
    {
      table->AddColumn(texts);
    }
  }
}

} // namespace

#define FLIPFREE_STAGE vtkFlipFreeLabelSurfaces
#define PROPERTIES(P) FLIPFREE_LABEL_SURFACE_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkFlipFreeLabelSurfaces::vtkFlipFreeLabelSurfaces()
  : Settings(std::make_unique<FlipFree::LabelSurfaceSettings>())
{
  this->SetNumberOfOutputPorts(3);
}

vtkFlipFreeLabelSurfaces::~vtkFlipFreeLabelSurfaces() = default;

void vtkFlipFreeLabelSurfaces::AddLabel(int label)
{
  this->Labels.push_back(label);
  this->Modified();
}

void vtkFlipFreeLabelSurfaces::RemoveAllLabels()
{
  if (!this->Labels.empty())
  {
    this->Labels.clear();
    this->Modified();
  }
}

int vtkFlipFreeLabelSurfaces::GetLabel(int index) const
{
  return index >= 0 && index < this->GetNumberOfLabels() ? this->Labels[index] : -1;
}

vtkMultiBlockDataSet* vtkFlipFreeLabelSurfaces::GetSurfaces()
{
  return vtkMultiBlockDataSet::SafeDownCast(this->GetOutputDataObject(1));
}

vtkTable* vtkFlipFreeLabelSurfaces::GetTable()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

int vtkFlipFreeLabelSurfaces::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkFlipFreeLabelSurfaces::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkPolyData", "vtkMultiBlockDataSet", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

int vtkFlipFreeLabelSurfaces::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector*)
{
  FlipFree::RequestWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

int vtkFlipFreeLabelSurfaces::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->NumberOfWrongVoxels = 0;
  this->GreatestDistance = 0;
  this->CollapseDistance = 0;
  for (int port = 0; port < 3; ++port)
  {
    vtkDataObject::GetData(outputs, port)->Initialize();
  }
  vtkImageData* const image = vtkImageData::GetData(inputs[0]);
  try
  {
    const std::string name = "the label map{ on port 0}";
    FlipFree::RequireLabelMap(image, name);
    const FlipFree::LabelSurfaces surfaces = FlipFree::VisitVoxels(image, name,
      [&](const auto& view)
      {
        return FlipFree::MakeLabelSurfaces(
          FlipFree::MakeLabelGrid(view, this->Labels, name, FlipFree::SMPFor), view.Geometry,
          *this->Settings, FlipFree::SMPFor, FlipFree::MonitorOf(this));
      });
    if (!surfaces.Complete || FlipFree::IsAborted(this))
    {
      return 1;
    }
    this->NumberOfWrongVoxels = static_cast<vtkIdType>(surfaces.WrongVoxels);
    this->GreatestDistance = surfaces.GreatestDistance;
    this->CollapseDistance = surfaces.CollapseDistance;
    const LabelNames names = NamesIn(image);
    FillWalls(surfaces, vtkPolyData::GetData(outputs, 0));
    FillSurfaces(surfaces, names, vtkMultiBlockDataSet::GetData(outputs, 1));
    FillTable(surfaces.Measures, names, vtkTable::GetData(outputs, 2));
  }
  catch (const std::exception& error)
  {
    for (int port = 0; port < 3; ++port)
    {
      vtkDataObject::GetData(outputs, port)->Initialize();
    }
    FlipFreeErrorMacro("No surfaces of labels: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeLabelSurfaces::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Labels:" << (this->Labels.empty() ? " all" : "");
  for (const int label : this->Labels)
  {
    os << " " << label;
  }
  os << "\n";
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
  os << indent << "NumberOfWrongVoxels: " << this->NumberOfWrongVoxels << "\n";
  os << indent << "GreatestDistance: " << this->GreatestDistance << "\n";
  os << indent << "CollapseDistance: " << this->CollapseDistance << "\n";
}

#undef PROPERTIES
#undef FLIPFREE_STAGE
