#include "SegmentationState.h"

#include "ContourMeshAdapter.h"
#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"

#include "vtkImageData.h"
#include "vtkPointData.h"

#include <tuple>

namespace FlipFree
{
namespace
{

auto KeyOf(const SegmentationInputs& inputs)
{
  return std::make_tuple(inputs.Image, inputs.ImageTime, inputs.Start, inputs.StartTime,
    inputs.Labels, inputs.LabelsTime, inputs.Label);
}

} // namespace

bool SegmentationInputs::operator==(const SegmentationInputs& other) const
{
  return KeyOf(*this) == KeyOf(other);
}

SegmentationState::SegmentationState(const SegmentationInputs& inputs)
  : Inputs(inputs)
  , Voxels(inputs.Image->GetPointData()->GetScalars())
  , Session(GrayVolumeOf(inputs.Image, InputImageName), InputImageName, SMPThreading())
{
  if (inputs.Labels)
  {
    const LabelVolume labels = LabelVolumeOf(inputs.Labels, "the start labels{ on port 3}");
    this->Session.FillLabel(labels, inputs.Label);
    this->Warning = WarningOfNoLabels(labels.Values(), inputs.Label, labels.Name, "is filled");
  }
  if (inputs.Start)
  {
    this->Session.StartFrom(GivenSurfaceOf(inputs.Start, "the start surface{ on port 1}"));
  }
}

} // namespace FlipFree
