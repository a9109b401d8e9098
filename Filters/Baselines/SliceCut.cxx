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
  SliceCutter(const BaselineTask& task, const std::vector<float>& logOdds,
    const BitMask& candidates, const BitMask& seeds, const MinimumCutSettings& settings,
    double margin, const ParallelFor& parallelFor)
    : Task(task)
    , LogOdds(logOdds)
    , Candidates(candidates)
    , Seeds(seeds)
    , Settings(settings)
    , Margin(margin)
    , For(parallelFor)
  {
  }

  // The organ in plane k, given that in the plane before, or none for the first. False if stopped.
  bool Cut(int k, const BitMask* before, const Monitor& monitor, BitMask& organ) const
  {
    const ImageGeometry& region = this->Task.Region.Geometry;
    const VoxelBox box{ { { 0, 0, k } },
      { { region.Dimensions[0], region.Dimensions[1], k + 1 } } };
    const ImageGeometry plane = CropGeometry(region, box);
    const std::size_t first = region.Offset(0, 0, k);
    const float* const odds = this->LogOdds.data() + first;
    const std::vector<float> oddsOfPlane(odds, odds + plane.NumberOfVoxels());
    BitMask candidates = this->Candidates.Cropped(box);
    BitMask seeds = this->Seeds.Cropped(box);
    std::vector<std::size_t> sources;
    if (before)
    {
      BitMask near = *before;
      BitMask core = *before;
      if (!Dilate(near, this->Margin, this->For, monitor) ||
        !Erode(core, this->Margin, this->For, monitor))
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
    if (!FindMinimumCut({ this->Task.Region.Voxels.data() + first, plane }, oddsOfPlane, candidates,
          seeds, this->Settings, monitor, organ))
    {
      return false;
    }
    const std::vector<std::size_t> certain = OffsetsOf(seeds);
    sources.insert(sources.end(), certain.begin(), certain.end());
    return KeepConnected(organ, sources, monitor);
  }

private:
  const BaselineTask& Task;
  const std::vector<float>& LogOdds;
  const BitMask& Candidates;
  const BitMask& Seeds;
  const MinimumCutSettings& Settings;
  double Margin;
  const ParallelFor& For;
};

} // namespace

bool CutSliceBySlice(const BaselineTask& task, const std::vector<float>& logOdds,
  const BitMask& candidates, const BitMask& seeds, const MinimumCutSettings& settings,
  double margin, const ParallelFor& parallelFor, const Monitor& monitor, BitMask& organ,
  int& slices)
{
  const ImageGeometry& geometry = task.Region.Geometry;
  const int size = geometry.Dimensions[2];
  const int first = std::max(0,
    std::min(size - 1,
      static_cast<int>(std::lround(geometry.ToIndex(task.Seeds.front().Center)[2]))));
  const SliceCutter cutter(task, logOdds, candidates, seeds, settings, margin, parallelFor);
  const Monitor slice = [&](double) { return monitor(static_cast<double>(slices) / size); };
  slices = 0;
  BitMask middle;
  if (!cutter.Cut(first, nullptr, slice, middle))
  {
    return false;
  }
  organ = BitMask(geometry);
  organ.Insert(middle, { { 0, 0, first } });
  ++slices;
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
      organ.Insert(next, { { 0, 0, k } });
      before = std::move(next);
      ++slices;
    }
  }
  return true;
}

} // namespace FlipFree
