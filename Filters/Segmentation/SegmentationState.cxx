#include "SegmentationState.h"

#include <utility>

namespace FlipFree
{

SegmentationState::SegmentationState(const Key& key, vtkDataArray* voxels,
  std::unique_ptr<VolumeSegmenter> segmenter)
  : MadeOf(key)
  , Voxels(voxels)
  , Volume(std::move(segmenter))
{
}

bool SegmentationState::IsOf(const Key& key) const
{
  const Key& mine = this->MadeOf;
  return mine.Image == key.Image && mine.ImageTime == key.ImageTime && mine.Start == key.Start &&
    mine.StartTime == key.StartTime && mine.ParameterTime == key.ParameterTime &&
    mine.Seed.Center == key.Seed.Center && mine.Seed.Radius == key.Seed.Radius;
}

} // namespace FlipFree
