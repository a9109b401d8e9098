#include "vtkFlipFreeSegmentation.h"

#include "ContourMeshAdapter.h"
#include "ConvergenceTable.h"
#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "IterationHistory.h"
#include "LabelAdapter.h"
#include "SegmentationWarnings.h"
#include "StageProperties.h"

#include "Deformation/OrganSegmentation.h"
#include "Deformation/SegmentationSettings.h"
#include "Mesh/QuadSphere.h"
#include "Mesh/SurfaceVoxelization.h"
#include "Stopwatch.h"

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSeedRegionDiffusion.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkFlipFreeSegmentation);

static_assert(vtkFlipFreeSegmentation::ABORTED == static_cast<int>(FlipFree::StopReason::Aborted),
  "the public enumeration follows the kernel's");

namespace
{

FlipFree::DeformableSurface StartSphere(const Eigen::Vector3d& center, double radius,
  const FlipFree::ScheduleSettings& schedule)
{
  const FlipFree::QuadSphere sphere = FlipFree::MakeQuadSphere(schedule.FirstResolution(), center,
    radius, FlipFree::QuadSphereSpacing::Equiangular);
  FlipFree::DeformableSurface surface;
  surface.Mesh = FlipFree::BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
  surface.Points = sphere.Points;
  return surface;
}

} // namespace

// The outputs of the last run, from which any iteration can be delivered again.
struct vtkFlipFreeSegmentation::Result
{
  vtkNew<vtkPolyData> Surface;
  vtkNew<vtkImageData> Labels;
  vtkNew<vtkTable> Convergence;
  FlipFree::IterationHistory History;
  vtkTimeStamp Time;
};

using Stage = vtkFlipFreeSegmentation;

#define PROPERTIES(P)                                                                              \
  P(StartScale, double, StartScale, 1e-3, 1e3)                                                     \
  P(Resolution, int, Schedule->Resolution, 2, 256)                                                 \
  P(Levels, int, Schedule->Levels, 1, 6)                                                           \
  P(MaximumIterations, int, Schedule->MaximumIterations, 0, 100000)                                \
  P(DistanceTolerance, double, Schedule->DistanceTolerance, 0, 1e6)                                \
  P(ChangeTolerance, double, Schedule->ChangeTolerance, -1e6, 1e6)                                 \
  P(LabelValue, int, LabelValue, 1, 255)                                                           \
  P(KeepHistory, bool, KeepHistory, false, true)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

// Name, type, the stage, and its name there.
#define FORWARDED_PROPERTIES(P)                                                                    \
  P(Reach, double, Diffusion, Reach)                                                               \
  P(DiffusionIterations, int, Diffusion, NumberOfIterations)                                       \
  P(ForegroundMass, double, Feature, ForegroundMass)                                               \
  P(LeakControl, bool, Feature, LeakControl)                                                       \
  P(SearchDistance, double, Search, SearchDistance)                                                \
  P(Guard, bool, Deform, Guard)

#define DEFINE_FORWARDED_PROPERTY(Name, type, stage, NameThere)                                    \
  void Stage::Set##Name(type value)                                                                \
  {                                                                                                \
    this->stage->Set##NameThere(value);                                                            \
  }                                                                                                \
  type Stage::Get##Name() const                                                                    \
  {                                                                                                \
    return this->stage->Get##NameThere();                                                          \
  }

FORWARDED_PROPERTIES(DEFINE_FORWARDED_PROPERTY)

// A type cannot be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define DEFINE_STAGE(Name, type)                                                                   \
  void Stage::Set##Name(type* stage)                                                               \
  {                                                                                                \
    if (this->Name != stage)                                                                       \
    {                                                                                              \
      this->Name = stage ? vtkSmartPointer<type>(stage) : vtkSmartPointer<type>::New();            \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  type* Stage::Get##Name() const                                                                   \
  {                                                                                                \
    return this->Name;                                                                             \
  }
// NOLINTEND(bugprone-macro-parentheses)

DEFINE_STAGE(Diffusion, vtkSeedRegionDiffusion)
DEFINE_STAGE(Feature, vtkGMMFeatureFilter)
DEFINE_STAGE(Search, vtkCorrespondenceSearch)
DEFINE_STAGE(Deform, vtkFlipFreeDeform)

vtkFlipFreeSegmentation::vtkFlipFreeSegmentation()
  : Schedule(std::make_unique<FlipFree::ScheduleSettings>())
  , Diffusion(vtkSmartPointer<vtkSeedRegionDiffusion>::New())
  , Feature(vtkSmartPointer<vtkGMMFeatureFilter>::New())
  , Search(vtkSmartPointer<vtkCorrespondenceSearch>::New())
  , Deform(vtkSmartPointer<vtkFlipFreeDeform>::New())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

vtkFlipFreeSegmentation::~vtkFlipFreeSegmentation() = default;

const char* vtkFlipFreeSegmentation::GetStopReasonAsString() const
{
  return FlipFree::ToString(static_cast<FlipFree::StopReason>(this->StopReason));
}

vtkMTimeType vtkFlipFreeSegmentation::GetMTime()
{
  return std::max({ this->Superclass::GetMTime(), this->Diffusion->GetMTime(),
    this->Feature->GetMTime(), this->Search->GetMTime(), this->Deform->GetMTime() });
}

FlipFree::OrganSegmentationSettings vtkFlipFreeSegmentation::GetSettings() const
{
  return { *this->Schedule, *this->Diffusion->Settings, *this->Feature->Settings,
    *this->Search->Settings, *this->Deform->Settings };
}

void vtkFlipFreeSegmentation::UseSettings(const FlipFree::OrganSegmentationSettings& settings)
{
  const double reach = this->GetReach();
  *this->Schedule = settings.Schedule;
  *this->Diffusion->Settings = settings.Smoothing;
  *this->Feature->Settings = settings.Feature;
  *this->Search->Settings = settings.Targets;
  *this->Deform->Settings = settings.Step;
  this->SetReach(reach);
  // Others may use the stages, too.
  this->Diffusion->Modified();
  this->Feature->Modified();
  this->Search->Modified();
  this->Deform->Modified();
  this->Modified();
}

void vtkFlipFreeSegmentation::UseDefaultParameters()
{
  this->UseSettings({});
}

void vtkFlipFreeSegmentation::UsePublishedParameters()
{
  this->UseSettings(FlipFree::PublishedSettings());
}

void vtkFlipFreeSegmentation::UseNaiveParameters()
{
  this->UseSettings(FlipFree::NaiveSettings());
}

void vtkFlipFreeSegmentation::RequireProperties() const
{
  FlipFree::RequireNumbers({ PROPERTIES(FLIPFREE_NAME_PROPERTY){ "StartCenterOffset",
    this->StartCenterOffset[0] + this->StartCenterOffset[1] + this->StartCenterOffset[2] } });
  this->Diffusion->RequireProperties();
  this->Feature->RequireProperties();
  this->Search->RequireProperties();
  this->Deform->RequireProperties();
}

void vtkFlipFreeSegmentation::SetInputData(vtkImageData* image)
{
  this->SetInputDataObject(0, image);
}

vtkPolyData* vtkFlipFreeSegmentation::GetOutput()
{
  return this->GetSurface();
}

vtkPolyData* vtkFlipFreeSegmentation::GetSurface()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkImageData* vtkFlipFreeSegmentation::GetLabelMap()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkTable* vtkFlipFreeSegmentation::GetConvergence()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

void vtkFlipFreeSegmentation::SetStartData(vtkPolyData* surface)
{
  this->SetInputDataObject(1, surface);
}

int vtkFlipFreeSegmentation::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkPolyData");
  info->Set(INPUT_IS_OPTIONAL(), port == 1);
  return 1;
}

int vtkFlipFreeSegmentation::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkPolyData", "vtkImageData", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

vtkTypeBool vtkFlipFreeSegmentation::ProcessRequest(vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    return this->RequestInformation(inputs, outputs);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    return this->RequestUpdateExtent(inputs);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(inputs, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkFlipFreeSegmentation::RequestInformation(vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  vtkInformation* labels = outputs->GetInformationObject(1);
  labels->CopyEntry(in, Pipeline::WHOLE_EXTENT());
  labels->CopyEntry(in, vtkDataObject::SPACING());
  labels->CopyEntry(in, vtkDataObject::ORIGIN());
  labels->CopyEntry(in, vtkDataObject::DIRECTION());
  vtkDataObject::SetPointDataActiveScalarInfo(labels, VTK_UNSIGNED_CHAR, 1);
  if (this->KeepHistory)
  {
    vtkInformation* surface = outputs->GetInformationObject(0);
    if (this->IsResultValid(inputs))
    {
      this->Cache->History.Announce(surface);
    }
    else
    {
      FlipFree::IterationHistory::AnnounceAtMost((this->Feature->GetCarving() ? 2.0 : 1.0) *
          this->GetLevels() * this->GetMaximumIterations(),
        surface);
    }
  }
  return 1;
}

int vtkFlipFreeSegmentation::RequestUpdateExtent(vtkInformationVector** inputs) const
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  if (in->Has(Pipeline::WHOLE_EXTENT()))
  {
    in->Set(Pipeline::UPDATE_EXTENT(), in->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  if (this->KeepHistory)
  {
    // Time is the number of the iteration here, and none of the image's.
    in->Remove(Pipeline::UPDATE_TIME_STEP());
  }
  return 1;
}

bool vtkFlipFreeSegmentation::IsResultValid(vtkInformationVector** inputs) const
{
  if (!this->Cache || this->Cache->Time < const_cast<vtkFlipFreeSegmentation*>(this)->GetMTime())
  {
    return false;
  }
  for (int port = 0; port < 2; ++port)
  {
    vtkDataObject* input = vtkDataObject::GetData(inputs[port]);
    if (input && this->Cache->Time < input->GetMTime())
    {
      return false;
    }
  }
  return true;
}

int vtkFlipFreeSegmentation::RequestData(vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  if (!this->KeepHistory || !this->IsResultValid(inputs))
  {
    this->Cache = std::make_unique<Result>();
    try
    {
      this->Execute(vtkImageData::GetData(inputs[0]), vtkPolyData::GetData(inputs[1]));
    }
    catch (const std::exception& error)
    {
      this->Cache = std::make_unique<Result>();
      this->Deliver(outputs);
      this->Cache.reset();
      this->StopReason = NOT_RUN;
      vtkErrorMacro("No segmentation: " << error.what() << ".");
      return 0;
    }
    this->Cache->Time.Modified();
  }
  this->Deliver(outputs);
  if (!this->KeepHistory || this->StopReason == ABORTED)
  {
    this->Cache.reset();
  }
  return 1;
}

void vtkFlipFreeSegmentation::Execute(vtkImageData* image, vtkPolyData* start)
{
  this->StopReason = NOT_RUN;
  this->NumberOfSelfIntersections = -1;
  std::fill_n(this->StageSeconds, 4, 0.0);

  this->RequireProperties();
  const FlipFree::OrganSegmentationSettings settings = this->GetSettings();
  const FlipFree::SeedSphere seed{ Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  FlipFree::RequireGrayImage(image, "the image on port 0");
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::RequireSeed(geometry, seed, "the image on port 0");
  const Eigen::Vector3d startCenter = seed.Center + Eigen::Vector3d(this->StartCenterOffset);
  const FlipFree::DeformableSurface surface = start
    ? FlipFree::DeformableSurfaceOf(start, "the start surface on port 1", settings.Step.Guard)
    : StartSphere(startCenter, this->StartScale * seed.Radius, settings.Schedule);

  FlipFree::Stopwatch watch;
  const FlipFree::VoxelBox box =
    FlipFree::BoxAround(geometry, seed.Center, FlipFree::ReachOf(settings.Smoothing, seed.Radius));
  FlipFree::RequireFinite(image, box, "the image on port 0");
  const double noise = FlipFree::NoiseOf(image, seed);
  const FlipFree::ImageGeometry region = FlipFree::CropGeometry(geometry, box);
  FlipFree::AnisotropicDiffusionSettings diffusion =
    FlipFree::DiffusionOf(settings.Smoothing, noise);
  diffusion.Threads = FlipFree::NumberOfThreads();
  auto smooth = std::make_unique<FlipFree::SmoothRegion>(FlipFree::GrayReaderOf(image, box), region,
    diffusion, FlipFree::SMPFor);
  const double before = watch.Lap();

  const FlipFree::OrganSurface organ = FlipFree::SegmentOrgan(*smooth, noise, seed, surface.Mesh,
    surface.Points, settings, FlipFree::SMPFor, FlipFree::MonitorOf(this, 0, 0.95),
    [this](const FlipFree::ContourMesh& mesh, const FlipFree::PointList& points,
      const FlipFree::CorrespondenceField& field, const FlipFree::IterationRecord&)
    {
      if (this->KeepHistory)
      {
        this->Cache->History.Add(mesh, points, field);
      }
    });
  smooth.reset(); // the label map takes its place
  this->StageSeconds[0] = before + organ.SmoothingSeconds;
  this->StageSeconds[1] = organ.FeatureSeconds;
  this->StageSeconds[2] = watch.Lap() - organ.SmoothingSeconds - organ.FeatureSeconds;

  this->Keep(organ, settings.Step.Guard);
  if (this->StopReason == ABORTED)
  {
    return;
  }
  const bool startsAtSeed = !start && this->StartScale == 1 && startCenter == seed.Center;
  for (const std::string& warning :
    FlipFree::WarningsOf(organ, region, geometry, seed, settings, startsAtSeed))
  {
    vtkWarningMacro(<< warning);
  }
  FlipFree::MakeLabelMap(
    FlipFree::VoxelizeSurface(organ.Points, organ.Mesh.Triangles, geometry, FlipFree::SMPFor),
    static_cast<unsigned char>(this->LabelValue), image, this->Cache->Labels);
  this->StageSeconds[3] = watch.Lap();
  this->UpdateProgress(1);
}

void vtkFlipFreeSegmentation::Keep(const FlipFree::OrganSurface& organ, bool guarded)
{
  this->StopReason = static_cast<int>(organ.Reason);
  FlipFree::FillConvergenceTable(organ.Iterations, this->Cache->Convergence);
  if (this->StopReason == ABORTED)
  {
    this->Cache->History.Clear();
    return;
  }
  this->NumberOfSelfIntersections = static_cast<int>(organ.SelfIntersections);
  if (guarded && organ.SelfIntersections > 0)
  {
    throw std::logic_error("the surface intersects itself in " +
      std::to_string(organ.SelfIntersections) +
      " pairs of faces although every step was certified, which should be impossible; please "
      "report it with the image and the parameters");
  }
  FlipFree::AttachMesh(organ.Mesh, organ.Points, this->Cache->Surface);
  FlipFree::AttachField(organ.Field, this->Cache->Surface);
  FlipFree::AttachCertificate(guarded, this->Cache->Surface);
}

void vtkFlipFreeSegmentation::Deliver(vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkPolyData* surface = this->Cache->Surface;
  if (!this->Cache->History.IsEmpty())
  {
    this->Cache->History.Announce(info);
    surface = this->Cache->History.SurfaceAt(info, surface);
  }
  vtkPolyData::GetData(outputs, 0)->ShallowCopy(surface);
  vtkImageData::GetData(outputs, 1)->ShallowCopy(this->Cache->Labels);
  vtkTable::GetData(outputs, 2)->ShallowCopy(this->Cache->Convergence);
}

void vtkFlipFreeSegmentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SeedCenter: (" << this->SeedCenter[0] << ", " << this->SeedCenter[1] << ", "
     << this->SeedCenter[2] << ")\n";
  os << indent << "SeedRadius: " << this->SeedRadius << "\n";
  os << indent << "StartCenterOffset: (" << this->StartCenterOffset[0] << ", "
     << this->StartCenterOffset[1] << ", " << this->StartCenterOffset[2] << ")\n";
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
  const std::pair<const char*, vtkObject*> stages[] = { { "Diffusion", this->Diffusion },
    { "Feature", this->Feature }, { "Search", this->Search }, { "Deform", this->Deform } };
  for (const auto& [name, stage] : stages)
  {
    os << indent << name << ":\n";
    stage->PrintSelf(os, indent.GetNextIndent());
  }
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  os << indent << "NumberOfSelfIntersections: " << this->NumberOfSelfIntersections << "\n";
}
