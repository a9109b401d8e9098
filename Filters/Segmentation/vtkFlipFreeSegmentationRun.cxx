// The run of vtkFlipFreeSegmentation on its inputs.
#include "vtkFlipFreeSegmentation.h"

#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "SegmentationResult.h"
#include "SegmentationState.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"

#include <memory>
#include <utility>

FlipFree::VolumeSegmentation vtkFlipFreeSegmentation::Run(vtkInformationVector** inputs)
{
  FlipFree::SegmentationInputs given;
  given.Image = vtkImageData::GetData(inputs[0]);
  FlipFree::RequireGrayImage(given.Image, FlipFree::InputImageName);
  given.ImageTime = given.Image->GetMTime();
  given.Start = vtkPolyData::GetData(inputs[1]);
  given.StartTime = given.Start ? given.Start->GetMTime() : 0;
  given.Labels = vtkImageData::GetData(inputs[3]);
  given.LabelsTime = given.Labels ? given.Labels->GetMTime() : 0;
  given.Label = this->StartLabel;

  FlipFree::OrganRequest request;
  if (!given.Labels)
  {
    request.Seed = FlipFree::SeedSphere{ Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  }
  request.Constraints = this->AllConstraints(inputs[2]);
  this->RequireNoUnusedStageSettings();
  request.Settings = this->GetSettings();
  if (!this->State || !this->KeepForCorrections || !(this->State->Inputs == given))
  {
    this->State.reset(); // what follows needs the memory
    this->State = std::make_unique<FlipFree::SegmentationState>(given);
  }
  FlipFree::OrganAnswer answer =
    this->State->Session.Segment(request, FlipFree::MonitorOf(this, 0, 0.95),
      [this](const FlipFree::ContourMesh& mesh, const FlipFree::PointList& surface,
        const FlipFree::CorrespondenceField& field, const FlipFree::IterationRecord&)
      { this->Cache->History.Add(mesh, surface, field); });
  if (!this->State->Warning.empty())
  {
    answer.Result.Warnings.push_back(this->State->Warning);
  }
  if (!this->KeepForCorrections || answer.Result.Organ.Reason == FlipFree::StopReason::Aborted)
  {
    this->State.reset();
  }
  this->Cache->Provenance = std::move(answer.Provenance);
  return std::move(answer.Result);
}
