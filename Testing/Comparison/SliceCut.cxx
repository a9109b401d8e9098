#include "SliceCut.h"

#include "MaskVoxels.h"

#include "Image/BallMorphology.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

class SliceCutter
{
public:
  SliceCutter(const SliceCutInputs& inputs, const ParallelFor& parallelFor)
    : Inputs(inputs)
    , For(parallelFor)
  {
  }

  // The organ in plane k, given that in the plane before, or none for the first. False if stopped.
  bool Cut(int k, const BitMask* before, const Monitor& monitor, BitMask& organ) const
  {
    const ImageGeometry& region = this->Inputs.Task.Region.Geometry;
    const VoxelBox box{ { { 0, 0, k } },
      { { region.Dimensions[0], region.Dimensions[1], k + 1 } } };
    const ImageGeometry plane = CropGeometry(region, box);
    const std::size_t first = region.Offset(0, 0, k);
    const float* const odds = this->Inputs.LogOdds.data() + first;
    const std::vector<float> oddsOfPlane(odds, odds + plane.NumberOfVoxels());
    BitMask candidates = this->Inputs.Candidates.Cropped(box);
    BitMask seeds = this->Inputs.Seeds.Cropped(box);
    std::vector<std::size_t> sources;
    if (before)
    {
      BitMask near = *before;
      BitMask core = *before;
      if (!Dilate(near, this->Inputs.Margin, this->For, monitor) ||
        !Erode(core, this->Inputs.Margin, this->For, monitor))
      {
        return false;
      }
      candidates.Intersect(near);
      core.Intersect(VoxelsWhere(
        ImageView<float>{ odds, plane }, [](float value) { return value > 0; }, this->For));
      seeds.Unite(core);
      sources = OffsetsOf(*before);
    }
    candidates.Unite(seeds);
    if (!FindVoxelCut({ this->Inputs.Task.Region.Voxels.data() + first, plane }, oddsOfPlane,
          candidates, seeds, this->Inputs.Settings, monitor, organ))
    {
      return false;
    }
    const std::vector<std::size_t> certain = OffsetsOf(seeds);
    sources.insert(sources.end(), certain.begin(), certain.end());
    return KeepConnected(organ, sources, monitor);
  }

private:
  const SliceCutInputs& Inputs;
  const ParallelFor& For;
};

} // namespace

bool CutSliceBySlice(const SliceCutInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, SliceCutResult& result)
{
  const ImageGeometry& geometry = inputs.Task.Region.Geometry;
  const int size = geometry.Dimensions[2];
  const int first = std::max(0,
    std::min(size - 1,
      static_cast<int>(std::lround(geometry.ToIndex(inputs.Task.Seeds.front().Center)[2]))));
  const SliceCutter cutter(inputs, parallelFor);
  const Monitor slice = [&](double) { return monitor(static_cast<double>(result.Slices) / size); };
  result.Slices = 0;
  BitMask middle;
  if (!cutter.Cut(first, nullptr, slice, middle))
  {
    return false;
  }
  result.Organ = BitMask(geometry);
  result.Organ.Insert(middle, { { 0, 0, first } });
  ++result.Slices;
  for (const int direction : { 1, -1 })
  {
    BitMask before = middle;
    for (int k = first + direction; k >= 0 && k < size && before.Count() > 0; k += direction)
    {
      BitMask next;
      if (!cutter.Cut(k, &before, slice, next))
      {
        return false;
      }
      result.Organ.Insert(next, { { 0, 0, k } });
      before = std::move(next);
      ++result.Slices;
    }
  }
  return true;
}

} // namespace FlipFree
