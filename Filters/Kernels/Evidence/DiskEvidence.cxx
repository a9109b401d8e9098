#include "Evidence/DiskEvidence.h"

#include "Image/NoData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// Beyond which gray values say no more, in Hounsfield units.
constexpr float DarkestTissue = -100;
constexpr float BrightestTissue = 300;

// A difference at the rim that says nothing, and one that says it all, in Hounsfield units.
constexpr float NoEdge = 20;
constexpr float ClearEdge = 60;

// Millimeters beyond the rim, where the darker of two values counts.
constexpr double NearRim = 2;
constexpr double FarFromRim = 4;

constexpr int Rays = 24;

using Offset = std::array<double, 2>;

// Millimeters from the center.
std::vector<Offset> CircleOf(double radius, int count)
{
  std::vector<Offset> offsets;
  for (int ray = 0; ray < count; ++ray)
  {
    const double angle = 2 * EIGEN_PI * ray / count;
    offsets.push_back({ { radius * std::cos(angle), radius * std::sin(angle) } });
  }
  return offsets;
}

std::vector<Offset> DiskOf(double radius)
{
  std::vector<Offset> offsets{ { { 0, 0 } } };
  for (const Offset& inner : CircleOf(0.4 * radius, 6))
  {
    offsets.push_back(inner);
  }
  for (const Offset& outer : CircleOf(0.75 * radius, 12))
  {
    offsets.push_back(outer);
  }
  return offsets;
}

// The voxels of the same sample of disks about all places: one index of the voxel depends on the
// place's first coordinate alone, one on its second.
class SampledVoxels
{
public:
  SampledVoxels(const DiskGrid& grid, const ImageGeometry& geometry,
    const std::vector<Offset>& offsets)
    : Count(offsets.size())
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const int along = grid.Within[axis];
      for (int place = 0; place < grid.Count[axis]; ++place)
      {
        for (const Offset& offset : offsets)
        {
          const double length = grid.At(axis, place + offset[axis] / DiskGrid::Step);
          const double index = length / geometry.Spacing[along];
          this->Indices[axis].push_back(static_cast<int>(
            std::lround(std::max(0.0, std::min(index, geometry.Dimensions[along] - 1.0)))));
        }
      }
    }
  }

  std::size_t Size() const { return this->Count; }

  int IndexOf(int axis, int place, std::size_t sample) const
  {
    return this->Indices[axis][place * this->Count + sample];
  }

private:
  std::size_t Count;
  std::array<std::vector<int>, 2> Indices;
};

struct DiskSamples
{
  SampledVoxels Inside;
  SampledVoxels Near;
  SampledVoxels Far;
};

class SliceOfDisks
{
public:
  SliceOfDisks(const ImageView<float>& image, const BitMask& mask, const DiskGrid& grid, int slice)
    : Image(image)
    , Mask(mask)
    , Grid(grid)
    , Result{ std::vector<float>(grid.Size()), std::vector<float>(grid.Size()),
      std::vector<float>(grid.Size()), std::vector<float>(grid.Size()) }
  {
    this->Voxel[grid.Across] = slice;
  }

  DiskSlice Measure(const std::vector<DiskSamples>& ofRadii)
  {
    std::size_t disk = 0;
    for (const DiskSamples& samples : ofRadii)
    {
      for (int second = 0; second < this->Grid.Count[1]; ++second)
      {
        for (int first = 0; first < this->Grid.Count[0]; ++first, ++disk)
        {
          this->Place = { { first, second } };
          this->MeasureInside(samples.Inside, disk);
          this->MeasureRim(samples, disk);
        }
      }
    }
    return std::move(this->Result);
  }

private:
  // Where there is no data, NaN.
  float ValueAt(const SampledVoxels& samples, std::size_t sample)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Voxel[this->Grid.Within[axis]] = samples.IndexOf(axis, this->Place[axis], sample);
    }
    const auto [i, j, k] = this->Voxel;
    const float value = this->Image(i, j, k);
    return HasData(value) ? std::max(DarkestTissue, std::min(value, BrightestTissue))
                          : std::numeric_limits<float>::quiet_NaN();
  }

  void MeasureInside(const SampledVoxels& samples, std::size_t disk)
  {
    this->Values.clear();
    int covered = 0;
    for (std::size_t sample = 0; sample < samples.Size(); ++sample)
    {
      const float value = this->ValueAt(samples, sample);
      if (HasData(value))
      {
        this->Values.push_back(value);
      }
      covered += this->Mask(this->Voxel[0], this->Voxel[1], this->Voxel[2]) ? 1 : 0;
    }
    if (this->Values.empty())
    {
      this->Values.push_back(DarkestTissue); // a disk without data is no vessel
    }
    std::sort(this->Values.begin(), this->Values.end());
    const auto quantile = [&](double part)
    { return this->Values[std::lround(part * static_cast<double>(this->Values.size() - 1))]; };
    this->Result.Value[disk] = quantile(0.5);
    this->Result.Spread[disk] = quantile(0.84) - quantile(0.16);
    this->Result.Covered[disk] = static_cast<float>(covered) / static_cast<float>(samples.Size());
  }

  void MeasureRim(const DiskSamples& samples, std::size_t disk)
  {
    float sum = 0;
    for (std::size_t ray = 0; ray < samples.Near.Size(); ++ray)
    {
      const float near = this->ValueAt(samples.Near, ray);
      const float far = this->ValueAt(samples.Far, ray);
      if (HasData(near) && HasData(far))
      {
        const float difference = this->Result.Value[disk] - std::min(near, far);
        sum += std::max(0.0F, std::min((difference - NoEdge) / (ClearEdge - NoEdge), 1.0F));
      }
    }
    this->Result.Contrast[disk] = sum / Rays;
  }

  const ImageView<float>& Image;
  const BitMask& Mask;
  const DiskGrid& Grid;
  DiskSlice Result;
  std::array<int, 3> Voxel{};
  std::array<int, 2> Place{};
  std::vector<float> Values;
};

} // namespace

std::vector<DiskSlice> MeasureDisks(const ImageView<float>& image, const BitMask& mask,
  const DiskGrid& grid, const ParallelFor& parallelFor)
{
  std::vector<DiskSamples> samples;
  for (const double radius : DiskGrid::Radii)
  {
    const auto on = [&](const std::vector<Offset>& offsets)
    { return SampledVoxels(grid, image.Geometry, offsets); };
    samples.push_back({ on(DiskOf(radius)), on(CircleOf(radius + NearRim, Rays)),
      on(CircleOf(radius + FarFromRim, Rays)) });
  }
  std::vector<DiskSlice> slices(grid.Slices.size());
  parallelFor(0, static_cast<std::ptrdiff_t>(slices.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t slice = first; slice < last; ++slice)
      {
        slices[slice] = SliceOfDisks(image, mask, grid, grid.Slices[slice]).Measure(samples);
      }
    });
  return slices;
}

VoxelBox BoxOf(const DiskGrid& grid, const ImageGeometry& geometry)
{
  VoxelBox box;
  const auto [bottom, top] = std::minmax(grid.Slices.front(), grid.Slices.back());
  box.Begin[grid.Across] = bottom;
  box.End[grid.Across] = top + 1;
  const double margin = DiskGrid::Radii.back() + FarFromRim;
  for (int axis = 0; axis < 2; ++axis)
  {
    const int along = grid.Within[axis];
    const double spacing = geometry.Spacing[along];
    const double last = grid.At(axis, grid.Count[axis] - 1);
    const auto [low, high] = std::minmax(grid.First[axis], last);
    box.Begin[along] = static_cast<int>(std::floor((low - margin) / spacing));
    box.End[along] = static_cast<int>(std::ceil((high + margin) / spacing)) + 1;
  }
  return box.Cropped(WholeBox(geometry));
}

} // namespace FlipFree
