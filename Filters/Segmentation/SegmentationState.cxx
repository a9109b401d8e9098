#include "SegmentationState.h"

#include <utility>

namespace FlipFree
{

SegmentationState::SegmentationState(const SegmentationStateKey& key, vtkDataArray* voxels,
  std::unique_ptr<VolumeSegmenter> segmenter)
  : MadeOf(key)
  , Voxels(voxels)
  , Volume(std::move(segmenter))
{
}

bool SegmentationState::IsOf(const SegmentationStateKey& key) const
{
  const SegmentationStateKey& mine = this->MadeOf;
  return mine.Image == key.Image && mine.ImageTime == key.ImageTime && mine.Start == key.Start &&
    mine.StartTime == key.StartTime && mine.Labels == key.Labels &&
    mine.LabelsTime == key.LabelsTime && mine.ParameterTime == key.ParameterTime &&
    mine.Seed.Center == key.Seed.Center && mine.Seed.Radius == key.Seed.Radius;
}

} // namespace FlipFree
