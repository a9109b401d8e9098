// The run of vtkFlipFreeSegmentation on its inputs.
#include "vtkFlipFreeSegmentation.h"

#include "ContourMeshAdapter.h"
#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "SegmentationResult.h"
#include "SegmentationState.h"

#include "Deformation/Provenance.h"
#include "Deformation/StartMask.h"
#include "Image/GridCheck.h"

#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace
{

const char* const NameOfImage = "the image on port 0";
const char* const NameOfLabels = "the start labels on port 3";

FlipFree::BitMask StartMaskOf(vtkImageData* labels, int label, vtkImageData* image)
{
  FlipFree::BitMask mask = FlipFree::MaskOf(labels, label == 0 ? -1 : label, NameOfLabels);
  FlipFree::RequireSameGeometry(mask.GetGeometry(), FlipFree::GeometryOf(image), NameOfLabels,
    NameOfImage);
  FlipFree::RequireStartLabel(
    mask, label, [labels]() { return FlipFree::LabelsOf(labels); }, NameOfLabels);
  return mask;
}

} // namespace

FlipFree::VolumeSegmentation vtkFlipFreeSegmentation::Run(vtkInformationVector** inputs)
{
  vtkImageData* const image = vtkImageData::GetData(inputs[0]);
  vtkPolyData* const start = vtkPolyData::GetData(inputs[1]);
  vtkImageData* const labels = vtkImageData::GetData(inputs[3]);
  this->RequireProperties();
  FlipFree::RequireGrayImage(image, NameOfImage);
  FlipFree::SegmentationStateKey key;
  key.Image = image;
  key.ImageTime = image->GetMTime();
  key.Start = start;
  key.StartTime = start ? start->GetMTime() : 0;
  key.Labels = labels;
  key.LabelsTime = labels ? labels->GetMTime() : 0;
  key.ParameterTime = this->GetParameterTime();
  key.Seed = { Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  FlipFree::ConstraintList constraints = this->AllConstraints(inputs[2]);
  if (!labels)
  {
    FlipFree::TakeLargestSeed(key.Seed, constraints);
  }
  FlipFree::OrganProvenance provenance;
  provenance.Seed = key.Seed;
  provenance.Constraints = constraints;
  provenance.HasStartSurface = start != nullptr;
  provenance.StartLabel = labels ? this->StartLabel : -1;
  this->Cache->Provenance =
    FlipFree::ProvenanceOf(provenance, this->GetSettings(), FlipFree::GeometryOf(image));
  if (!this->State || !this->State->IsOf(key))
  {
    this->State.reset(); // what follows needs the memory
    this->State = this->MakeState(key);
  }
  FlipFree::VolumeSegmentation result =
    this->State->Segmenter().Segment(constraints, FlipFree::MonitorOf(this, 0, 0.95),
      [this](const FlipFree::ContourMesh& mesh, const FlipFree::PointList& surface,
        const FlipFree::CorrespondenceField& field, const FlipFree::IterationRecord&)
      {
        if (this->KeepHistory)
        {
          this->Cache->History.Add(mesh, surface, field);
        }
      });
  if (!this->KeepForCorrections || result.Organ.Reason == FlipFree::StopReason::Aborted)
  {
    this->State.reset();
  }
  return result;
}

// The seed of start labels is the largest ball in them.
std::unique_ptr<FlipFree::SegmentationState> vtkFlipFreeSegmentation::MakeState(
  const FlipFree::SegmentationStateKey& key) const
{
  FlipFree::SeedSphere seed = key.Seed;
  FlipFree::BitMask mask;
  if (key.Labels)
  {
    mask = StartMaskOf(key.Labels, this->StartLabel, key.Image);
    seed = FlipFree::LargestBallIn(mask, NameOfLabels, FlipFree::SMPFor);
  }
  FlipFree::RequireSeed(FlipFree::GeometryOf(key.Image), seed, NameOfImage);
  std::optional<FlipFree::DeformableSurface> surface;
  if (key.Start)
  {
    surface =
      FlipFree::DeformableSurfaceOf(key.Start, "the start surface on port 1", this->GetGuard());
  }
  auto segmenter = std::make_unique<FlipFree::VolumeSegmenter>(
    FlipFree::GrayVolumeOf(key.Image, NameOfImage), NameOfImage, seed,
    surface ? &*surface : nullptr, this->GetSettings(), FlipFree::SMPThreading());
  if (key.Labels)
  {
    segmenter->SetForeground(std::move(mask), NameOfLabels);
  }
  return std::make_unique<FlipFree::SegmentationState>(key, key.Image->GetPointData()->GetScalars(),
    std::move(segmenter));
}
