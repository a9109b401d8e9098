#include "Evidence/VenaCavaCarving.h"

#include "Evidence/OrganCarving.h"
#include "Image/NoData.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/LeakControl.h"
#include "Quantile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr double SmallestLiver = 700; // ml
constexpr double LargestLiver = 4000;
constexpr double ThickestSlices = 10; // mm; a vein cannot be followed through thicker ones

// Where the vein's center may be, to the left, posterior and above, in radii of a ball of the
// organ's volume from its center.
constexpr double NearestCenter[] = { 0.2, -0.4, -1.9 };
constexpr double FarthestCenter[] = { 1.05, 0.65, 1.9 };

constexpr double GridStep = 2; // mm, within slices
constexpr double SliceStep = 5;
constexpr double Slope = 1.2;                 // the steepest
constexpr float CostOfShift = 0.008F;         // per mm2 from slice to slice
constexpr double VeinRadii[] = { 9, 11, 13 }; // mm
constexpr double Wall = 1;
constexpr double RimBegin = 2; // mm beyond the radius
constexpr double RimEnd = 4;
constexpr int Margin = 9; // of the grid, for the rim; steps

// HU. Darker and brighter gray values say no more; a difference says nothing, or all.
constexpr float Darkest = -100;
constexpr float Brightest = 300;
constexpr float NoEdge = 20;
constexpr float ClearEdge = 60;

// How much of the rim must be clear for a disk to speak for the vein; in the organ, a part is
// hidden.
constexpr float LeastRimOutside = 0.45F;
constexpr float LeastRimInOrgan = 0.25F;
// In clear disks: so many make a vein of a tube that stands alone below or above the organ; further
// ones do not count, so that no other vessel wins by its length.
constexpr float LeastAlone = 1;
constexpr float MostAlone = 3.2F;
constexpr double LeastInOrgan = 40; // mm

// In volumes of the vein: what else hangs on to the organ only by it is kept with it.
constexpr double MostLost = 1.5;

// Along the axes of the body, whatever those of the image.
ImageGeometry GridBeside(const BitMask& organ)
{
  const ImageGeometry& geometry = organ.GetGeometry();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  organ.ForEachRun(0, geometry.Dimensions[2],
    [&sum](int begin, int end, int j, int k)
    { sum += (end - begin) * Eigen::Vector3d(0.5 * (begin + end - 1), j, k); });
  const Eigen::Vector3d center = geometry.ToPhysical(sum / static_cast<double>(organ.Count()));
  const double radius = RadiusOf(organ, { center, 0 });
  const Eigen::Vector3i margin(Margin, Margin, 0);
  ImageGeometry grid;
  grid.Spacing = { GridStep, GridStep, SliceStep };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double unit = radius / grid.Spacing[axis];
    const double first = std::ceil(NearestCenter[axis] * unit) - margin[axis];
    grid.Origin[axis] = center[axis] + first * grid.Spacing[axis];
    grid.Dimensions[axis] =
      static_cast<int>(FarthestCenter[axis] * unit - first) + margin[axis] + 1;
  }
  return grid;
}

VoxelBox BoxOf(const ImageGeometry& grid, const ImageGeometry& geometry)
{
  PointList corners(8, 3);
  for (int corner = 0; corner < 8; ++corner)
  {
    corners.row(corner) = grid.ToPhysical(Eigen::Vector3d((corner & 1) * (grid.Dimensions[0] - 1),
      (corner >> 1 & 1) * (grid.Dimensions[1] - 1), (corner >> 2) * (grid.Dimensions[2] - 1)));
  }
  return BoxAroundPoints(geometry, corners, 0);
}

// A cross-section that the vein may have.
struct Disk
{
  Eigen::Vector3d Center = Eigen::Vector3d::Zero();
  double Radius = 0;
  float Evidence = -1;
  bool IsInOrgan = false; // half of it
};

// Of disks of one radius: steps of the grid from the center.
struct DiskSamples
{
  double Radius;
  std::vector<std::ptrdiff_t> Inside;
  std::vector<std::ptrdiff_t> Rim;

  DiskSamples(double radius, std::ptrdiff_t row)
    : Radius(radius)
  {
    for (int j = -Margin; j <= Margin; ++j)
    {
      for (int i = -Margin; i <= Margin; ++i)
      {
        const double length = GridStep * std::hypot(i, j);
        if (length < radius - RimBegin)
        {
          this->Inside.push_back(i + row * j);
        }
        else if (length >= radius + RimBegin && length <= radius + RimEnd)
        {
          this->Rim.push_back(i + row * j);
        }
      }
    }
  }
};

// The best disks around the grid's places, in the slices of the grid.
class DiskSearch
{
public:
  DiskSearch(const ImageView<float>& image, const BitMask& organ, const ImageGeometry& grid)
    : Image(image)
    , Organ(organ)
    , Grid(grid)
    , Gray(grid.NumberOfVoxels(), Darkest)
    , Covered(Gray.size(), 0)
    , Disks(Gray.size())
  {
    for (const double radius : VeinRadii)
    {
      this->Samples.emplace_back(radius, grid.Dimensions[0]);
    }
  }

  std::vector<Disk> Execute(const ParallelFor& parallelFor)
  {
    for (const auto visit : { &DiskSearch::Read, &DiskSearch::Measure })
    {
      parallelFor(0, this->Grid.Dimensions[2],
        [&](std::ptrdiff_t first, std::ptrdiff_t last)
        {
          const std::size_t perSlice = this->Gray.size() / this->Grid.Dimensions[2];
          for (std::size_t place = first * perSlice; place < last * perSlice; ++place)
          {
            (this->*visit)(place);
          }
        });
    }
    return std::move(this->Disks);
  }

private:
  // By the nearest voxel.
  void Read(std::size_t place)
  {
    Disk& disk = this->Disks[place];
    disk.Center = CenterOf(place, this->Grid);
    const ImageGeometry& geometry = this->Image.Geometry;
    const Eigen::Array3i voxel = geometry.ToIndex(disk.Center).array().round().cast<int>();
    if (geometry.Contains(voxel[0], voxel[1], voxel[2]))
    {
      const float value = this->Image(voxel[0], voxel[1], voxel[2]);
      this->Gray[place] = HasData(value) ? std::clamp(value, Darkest, Brightest) : Darkest;
      this->Covered[place] = this->Organ(voxel[0], voxel[1], voxel[2]) ? 1 : 0;
    }
  }

  void Measure(std::size_t place)
  {
    const auto [i, j, k] = IndexOf(place, this->Grid);
    if (std::min(i, j) < Margin || i + Margin >= this->Grid.Dimensions[0] ||
      j + Margin >= this->Grid.Dimensions[1])
    {
      return;
    }
    Disk& disk = this->Disks[place];
    for (const DiskSamples& samples : this->Samples)
    {
      std::vector<float> values;
      std::size_t covered = 0;
      for (const std::ptrdiff_t step : samples.Inside)
      {
        values.push_back(this->Gray[place + step]);
        covered += this->Covered[place + step];
      }
      const bool isInOrgan = 2 * covered >= values.size();
      const float value = TakeQuantile(values, 0.5);
      // How much of a region is darker than the disk.
      const auto darker = [&](const std::vector<std::ptrdiff_t>& steps)
      {
        float sum = 0;
        for (const std::ptrdiff_t step : steps)
        {
          const float difference = value - this->Gray[place + step];
          sum += std::clamp((difference - NoEdge) / (ClearEdge - NoEdge), 0.0F, 1.0F);
        }
        return sum / static_cast<float>(steps.size());
      };
      const float evidence = darker(samples.Rim) - darker(samples.Inside) -
        (isInOrgan ? LeastRimInOrgan : LeastRimOutside);
      if (evidence > disk.Evidence)
      {
        disk = { disk.Center, samples.Radius, evidence, isInOrgan };
      }
    }
  }

  const ImageView<float>& Image;
  const BitMask& Organ;
  const ImageGeometry& Grid;
  std::vector<DiskSamples> Samples;
  std::vector<float> Gray;
  std::vector<unsigned char> Covered; // by the organ
  std::vector<Disk> Disks;
};

// The best chain of disks, by dynamic programming.
class VeinSearch
{
public:
  VeinSearch(const ImageGeometry& grid, const std::vector<Disk>& disks)
    : Disks(disks)
    , Count(static_cast<std::ptrdiff_t>(disks.size()))
    , PerSlice(Count / grid.Dimensions[2])
  {
    const int most = static_cast<int>(Slope * SliceStep / GridStep);
    for (int j = -most; j <= most; ++j)
    {
      for (int i = -most; i <= most; ++i)
      {
        const int square = i * i + j * j;
        if (square <= most * most)
        {
          this->Moves.emplace_back(i + static_cast<std::ptrdiff_t>(grid.Dimensions[0]) * j,
            CostOfShift * static_cast<float>(GridStep * GridStep * square));
        }
      }
    }
  }

  // In the organ, from the top to the bottom.
  std::vector<Disk> Execute() const
  {
    const std::vector<float> none(this->Disks.size(), 0);
    const Chains below = this->Follow(1, false, none);
    const Chains above = this->Follow(-1, false, none);
    const Chains inOrgan = this->Follow(1, true, below.Score);
    Link top;
    Link alone;
    for (std::ptrdiff_t disk = 0; disk < this->Count; ++disk)
    {
      if (this->Disks[disk].IsInOrgan && inOrgan.Score[disk] + MostAlone > top.Score)
      {
        const Link onward = this->Best(above.Score, disk, this->PerSlice);
        if (inOrgan.Score[disk] + onward.Score > top.Score)
        {
          top = { inOrgan.Score[disk] + onward.Score, disk };
          alone = onward;
        }
      }
    }
    std::vector<Disk> vein;
    std::ptrdiff_t disk = top.Disk;
    for (; disk >= 0 && this->Disks[disk].IsInOrgan; disk = inOrgan.From[disk])
    {
      vein.push_back(this->Disks[disk]);
    }
    alone.Score += disk < 0 ? 0 : below.Score[disk];
    return alone.Score < LeastAlone ? std::vector<Disk>() : vein;
  }

private:
  // The best ones that end in each disk, and the disks before.
  struct Chains
  {
    std::vector<float> Score;
    std::vector<std::ptrdiff_t> From;
  };

  struct Link
  {
    float Score = 0;
    std::ptrdiff_t Disk = -1;
  };

  // To a disk from the slice that is so many disks further on.
  Link Best(const std::vector<float>& scores, std::ptrdiff_t disk, std::ptrdiff_t onward) const
  {
    Link best;
    if (this->Disks[disk].Radius == 0 || disk + onward < 0 || disk + onward >= this->Count)
    {
      return best;
    }
    for (const auto& [shift, cost] : this->Moves)
    {
      const std::ptrdiff_t other = disk + onward + shift;
      if (scores[other] - cost > best.Score)
      {
        best = { scores[other] - cost, other };
      }
    }
    return best;
  }

  // Slice after slice up or down, through disks in the organ or through the others. Chains begin
  // anywhere, and where those that have the scores end.
  Chains Follow(int direction, bool inOrgan, const std::vector<float>& scores) const
  {
    Chains chains{ scores, std::vector<std::ptrdiff_t>(this->Disks.size(), -1) };
    for (std::ptrdiff_t step = 0; step < this->Count; ++step)
    {
      const std::ptrdiff_t disk = direction > 0 ? step : this->Count - 1 - step;
      if (this->Disks[disk].IsInOrgan == inOrgan)
      {
        const Link before = this->Best(chains.Score, disk, -direction * this->PerSlice);
        const float score = before.Score + this->Disks[disk].Evidence;
        chains.Score[disk] = inOrgan ? score : std::clamp(score, 0.0F, MostAlone);
        chains.From[disk] = before.Disk;
      }
    }
    return chains;
  }

  const std::vector<Disk>& Disks;
  const std::ptrdiff_t Count;
  const std::ptrdiff_t PerSlice;
  std::vector<std::pair<std::ptrdiff_t, float>> Moves; // with what they cost
};

BitMask MaskOf(const std::vector<Disk>& vein, const ImageGeometry& geometry)
{
  BitMask mask(geometry);
  for (std::size_t next = 1; next < vein.size(); ++next)
  {
    const Disk& high = vein[next - 1];
    const Eigen::Vector3d step = vein[next].Center - high.Center;
    const double reach = std::max(high.Radius, vein[next].Radius) + Wall + step.norm() / 2;
    for (const std::size_t voxel : VoxelsAround(geometry, { high.Center + step / 2, reach }))
    {
      const Eigen::Vector3d point = CenterOf(voxel, geometry) - high.Center;
      const double part = point.z() / step.z();
      const double radius = high.Radius + part * (vein[next].Radius - high.Radius) + Wall;
      if (part >= 0 && part <= 1 && (point - part * step).squaredNorm() <= radius * radius)
      {
        const auto [i, j, k] = IndexOf(voxel, geometry);
        mask.Insert(i, j, k);
      }
    }
  }
  return mask;
}

} // namespace

bool CarveVenaCava(const ImageView<float>& smooth, const ImageMaker& make,
  const std::vector<VoxelRun>& inside, const SeedSphere& seed, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
{
  const ImageGeometry& geometry = smooth.Geometry;
  if (modality != Modality::CT || geometry.Spacing.maxCoeff() > ThickestSlices)
  {
    return true;
  }
  BitMask organ = mask;
  for (const VoxelRun& run : inside)
  {
    organ.InsertRun(run.Begin, run.End, run.J, run.K);
  }
  const double volume = geometry.Milliliters(organ.Count());
  if (volume < SmallestLiver || volume > LargestLiver)
  {
    return true;
  }
  const ImageGeometry grid = GridBeside(organ);
  if (!make(BoxOf(grid, geometry)) || !monitor(0))
  {
    return false;
  }
  const std::vector<Disk> disks = DiskSearch(smooth, organ, grid).Execute(parallelFor);
  const std::vector<Disk> vein = VeinSearch(grid, disks).Execute();
  if (vein.empty() || vein.front().Center.z() - vein.back().Center.z() < LeastInOrgan)
  {
    return true;
  }
  const std::vector<std::size_t> sources = VoxelsAround(geometry, seed);
  const BitMask removed = MaskOf(vein, geometry);
  const auto isRemoved = [&](std::size_t voxel)
  {
    const auto [i, j, k] = IndexOf(voxel, geometry);
    return removed(i, j, k);
  };
  if (std::any_of(sources.begin(), sources.end(), isRemoved))
  {
    return true;
  }
  BitMask carved = mask;
  carved.Remove(removed);
  if (!KeepConnected(carved, sources, PartOf(monitor, 0.5, 1)))
  {
    return false;
  }
  const double lost = static_cast<double>(mask.Count() - carved.Count());
  if (lost <= MostLost * static_cast<double>(removed.Count()))
  {
    mask = std::move(carved);
  }
  return true;
}

} // namespace FlipFree
