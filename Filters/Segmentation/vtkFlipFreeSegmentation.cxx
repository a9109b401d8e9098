#include "vtkFlipFreeSegmentation.h"

#include "FilterAdvice.h"
#include "FilterReport.h"
#include "LabelAdapter.h"
#include "PipelineAdapter.h"
#include "SegmentationResult.h"
#include "SegmentationState.h"

#include "Deformation/VolumeSegmentation.h"
#include "Stopwatch.h"

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSeedRegionDiffusion.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <string>

vtkStandardNewMacro(vtkFlipFreeSegmentation);

namespace
{

constexpr bool IsSame(vtkFlipFreeSegmentation::StopReasons one, FlipFree::StopReason other)
{
  return static_cast<int>(one) == static_cast<int>(other);
}

} // namespace

static_assert(IsSame(vtkFlipFreeSegmentation::NOT_RUN, FlipFree::StopReason::NotRun) &&
    IsSame(vtkFlipFreeSegmentation::DISTANCE_BELOW_TOLERANCE,
      FlipFree::StopReason::DistanceBelowTolerance) &&
    IsSame(vtkFlipFreeSegmentation::CONVERGED, FlipFree::StopReason::Converged) &&
    IsSame(vtkFlipFreeSegmentation::ITERATION_LIMIT, FlipFree::StopReason::IterationLimit) &&
    IsSame(vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND, FlipFree::StopReason::NoBoundaryFound) &&
    IsSame(vtkFlipFreeSegmentation::NOT_REFINED, FlipFree::StopReason::NotRefined) &&
    IsSame(vtkFlipFreeSegmentation::ABORTED, FlipFree::StopReason::Aborted),
  "the public enumeration follows the kernel's");

vtkFlipFreeSegmentation::vtkFlipFreeSegmentation()
  : Settings(std::make_unique<FlipFree::VolumeSegmentationSettings>())
  , Diffusion(vtkSmartPointer<vtkSeedRegionDiffusion>::New())
  , Feature(vtkSmartPointer<vtkGMMFeatureFilter>::New())
  , Search(vtkSmartPointer<vtkCorrespondenceSearch>::New())
  , Deform(vtkSmartPointer<vtkFlipFreeDeform>::New())
  , Constraints(std::make_unique<FlipFree::ConstraintList>())
{
  this->SetNumberOfInputPorts(4);
  this->SetNumberOfOutputPorts(4);
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

vtkTable* vtkFlipFreeSegmentation::GetQuestions()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(3));
}

void vtkFlipFreeSegmentation::SetStartData(vtkPolyData* surface)
{
  this->SetInputDataObject(1, surface);
}

void vtkFlipFreeSegmentation::SetStartLabelsData(vtkImageData* labels)
{
  this->SetInputDataObject(3, labels);
}

int vtkFlipFreeSegmentation::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[4] = { "vtkImageData", "vtkPolyData", "vtkPointSet", "vtkImageData" };
  info->Set(INPUT_REQUIRED_DATA_TYPE(), types[port]);
  info->Set(INPUT_IS_OPTIONAL(), port > 0);
  info->Set(INPUT_IS_REPEATABLE(), port == 2);
  return 1;
}

int vtkFlipFreeSegmentation::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[4] = { "vtkPolyData", "vtkImageData", "vtkTable", "vtkTable" };
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
  FlipFree::AnnounceLabelMap(inputs[0]->GetInformationObject(0), outputs->GetInformationObject(1));
  if (this->Settings->KeepHistory)
  {
    vtkInformation* surface = outputs->GetInformationObject(0);
    if (this->IsCacheUpToDate(inputs))
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
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  FlipFree::RequestWholeExtent(in);
  if (inputs[3]->GetNumberOfInformationObjects() > 0)
  {
    FlipFree::RequestWholeExtent(inputs[3]->GetInformationObject(0));
  }
  if (this->Settings->KeepHistory)
  {
    // Time is the number of the iteration here, and none of the image's.
    in->Remove(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
  }
  return 1;
}

bool vtkFlipFreeSegmentation::IsCacheUpToDate(vtkInformationVector** inputs)
{
  return this->Cache && this->Cache->IsUpToDate(inputs, this->GetMTime());
}

int vtkFlipFreeSegmentation::RequestData(vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->Settings->KeepHistory || !this->IsCacheUpToDate(inputs))
  {
    this->Cache = std::make_unique<FlipFree::SegmentationResult>();
    try
    {
      FlipFree::WithAdvice([&] { this->UpdateCache(inputs); });
    }
    catch (const std::exception& error)
    {
      this->Cache = std::make_unique<FlipFree::SegmentationResult>();
      this->Cache->CopyTo(outputs);
      this->Cache.reset();
      this->State.reset();
      this->StopReason = NOT_RUN;
      FlipFreeErrorMacro("No segmentation: ", error, ".");
      return 0;
    }
    this->Cache->Time.Modified();
  }
  this->Cache->CopyTo(outputs);
  if (!this->Settings->KeepHistory || this->StopReason == ABORTED)
  {
    this->Cache.reset();
  }
  return 1;
}

void vtkFlipFreeSegmentation::UpdateCache(vtkInformationVector** inputs)
{
  this->StopReason = NOT_RUN;
  this->NumberOfSelfIntersections = -1;
  this->Confidence = -1;
  std::fill_n(this->StageSeconds, 4, 0.0);

  const FlipFree::VolumeSegmentation result = this->Run(inputs);
  std::copy(result.StageSeconds.begin(), result.StageSeconds.end(), this->StageSeconds);
  this->StopReason = static_cast<int>(result.Organ.Reason);
  this->Cache->Store(result, this->GetGuard());
  if (this->StopReason == ABORTED)
  {
    return;
  }
  this->NumberOfSelfIntersections = static_cast<int>(result.Organ.SelfIntersections);
  this->Confidence = result.Confidence.OfSurface;
  for (const std::string& warning : result.Warnings)
  {
    FlipFreeWarningMacro(warning);
  }
  FlipFree::Stopwatch watch;
  FlipFree::MakeLabelMap(result.Voxels, static_cast<unsigned char>(this->Settings->LabelValue),
    vtkImageData::GetData(inputs[0]), this->Cache->Labels);
  this->StageSeconds[3] += watch.Lap();
  this->UpdateProgress(1);
}
