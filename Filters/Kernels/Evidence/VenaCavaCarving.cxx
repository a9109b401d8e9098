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

// Where the vein's center may be, to the left, posterior and above, in radii of a ball of the
// organ's volume from its center.
constexpr double NearestCenter[] = { 0.2, -0.4, -1.9 };
constexpr double FarthestCenter[] = { 1.05, 0.65, 1.9 };

constexpr double GridStep = 3; // mm, within slices
constexpr double SliceStep = 5;
constexpr double CostOfShift = 0.008; // per mm2 from slice to slice
constexpr int Reach = 2;              // of the vein, from slice to slice; steps
constexpr double VeinRadius = 12;     // mm, with its wall
constexpr double DiskRadius = 9;      // mm, of what of the vein is looked at
constexpr double RimBegin = 13;       // mm from the center
constexpr double RimEnd = 15;
constexpr int Margin = static_cast<int>(RimEnd / GridStep); // of the grid, for the rim; steps
static_assert(Reach <= Margin);

// HU. What is darker counts as fat, and so does what lies outside the image; a difference says
// nothing, or all.
constexpr float Fat = -100;
constexpr float NoEdge = 20;
constexpr float ClearEdge = 60;

// How much of the rim must be clear for a disk to speak for the vein.
constexpr float LeastRim = 0.25F;
// In clear disks: so many make a vein of a tube that stands alone below or above the organ; further
// ones do not count, so that no other vessel wins by its length.
constexpr float LeastAlone = 1;
constexpr float MostAlone = 3.2F;
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
  ImageGeometry grid;
  grid.Spacing = { GridStep, GridStep, SliceStep };
  const Eigen::Array3d unit = RadiusOf(organ, { center, 0 }) / grid.Spacing.array();
  const Eigen::Array3d margin(Margin, Margin, 0);
  const Eigen::Array3d first =
    (Eigen::Map<const Eigen::Array3d>(NearestCenter) * unit).ceil() - margin;
  const Eigen::Array3d size =
    (Eigen::Map<const Eigen::Array3d>(FarthestCenter) * unit - first).floor() + margin + 1;
  grid.Origin = center.array() + first * grid.Spacing.array();
  Eigen::Map<Eigen::Array3i>(grid.Dimensions.data()) = size.cast<int>();
  return grid;
}

VoxelBox BoxOf(const ImageGeometry& grid, const ImageGeometry& geometry)
{
  PointList ends(8, 3);
  for (int end = 0; end < 8; ++end)
  {
    ends.row(end) = grid.ToPhysical(Eigen::Vector3d((end & 1) * (grid.Dimensions[0] - 1),
      (end >> 1 & 1) * (grid.Dimensions[1] - 1), (end >> 2) * (grid.Dimensions[2] - 1)));
  }
  return BoxAroundPoints(geometry, ends, 0);
}

// Of the nearest voxels to the places of a grid.
struct GridVoxels
{
  std::vector<float> Gray;
  std::vector<unsigned char> IsInOrgan;

  GridVoxels(const ImageView<float>& image, const BitMask& organ, const ImageGeometry& grid)
    : Gray(grid.NumberOfVoxels(), Fat)
    , IsInOrgan(Gray.size(), 0)
  {
    for (std::size_t place = 0; place < this->Gray.size(); ++place)
    {
      const Eigen::Array3i voxel =
        image.Geometry.ToIndex(CenterOf(place, grid)).array().round().cast<int>();
      if (image.Geometry.Contains(voxel[0], voxel[1], voxel[2]))
      {
        const float value = image(voxel[0], voxel[1], voxel[2]);
        this->Gray[place] = HasData(value) ? std::max(value, Fat) : Fat;
        this->IsInOrgan[place] = organ(voxel[0], voxel[1], voxel[2]) ? 1 : 0;
      }
    }
  }
};

// Less than the evidence of any disk.
constexpr float NoDisk = -1;

// Cross-sections that the vein may have, around the places of a grid.
struct Disks
{
  std::vector<float> Evidence; // how much of the rim is darker, beyond what must be; or NoDisk
  std::vector<unsigned char> IsInOrgan; // half of it
};

Disks FindDisks(const GridVoxels& voxels, const ImageGeometry& grid, const ParallelFor& parallelFor)
{
  std::vector<std::ptrdiff_t> inside; // steps from the center
  std::vector<std::ptrdiff_t> rim;
  for (int j = -Margin; j <= Margin; ++j)
  {
    for (int i = -Margin; i <= Margin; ++i)
    {
      const double length = GridStep * std::hypot(i, j);
      const std::ptrdiff_t step = i + j * StepsOf(grid)[1];
      if (length < DiskRadius)
      {
        inside.push_back(step);
      }
      else if (length >= RimBegin && length <= RimEnd)
      {
        rim.push_back(step);
      }
    }
  }
  Disks disks{ std::vector<float>(grid.NumberOfVoxels(), NoDisk),
    std::vector<unsigned char>(grid.NumberOfVoxels(), 0) };
  const auto measure = [&](std::ptrdiff_t place, std::vector<float>& values)
  {
    values.clear();
    std::size_t inOrgan = 0;
    for (const std::ptrdiff_t step : inside)
    {
      values.push_back(voxels.Gray[place + step]);
      inOrgan += voxels.IsInOrgan[place + step];
    }
    const float value = TakeQuantile(values, 0.5);
    const auto darker = [&](const std::vector<std::ptrdiff_t>& steps)
    {
      float sum = 0;
      for (const std::ptrdiff_t step : steps)
      {
        const float difference = value - voxels.Gray[place + step];
        sum += std::clamp((difference - NoEdge) / (ClearEdge - NoEdge), 0.0F, 1.0F);
      }
      return sum / static_cast<float>(steps.size());
    };
    disks.IsInOrgan[place] = 2 * inOrgan >= inside.size() ? 1 : 0;
    disks.Evidence[place] = darker(rim) - darker(inside) - LeastRim;
  };
  parallelFor(0, grid.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<float> values;
      for (auto k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = Margin; j < grid.Dimensions[1] - Margin; ++j)
        {
          for (int i = Margin; i < grid.Dimensions[0] - Margin; ++i)
          {
            measure(static_cast<std::ptrdiff_t>(grid.Offset(i, j, k)), values);
          }
        }
      }
    });
  return disks;
}

// By dynamic programming: the best chain of disks, one in each slice, that ends in each disk.
class Chains
{
public:
  std::vector<float> Scores;
  std::vector<std::ptrdiff_t> From; // the disk before

  // Up or down (-1), through disks in the organ or through the others. Chains begin anywhere, and
  // where those that have the scores end.
  Chains(const Disks& disks, const ImageGeometry& grid, int direction, bool inOrgan,
    const std::vector<float>& scores)
    : Scores(scores)
    , From(scores.size(), -1)
    , Steps(StepsOf(grid))
  {
    const auto count = static_cast<std::ptrdiff_t>(scores.size());
    for (std::ptrdiff_t step = 0; step < count; ++step)
    {
      const std::ptrdiff_t disk = direction > 0 ? step : count - 1 - step;
      if (disks.Evidence[disk] > NoDisk && (disks.IsInOrgan[disk] != 0) == inOrgan)
      {
        const auto [before, other] = this->Best(disk - direction * this->Steps[2]);
        const float score = before + disks.Evidence[disk];
        this->Scores[disk] = inOrgan ? score : std::clamp(score, 0.0F, MostAlone);
        this->From[disk] = other;
      }
    }
  }

  // Of those that end near a place: what the best one brings to it, and its disk. None is -1.
  std::pair<float, std::ptrdiff_t> Best(std::ptrdiff_t place) const
  {
    std::pair<float, std::ptrdiff_t> best{ 0.0F, -1 };
    if (place < 0 || place >= static_cast<std::ptrdiff_t>(this->Scores.size()))
    {
      return best;
    }
    for (int j = -Reach; j <= Reach; ++j)
    {
      for (int i = -Reach; i <= Reach; ++i)
      {
        const int square = i * i + j * j;
        const std::ptrdiff_t other = place + j * this->Steps[1] + i;
        const float score =
          this->Scores[other] - static_cast<float>(CostOfShift * GridStep * GridStep * square);
        if (square <= Reach * Reach && score > best.first)
        {
          best = { score, other };
        }
      }
    }
    return best;
  }

private:
  std::array<std::ptrdiff_t, 3> Steps;
};

// The centers of the vein's disks in the organ, from the top to the bottom.
std::vector<Eigen::Vector3d> FindVein(const Disks& disks, const ImageGeometry& grid)
{
  const std::vector<float> none(grid.NumberOfVoxels(), 0);
  const Chains below(disks, grid, 1, false, none);
  const Chains above(disks, grid, -1, false, none);
  const Chains inOrgan(disks, grid, 1, true, below.Scores);
  float most = 0;
  float alone = 0;
  std::ptrdiff_t disk = -1;
  for (std::size_t place = 0; place < none.size(); ++place)
  {
    if (disks.IsInOrgan[place] != 0)
    {
      const float onward = above.Best(static_cast<std::ptrdiff_t>(place) + StepsOf(grid)[2]).first;
      if (inOrgan.Scores[place] + onward > most)
      {
        most = inOrgan.Scores[place] + onward;
        alone = onward;
        disk = static_cast<std::ptrdiff_t>(place);
      }
    }
  }
  std::vector<Eigen::Vector3d> centers;
  for (; disk >= 0 && disks.IsInOrgan[disk] != 0; disk = inOrgan.From[disk])
  {
    centers.push_back(CenterOf(disk, grid));
  }
  alone += disk < 0 ? 0 : below.Scores[disk];
  return alone < LeastAlone ? std::vector<Eigen::Vector3d>() : centers;
}

// Balls half-way between successive centers make a tube, whose round ends reach most of a radius
// farther.
BitMask MaskOf(const std::vector<Eigen::Vector3d>& centers, const ImageGeometry& geometry)
{
  BitMask mask(geometry);
  for (std::size_t next = 1; next < centers.size(); ++next)
  {
    const Eigen::Vector3d between = (centers[next - 1] + centers[next]) / 2;
    for (const std::size_t voxel : VoxelsAround(geometry, { between, VeinRadius }))
    {
      mask.Insert(voxel);
    }
  }
  return mask;
}

} // namespace

bool CarveVenaCava(const ImageView<float>& smooth, const ImageMaker& make, const SeedSphere& seed,
  Modality modality, const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
{
  const ImageGeometry& geometry = smooth.Geometry;
  // Through voxels longer than half the vein is wide, it cannot be followed.
  if (modality != Modality::CT || geometry.Spacing.maxCoeff() > VeinRadius ||
    geometry.Milliliters(mask.Count()) < SmallestLiver)
  {
    return true;
  }
  const ImageGeometry grid = GridBeside(mask);
  if (!make(BoxOf(grid, geometry)) || !monitor(0))
  {
    return false;
  }
  const std::vector<Eigen::Vector3d> centers =
    FindVein(FindDisks({ smooth, mask, grid }, grid, parallelFor), grid);
  if (centers.size() < 2)
  {
    return true;
  }
  const BitMask vein = MaskOf(centers, geometry);
  BitMask carved = mask;
  carved.Remove(vein);
  const std::vector<std::size_t> sources = VoxelsAround(geometry, seed);
  if (std::any_of(sources.begin(), sources.end(),
        [&vein](std::size_t voxel) { return vein(voxel); }))
  {
    return true;
  }
  if (!KeepConnected(carved, sources, PartOf(monitor, 0.5, 1)))
  {
    return false;
  }
  const double most = MostLost * static_cast<double>(vein.Count());
  if (static_cast<double>(mask.Count() - carved.Count()) <= most)
  {
    mask = std::move(carved);
  }
  return true;
}

} // namespace FlipFree
