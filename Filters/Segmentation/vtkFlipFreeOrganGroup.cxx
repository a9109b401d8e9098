#include "vtkFlipFreeOrganGroup.h"

#include "ConstraintPoints.h"
#include "ContourMeshAdapter.h"
#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "FilterAdvice.h"
#include "FilterReport.h"
#include "FilterSettings.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "PipelineAdapter.h"
#include "TableAdapter.h"
#include "UnusedSettings.h"

#include "Deformation/ConvergenceColumns.h"
#include "Deformation/Provenance.h"
#include "Deformation/SegmentationRequest.h"
#include "MessageText.h"
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
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkFlipFreeOrganGroup);

namespace
{

const char* const NameOfImage = "the image{ on port 0}";

std::vector<FlipFree::GivenSurface> FixedSurfacesOf(vtkInformationVector* inputs)
{
  std::vector<FlipFree::GivenSurface> fixed;
  fixed.reserve(inputs->GetNumberOfInformationObjects());
  for (int index = 0; index < inputs->GetNumberOfInformationObjects(); ++index)
  {
    fixed.push_back(FlipFree::GivenSurfaceOf(vtkPolyData::GetData(inputs, index),
      "the fixed surface " + std::to_string(index + 1) + "{ on port 2}"));
  }
  return fixed;
}

// For files that hold names of labels.
void NameSegments(const std::vector<FlipFree::NamedOrgan>& organs, int first,
  vtkImageData* labelMap)
{
  std::vector<double> labels;
  std::vector<std::string> names;
  std::vector<std::string> colors;
  for (const FlipFree::NamedOrgan& organ : organs)
  {
    labels.push_back(first + static_cast<double>(names.size()));
    colors.push_back(FlipFree::DefaultColor(names.size()));
    names.push_back(organ.Name);
  }
  FlipFree::AddFieldValues("SegmentLabels", labels, labelMap);
  FlipFree::AddFieldText("SegmentNames", names, labelMap);
  FlipFree::AddFieldText("SegmentColors", colors, labelMap);
}

// A row per organ.
class ResultTable
{
public:
  void Add(const std::string& name, int label, const FlipFree::VolumeSegmentation& result,
    const FlipFree::ImageGeometry& geometry)
  {
    this->Names->InsertNextValue(name);
    this->Labels->InsertNextValue(label);
    this->Volumes->InsertNextValue(geometry.Milliliters(FlipFree::CountVoxels(result.Voxels)));
    this->Iterations->InsertNextValue(static_cast<int>(result.Organ.Iterations.size()));
    this->Reasons->InsertNextValue(FlipFree::ToString(result.Organ.Reason));
    this->Confidences->InsertNextValue(result.Confidence.OfSurface);
    this->Intersections->InsertNextValue(static_cast<int>(result.Organ.SelfIntersections));
  }

  void AddTo(vtkTable* table) const
  {
    const std::pair<const char*, vtkAbstractArray*> columns[] = { { "Organ", this->Names },
      { "Label", this->Labels }, { "Milliliters", this->Volumes },
      { "Iterations", this->Iterations }, { "StopReason", this->Reasons },
      { "Confidence", this->Confidences }, { "SelfIntersections", this->Intersections } };
    for (const auto& [name, column] : columns)
    {
      column->SetName(name);
      table->AddColumn(column);
    }
  }

private:
  vtkNew<vtkStringArray> Names;
  vtkNew<vtkIntArray> Labels;
  vtkNew<vtkDoubleArray> Volumes;
  vtkNew<vtkIntArray> Iterations;
  vtkNew<vtkStringArray> Reasons;
  vtkNew<vtkDoubleArray> Confidences;
  vtkNew<vtkIntArray> Intersections;
};

} // namespace

struct vtkFlipFreeOrganGroup::Internals
{
  std::vector<FlipFree::NamedOrgan> Organs;
  std::vector<FlipFree::VolumeSegmentation> Results; // without surfaces
  std::vector<vtkSmartPointer<vtkTable>> Convergence;
  std::vector<vtkSmartPointer<vtkTable>> Questions;

  const FlipFree::VolumeSegmentation* Finished(int organ) const
  {
    const FlipFree::VolumeSegmentation* const result = this->Result(organ);
    return result && result->Organ.Reason != FlipFree::StopReason::Aborted ? result : nullptr;
  }

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
    [&name](const FlipFree::NamedOrgan& candidate) { return candidate.Name == name; });
  if (found == this->Kept->Organs.end())
  {
    FlipFreeReportMacro("No point: ",
      FlipFree::Error(FlipFree::ErrorCode::OutOfRange,
        "there is no organ named " + FlipFree::Quoted(name) + "; add it by AddOrgan first"),
      ".");
    return;
  }
  found->Constraints.push_back({ static_cast<FlipFree::ConstraintKind>(kind),
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

vtkTable* vtkFlipFreeOrganGroup::GetQuestions(int organ)
{
  return this->Kept->Result(organ) ? this->Kept->Questions[organ].Get() : nullptr;
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
  const auto* const result = this->Kept->Finished(organ);
  return result ? result->Confidence.OfSurface : -1;
}

int vtkFlipFreeOrganGroup::GetNumberOfSelfIntersections(int organ) const
{
  const auto* const result = this->Kept->Finished(organ);
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
  this->SetErrorCode(vtkErrorCode::NoError);
  const auto clear = [this, outputs]
  {
    for (int port = 0; port < 3; ++port)
    {
      vtkDataObject::GetData(outputs, port)->Initialize();
    }
    this->Kept->Results.clear();
    this->Kept->Convergence.clear();
    this->Kept->Questions.clear();
    std::fill_n(this->StageSeconds, 4, 0.0);
  };
  clear();
  try
  {
    FlipFree::WithAdvice([&] { this->Segment(inputs, outputs); });
  }
  catch (const std::exception& error)
  {
    clear();
    FlipFreeErrorMacro("No segmentation: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeOrganGroup::Segment(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* const image = vtkImageData::GetData(inputs[0]);
  FlipFree::RequireGrayImage(image, NameOfImage);
  FlipFree::GroupRequest request;
  request.Organs = this->Kept->Organs;
  FlipFree::AddConstraintsOf(inputs[1], 1, request.Organs);
  request.Fixed = FixedSurfacesOf(inputs[2]);
  FlipFree::RequireNoConnection("GetParameters()", this->Parameters);
  FlipFree::RequireNoSeed("GetParameters()", this->Parameters.Get(), "AddOrgan()");
  if (this->Parameters->GetNumberOfCorrections() > 0)
  {
    throw FlipFree::Error(FlipFree::ErrorCode::OutOfRange,
      "GetParameters() has points, which are not used; add them to this filter, with the name of "
      "their organ, and call RemoveAllCorrections() of GetParameters()");
  }
  FlipFree::FilterSettings::RequireNoUnusedOfStages(this->Parameters, " of GetParameters()");
  request.Settings = FlipFree::FilterSettings::Of(this->Parameters);
  request.Settings.LabelValue = this->LabelValue;
  FlipFree::GroupAnswer answer = FlipFree::SegmentGroup(FlipFree::GrayVolumeOf(image, NameOfImage),
    NameOfImage, request, FlipFree::SMPThreading(), FlipFree::MonitorOf(this, 0, 0.95));
  this->Kept->Results = std::move(answer.Results);

  FlipFree::Stopwatch watch;
  ResultTable table;
  for (std::size_t index = 0; index < request.Organs.size(); ++index)
  {
    FlipFree::VolumeSegmentation& result = this->Kept->Results[index];
    this->Kept->Convergence.push_back(vtkSmartPointer<vtkTable>::New());
    this->Kept->Questions.push_back(vtkSmartPointer<vtkTable>::New());
    if (result.Organ.Reason != FlipFree::StopReason::Aborted)
    {
      const std::string& name = request.Organs[index].Name;
      const int label = this->LabelValue + static_cast<int>(index);
      this->FillOutputs(static_cast<int>(index), name, image, outputs);
      vtkPolyData* const surface = this->GetSurface(static_cast<int>(index));
      FlipFree::AttachProvenance(answer.Provenance, surface);
      FlipFree::AddFieldText("Organ", { name }, surface);
      table.Add(name, label, result, FlipFree::GeometryOf(image));
      // What the outputs hold now.
      result.Organ.Points.resize(0, 3);
      result.Organ.Mesh = {};
      result.Organ.First = {};
      result.Voxels.clear();
    }
  }
  this->StageSeconds[3] += watch.Lap();
  table.AddTo(vtkTable::GetData(outputs, 2));
  if (this->Kept->Finished(0)) // aborted, all outputs are empty
  {
    NameSegments(request.Organs, this->LabelValue, vtkImageData::GetData(outputs, 1));
  }
  this->UpdateProgress(1);
}

void vtkFlipFreeOrganGroup::FillOutputs(int organ, const std::string& name, vtkImageData* image,
  vtkInformationVector* outputs)
{
  const FlipFree::VolumeSegmentation& result = this->Kept->Results[organ];
  FlipFree::AddColumns(this->Kept->Convergence[organ], FlipFree::ConvergenceColumns(),
    result.Organ.Iterations);
  FlipFree::AddColumns(this->Kept->Questions[organ], FlipFree::QuestionColumns(), result.Questions);
  vtkNew<vtkPolyData> surface;
  FlipFree::AttachMesh(result.Organ.Mesh, result.Organ.Points, surface);
  FlipFree::AttachField(result.Organ.Field, surface);
  FlipFree::AttachConfidence(result.Confidence, surface);
  FlipFree::AttachCertificate(true, surface);
  auto* const surfaces = vtkMultiBlockDataSet::GetData(outputs, 0);
  const auto block = static_cast<unsigned int>(organ);
  surfaces->SetBlock(block, surface);
  surfaces->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), name.c_str());
  vtkImageData* const labelMap = vtkImageData::GetData(outputs, 1);
  const auto label = static_cast<unsigned char>(this->LabelValue + organ);
  if (organ == 0)
  {
    FlipFree::MakeLabelMap(result.Voxels, label, image, labelMap);
  }
  else
  {
    FlipFree::FillRuns(result.Voxels, label, FlipFree::GeometryOf(image),
      static_cast<unsigned char*>(labelMap->GetScalarPointer()));
  }
  for (const std::string& warning : result.Warnings)
  {
    FlipFreeWarningMacro(FlipFree::Quoted(name) + ": " + warning);
  }
  for (int stage = 0; stage < 4; ++stage)
  {
    this->StageSeconds[stage] += result.StageSeconds[stage];
  }
}

void vtkFlipFreeOrganGroup::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const FlipFree::NamedOrgan& organ : this->Kept->Organs)
  {
    os << indent << "Organ: " << organ.Name << "\n";
    for (const FlipFree::PointConstraint& constraint : organ.Constraints)
    {
      const bool isSphere = constraint.Kind == FlipFree::ConstraintKind::Seed;
      os << indent.GetNextIndent()
         << (isSphere ? "a seed at " + FlipFree::TextOf(constraint.Point) +
                  " mm, Radius: " + std::to_string(constraint.Radius)
                      : FlipFree::NameOf(constraint))
         << "\n";
    }
  }
  os << indent << "LabelValue: " << this->LabelValue << "\n";
  os << indent << "StageSeconds:";
  for (const double seconds : this->StageSeconds)
  {
    os << " " << seconds;
  }
  os << "\n";
  os << indent << "Parameters: " << this->Parameters.Get() << "\n";
}
