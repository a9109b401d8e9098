#include "vtkFlipFreeOrganGroup.h"

#include "ConstraintPoints.h"
#include "ContourMeshAdapter.h"
#include "ConvergenceTable.h"
#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "PipelineAdapter.h"

#include "Deformation/OrganGroup.h"
#include "Stopwatch.h"

#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkFlipFreeOrganGroup);

namespace
{

const char* const NameOfImage = "the image on port 0";

} // namespace

struct vtkFlipFreeOrganGroup::Internals
{
  FlipFree::NamedConstraints Organs;
  std::vector<FlipFree::VolumeSegmentation> Results; // without surfaces
  std::vector<vtkSmartPointer<vtkTable>> Convergence;

  const FlipFree::VolumeSegmentation* Result(int organ) const
  {
    return organ >= 0 && organ < static_cast<int>(this->Results.size()) ? &this->Results[organ]
                                                                        : nullptr;
  }
};

vtkFlipFreeOrganGroup::vtkFlipFreeOrganGroup()
  : Kept(std::make_unique<Internals>())
  , Parameters(vtkSmartPointer<vtkFlipFreeSegmentation>::New())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
}

vtkFlipFreeOrganGroup::~vtkFlipFreeOrganGroup() = default;

void vtkFlipFreeOrganGroup::SetInputData(vtkImageData* image)
{
  this->SetInputDataObject(0, image);
}

void vtkFlipFreeOrganGroup::SetConstraintData(vtkPointSet* points)
{
  this->SetInputDataObject(1, points);
}

void vtkFlipFreeOrganGroup::AddConstraintData(vtkPointSet* points)
{
  this->AddInputDataObject(1, points);
}

void vtkFlipFreeOrganGroup::AddFixedData(vtkPolyData* surface)
{
  this->AddInputDataObject(2, surface);
}

void vtkFlipFreeOrganGroup::AddOrgan(const char* name, double x, double y, double z, double radius)
{
  this->Kept->Organs.push_back(
    { name ? name : "", { { FlipFree::ConstraintKind::Seed, { x, y, z }, radius } } });
  this->Modified();
}

void vtkFlipFreeOrganGroup::RemoveAllOrgans()
{
  this->Kept->Organs.clear();
  this->Modified();
}

int vtkFlipFreeOrganGroup::GetNumberOfOrgans() const
{
  return static_cast<int>(this->Kept->Organs.size());
}

void vtkFlipFreeOrganGroup::AddPoint(const char* organ, int kind, const double (&point)[3],
  double radius)
{
  const std::string name = organ ? organ : "";
  const auto found = std::find_if(this->Kept->Organs.begin(), this->Kept->Organs.end(),
    [&name](const auto& candidate) { return candidate.first == name; });
  if (found == this->Kept->Organs.end())
  {
    vtkErrorMacro("No point: there is no organ named '" << name << "'; add it by AddOrgan first.");
    return;
  }
  found->second.push_back({ static_cast<FlipFree::ConstraintKind>(kind),
    Eigen::Vector3d(point[0], point[1], point[2]), radius });
  this->Modified();
}

void vtkFlipFreeOrganGroup::AddInsidePoint(const char* organ, double x, double y, double z)
{
  this->AddPoint(organ, static_cast<int>(FlipFree::ConstraintKind::Inside), { x, y, z }, 0);
}

void vtkFlipFreeOrganGroup::AddOutsidePoint(const char* organ, double x, double y, double z)
{
  this->AddPoint(organ, static_cast<int>(FlipFree::ConstraintKind::Outside), { x, y, z }, 0);
}

void vtkFlipFreeOrganGroup::AddBoundaryPoint(const char* organ, double x, double y, double z)
{
  this->AddPoint(organ, static_cast<int>(FlipFree::ConstraintKind::Boundary), { x, y, z }, 0);
}

void vtkFlipFreeOrganGroup::AddSeed(const char* organ, double x, double y, double z, double radius)
{
  this->AddPoint(organ, static_cast<int>(FlipFree::ConstraintKind::Seed), { x, y, z }, radius);
}

vtkFlipFreeSegmentation* vtkFlipFreeOrganGroup::GetParameters() const
{
  return this->Parameters;
}

void vtkFlipFreeOrganGroup::SetParameters(vtkFlipFreeSegmentation* parameters)
{
  if (this->Parameters != parameters)
  {
    this->Parameters =
      parameters ? parameters : vtkSmartPointer<vtkFlipFreeSegmentation>::New().Get();
    this->Modified();
  }
}

vtkMultiBlockDataSet* vtkFlipFreeOrganGroup::GetOutput()
{
  return vtkMultiBlockDataSet::SafeDownCast(this->GetOutputDataObject(0));
}

vtkImageData* vtkFlipFreeOrganGroup::GetLabelMap()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkTable* vtkFlipFreeOrganGroup::GetTable()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

vtkPolyData* vtkFlipFreeOrganGroup::GetSurface(int organ)
{
  vtkMultiBlockDataSet* const surfaces = this->GetOutput();
  return organ >= 0 && organ < static_cast<int>(surfaces->GetNumberOfBlocks())
    ? vtkPolyData::SafeDownCast(surfaces->GetBlock(static_cast<unsigned int>(organ)))
    : nullptr;
}

vtkTable* vtkFlipFreeOrganGroup::GetConvergence(int organ)
{
  return this->Kept->Result(organ) ? this->Kept->Convergence[organ].Get() : nullptr;
}

int vtkFlipFreeOrganGroup::GetStopReason(int organ) const
{
  const auto* const result = this->Kept->Result(organ);
  return result ? static_cast<int>(result->Organ.Reason) : vtkFlipFreeSegmentation::NOT_RUN;
}

const char* vtkFlipFreeOrganGroup::GetStopReasonAsString(int organ) const
{
  return FlipFree::ToString(static_cast<FlipFree::StopReason>(this->GetStopReason(organ)));
}

double vtkFlipFreeOrganGroup::GetConfidence(int organ) const
{
  const auto* const result = this->Kept->Result(organ);
  return result ? result->Confidence.OfSurface : -1;
}

int vtkFlipFreeOrganGroup::GetNumberOfSelfIntersections(int organ) const
{
  const auto* const result = this->Kept->Result(organ);
  return result ? static_cast<int>(result->Organ.SelfIntersections) : -1;
}

vtkMTimeType vtkFlipFreeOrganGroup::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Parameters->GetMTime());
}

int vtkFlipFreeOrganGroup::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkImageData", "vtkPointSet", "vtkPolyData" };
  info->Set(INPUT_REQUIRED_DATA_TYPE(), types[port]);
  info->Set(INPUT_IS_OPTIONAL(), port > 0);
  info->Set(INPUT_IS_REPEATABLE(), port > 0);
  return 1;
}

int vtkFlipFreeOrganGroup::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkMultiBlockDataSet", "vtkImageData", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

vtkTypeBool vtkFlipFreeOrganGroup::ProcessRequest(vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    // Of these types; the default pipeline makes none of several blocks.
    for (int port = 0; port < 3; ++port)
    {
      vtkInformation* const info = outputs->GetInformationObject(port);
      if (!info->Get(vtkDataObject::DATA_OBJECT()))
      {
        vtkSmartPointer<vtkDataObject> output;
        port == 0     ? output = vtkSmartPointer<vtkMultiBlockDataSet>::New()
          : port == 1 ? output = vtkSmartPointer<vtkImageData>::New()
                      : output = vtkSmartPointer<vtkTable>::New();
        info->Set(vtkDataObject::DATA_OBJECT(), output);
      }
    }
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    FlipFree::AnnounceLabelMap(inputs[0]->GetInformationObject(0),
      outputs->GetInformationObject(1));
    return 1;
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    FlipFree::RequestWholeExtent(inputs[0]->GetInformationObject(0));
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(inputs, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkFlipFreeOrganGroup::RequestData(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const auto clear = [this, outputs]
  {
    for (int port = 0; port < 3; ++port)
    {
      vtkDataObject::GetData(outputs, port)->Initialize();
    }
    this->Kept->Results.clear();
    this->Kept->Convergence.clear();
    std::fill_n(this->StageSeconds, 4, 0.0);
  };
  clear();
  try
  {
    this->Segment(inputs, outputs);
  }
  catch (const std::exception& error)
  {
    clear();
    vtkErrorMacro("No segmentation: " << error.what() << ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeOrganGroup::Segment(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* const image = vtkImageData::GetData(inputs[0]);
  this->Parameters->RequireProperties();
  FlipFree::RequireGrayImage(image, NameOfImage);
  FlipFree::NamedConstraints named = this->Kept->Organs;
  FlipFree::AddConstraintsOf(inputs[1], 1, named);
  if (this->LabelValue + static_cast<int>(named.size()) > 256)
  {
    throw std::invalid_argument("labels go up to 255, which leaves none for " + named.back().first +
      "; lower LabelValue, or remove organs");
  }
  std::vector<FlipFree::SeededOrgan> organs;
  std::vector<FlipFree::ConstraintList> constraints;
  for (const auto& [name, list] : named)
  {
    organs.push_back({ name, {} });
    constraints.push_back(list);
    FlipFree::TakeSeed(name, organs.back().Seed, constraints.back());
  }
  std::vector<FlipFree::FixedSurface> fixed;
  for (int index = 0; index < inputs[2]->GetNumberOfInformationObjects(); ++index)
  {
    const std::string name = "the fixed surface " + std::to_string(index + 1) + " on port 2";
    fixed.push_back(
      { name, FlipFree::DeformableSurfaceOf(vtkPolyData::GetData(inputs[2], index), name, true) });
  }
  FlipFree::OrganGroup group(FlipFree::GrayVolumeOf(image, NameOfImage), NameOfImage, organs,
    std::move(fixed), this->Parameters->GetSettings(), FlipFree::SMPThreading());
  this->Kept->Results = group.Segment(constraints, FlipFree::MonitorOf(this, 0, 0.95),
    [](std::size_t, const auto&, const auto&, const auto&, const auto&) {});

  auto* const surfaces = vtkMultiBlockDataSet::GetData(outputs, 0);
  vtkNew<vtkStringArray> names;
  vtkNew<vtkIntArray> labels;
  vtkNew<vtkDoubleArray> volumes;
  vtkNew<vtkIntArray> iterations;
  vtkNew<vtkStringArray> reasons;
  vtkNew<vtkDoubleArray> confidences;
  vtkNew<vtkIntArray> intersections;
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::Stopwatch watch;
  vtkImageData* const labelMap = vtkImageData::GetData(outputs, 1);
  for (std::size_t index = 0; index < organs.size(); ++index)
  {
    FlipFree::VolumeSegmentation& result = this->Kept->Results[index];
    FlipFree::OrganSurface& organ = result.Organ;
    this->Kept->Convergence.push_back(vtkSmartPointer<vtkTable>::New());
    if (organ.Reason == FlipFree::StopReason::Aborted)
    {
      continue;
    }
    FlipFree::FillConvergenceTable(organ.Iterations, this->Kept->Convergence.back());
    vtkNew<vtkPolyData> surface;
    FlipFree::AttachMesh(organ.Mesh, organ.Points, surface);
    FlipFree::AttachField(organ.Field, surface);
    FlipFree::AttachConfidence(result.Confidence, surface);
    FlipFree::AttachCertificate(true, surface);
    const auto block = static_cast<unsigned int>(index);
    surfaces->SetBlock(block, surface);
    surfaces->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), organs[index].Name.c_str());
    const int label = this->LabelValue + static_cast<int>(index);
    if (index == 0)
    {
      FlipFree::MakeLabelMap(result.Voxels, static_cast<unsigned char>(label), image, labelMap);
    }
    else
    {
      FlipFree::FillRuns(result.Voxels, static_cast<unsigned char>(label), geometry,
        static_cast<unsigned char*>(labelMap->GetScalarPointer()));
    }
    names->InsertNextValue(organs[index].Name);
    labels->InsertNextValue(label);
    volumes->InsertNextValue(
      static_cast<double>(FlipFree::CountVoxels(result.Voxels)) * geometry.VoxelVolume() / 1000);
    iterations->InsertNextValue(static_cast<int>(organ.Iterations.size()));
    reasons->InsertNextValue(FlipFree::ToString(organ.Reason));
    confidences->InsertNextValue(result.Confidence.OfSurface);
    intersections->InsertNextValue(static_cast<int>(organ.SelfIntersections));
    for (const std::string& warning : result.Warnings)
    {
      vtkWarningMacro(<< organs[index].Name << ": " << warning);
    }
    for (int stage = 0; stage < 4; ++stage)
    {
      this->StageSeconds[stage] += result.StageSeconds[stage];
    }
    // What the outputs hold now.
    organ.Points.resize(0, 3);
    organ.Mesh = {};
    organ.First = {};
    result.Voxels.clear();
  }
  this->StageSeconds[3] += watch.Lap();
  const std::pair<const char*, vtkAbstractArray*> columns[] = { { "Organ", names },
    { "Label", labels }, { "Milliliters", volumes }, { "Iterations", iterations },
    { "StopReason", reasons }, { "Confidence", confidences },
    { "SelfIntersections", intersections } };
  for (const auto& [name, column] : columns)
  {
    column->SetName(name);
    vtkTable::GetData(outputs, 2)->AddColumn(column);
  }
  this->UpdateProgress(1);
}

void vtkFlipFreeOrganGroup::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Organs:";
  for (const auto& organ : this->Kept->Organs)
  {
    os << " " << organ.first;
  }
  os << "\n" << indent << "LabelValue: " << this->LabelValue << "\n";
  os << indent << "Parameters: " << this->Parameters.Get() << "\n";
}
