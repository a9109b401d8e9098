#include "vtkFlipFreeSegmentation.h"

#include "ContourMeshAdapter.h"
#include "ConvergenceTable.h"
#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "SegmentationParameters.h"

#include "Deformation/OrganSegmentation.h"
#include "Mesh/QuadSphere.h"
#include "Mesh/SurfaceVoxelization.h"
#include "Stopwatch.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkFlipFreeSegmentation);

static_assert(vtkFlipFreeSegmentation::ABORTED == static_cast<int>(FlipFree::StopReason::Aborted),
  "the public enumeration follows the kernel's");

// The outputs of the last run, from which any iteration can be delivered again.
struct vtkFlipFreeSegmentation::Result
{
  vtkNew<vtkPolyData> Surface;
  vtkNew<vtkImageData> Labels;
  vtkNew<vtkTable> Convergence;
  std::vector<vtkSmartPointer<vtkPolyData>> History;
  vtkTimeStamp Time;
};

vtkFlipFreeSegmentation::vtkFlipFreeSegmentation()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

vtkFlipFreeSegmentation::~vtkFlipFreeSegmentation() = default;

const char* vtkFlipFreeSegmentation::GetStopReasonAsString() const
{
  return FlipFree::ToString(static_cast<FlipFree::StopReason>(this->StopReason));
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
    this->PublishHistory(outputs->GetInformationObject(0), this->IsResultValid(inputs));
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

  const FlipFree::SeedSphere seed{ Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  FlipFree::RequireParameters(this);
  FlipFree::RequireGrayImage(image, "the image on port 0");
  const FlipFree::ImageGeometry geometry = FlipFree::GeometryOf(image);
  FlipFree::RequireSeed(geometry, seed, "the image on port 0");
  FlipFree::DeformableSurface surface;
  if (start)
  {
    surface = FlipFree::DeformableSurfaceOf(start, "the start surface on port 1", this->Guard);
  }
  else
  {
    const FlipFree::QuadSphere sphere = FlipFree::MakeQuadSphere(FlipFree::FirstResolution(this),
      seed.Center + Eigen::Vector3d(this->StartCenterOffset), this->StartScale * seed.Radius,
      FlipFree::QuadSphereSpacing::Equiangular);
    surface.Mesh = FlipFree::BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
    surface.Points = sphere.Points;
  }

  FlipFree::Stopwatch watch;
  const FlipFree::Extent extent =
    FlipFree::ReachableExtent(geometry, seed.Center, FlipFree::ReachOf(this));
  FlipFree::RequireFinite(image, extent, "the image on port 0");
  const double noise = FlipFree::NoiseOf(image, seed);
  const FlipFree::ImageGeometry region = FlipFree::CropGeometry(geometry, extent);
  auto smooth = std::make_unique<FlipFree::SmoothRegion>(FlipFree::GrayReaderOf(image, extent),
    region, FlipFree::DiffusionSettingsOf(this, noise, region), FlipFree::SMPFor);
  const double before = watch.Lap();

  const FlipFree::OrganSurface organ =
    FlipFree::SegmentOrgan(*smooth, noise, seed, surface.Mesh, surface.Points,
      FlipFree::SettingsOf(this, region), FlipFree::SMPFor, FlipFree::MonitorOf(this, 0, 0.95),
      [this](const FlipFree::ContourMesh& mesh, const FlipFree::PointList& points,
        const FlipFree::CorrespondenceField& field, const FlipFree::IterationRecord&)
      {
        if (this->KeepHistory)
        {
          this->Cache->History.push_back(vtkSmartPointer<vtkPolyData>::New());
          FlipFree::AttachMesh(mesh, points, this->Cache->History.back());
          FlipFree::AttachField(field, this->Cache->History.back());
        }
      });
  this->StageSeconds[0] = before + organ.SmoothingSeconds;
  this->StageSeconds[1] = organ.FeatureSeconds;
  this->StageSeconds[2] = watch.Lap() - organ.SmoothingSeconds - organ.FeatureSeconds;
  this->StopReason = static_cast<int>(organ.Reason);
  FlipFree::FillConvergenceTable(organ.Iterations, this->Cache->Convergence);
  if (this->StopReason == ABORTED)
  {
    this->Cache->History.clear();
    return;
  }
  this->NumberOfSelfIntersections = static_cast<int>(organ.SelfIntersections);
  if (this->Guard && organ.SelfIntersections > 0)
  {
    throw std::logic_error("the surface intersects itself in " +
      std::to_string(organ.SelfIntersections) +
      " pairs of triangles although every step was certified, which should be impossible; please "
      "report it with the image and the parameters");
  }
  FlipFree::AttachMesh(organ.Mesh, organ.Points, this->Cache->Surface);
  FlipFree::AttachField(organ.Field, this->Cache->Surface);
  this->WarnOf(organ, region, geometry);

  smooth.reset(); // the label map takes its place
  FlipFree::MakeLabelMap(
    FlipFree::VoxelizeSurface(organ.Points, organ.Mesh.Triangles, geometry, FlipFree::SMPFor),
    static_cast<unsigned char>(this->LabelValue), image, this->Cache->Labels);
  this->StageSeconds[3] = watch.Lap();
  this->UpdateProgress(1);
}

void vtkFlipFreeSegmentation::PublishHistory(vtkInformation* info, bool isKnown) const
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (!isKnown)
  {
    // How many there will be is not known; this many at most.
    const double range[2] = { 1, std::max(1.0, 1.0 * this->Levels * this->MaximumIterations) };
    info->Remove(Pipeline::TIME_STEPS());
    info->Set(Pipeline::TIME_RANGE(), range, 2);
    return;
  }
  std::vector<double> times(std::max<std::size_t>(1, this->Cache->History.size()));
  std::iota(times.begin(), times.end(), 1.0);
  const double range[2] = { times.front(), times.back() };
  info->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  info->Set(Pipeline::TIME_RANGE(), range, 2);
}

void vtkFlipFreeSegmentation::WarnOf(const FlipFree::OrganSurface& organ,
  const FlipFree::ImageGeometry& region, const FlipFree::ImageGeometry& image)
{
  if (!FlipFree::ContainsSphere(image, { Eigen::Vector3d(this->SeedCenter), this->SeedRadius }))
  {
    vtkWarningMacro("The seed sphere of " << this->SeedRadius
                                          << " mm reaches beyond the image; it should lie within "
                                             "the organ, so lower SeedRadius or move "
                                             "SeedCenter.");
  }
  if (this->StopReason == NO_BOUNDARY_FOUND)
  {
    vtkWarningMacro(
      "No vertex found the organ's boundary, so the surface is not the organ's; check "
      "that the seed lies in the organ, or raise SearchDistance, or raise "
      "ForegroundMass.");
  }
  if (this->StopReason == NOT_REFINED)
  {
    vtkWarningMacro("The surface could not be refined without intersecting itself, so it has "
      << organ.Mesh.NumberOfPoints() << " vertices only; lower Levels to start from a finer one.");
  }
  if (FlipFree::ReachesEndOf(region, image, organ.Points))
  {
    vtkWarningMacro("The surface has got to the end of what it may reach, "
      << FlipFree::ReachOf(this)
      << " mm from the seed's center, and is cut there: it may have leaked, or the seed may lie in "
         "air; look at it, and raise Reach where the organ is that large.");
  }
  else if (this->StopReason != NO_BOUNDARY_FOUND)
  {
    this->WarnOfSeed(organ, image);
  }
}

// Of a seed in air, or in anything that is no organ, comes a surface all the same. On organs less
// than a twentieth of the vertices find no boundary; and at the ends of the image along two axes
// lies hardly any, even where a slab cuts a liver off above and below. What starts elsewhere than
// at the seed, or folds unguarded, or searches less far, may leave out more.
void vtkFlipFreeSegmentation::WarnOfSeed(const FlipFree::OrganSurface& organ,
  const FlipFree::ImageGeometry& image)
{
  constexpr double maximumWithoutBoundary = 0.1;
  constexpr double maximumAtEnds = 0.25;
  const bool startsAtSeed = this->GetNumberOfInputConnections(1) == 0 && this->StartScale == 1 &&
    Eigen::Vector3d(this->StartCenterOffset).isZero();
  if (!startsAtSeed || !this->Guard || organ.Iterations.empty())
  {
    return;
  }
  const double without = static_cast<double>(organ.Iterations.back().Targets.WithoutBoundary) /
    organ.Mesh.NumberOfPoints();
  const double atEnds = FlipFree::FractionAtEndsOf(image, organ.Points);
  const auto percent = [](double fraction) { return std::lround(100 * fraction); };
  if (without > maximumWithoutBoundary && FlipFree::SearchesFar(this))
  {
    vtkWarningMacro(<< percent(without)
                    << " % of the surface found no boundary, so it may not be an organ's; check "
                       "that the seed sphere lies within the organ and not in air, or move "
                       "SeedCenter.");
  }
  else if (atEnds > maximumAtEnds)
  {
    vtkWarningMacro(
      << percent(atEnds)
      << " % of the surface lies at the image's ends along two axes, so it may be that "
         "of what surrounds the organ; check that the seed sphere lies within the organ and "
         "not in air, or move SeedCenter.");
  }
}

void vtkFlipFreeSegmentation::Deliver(vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkPolyData* surface = this->Cache->Surface;
  const int size = static_cast<int>(this->Cache->History.size());
  if (size > 0)
  {
    this->PublishHistory(info, true);
    if (info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
    {
      const double time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
      const int step = static_cast<int>(std::max(1.0, std::min<double>(time, size)));
      surface = step < size ? this->Cache->History[step - 1].Get() : surface;
      surface->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    }
  }
  vtkPolyData::GetData(outputs, 0)->ShallowCopy(surface);
  vtkImageData::GetData(outputs, 1)->ShallowCopy(this->Cache->Labels);
  vtkTable::GetData(outputs, 2)->ShallowCopy(this->Cache->Convergence);
}
