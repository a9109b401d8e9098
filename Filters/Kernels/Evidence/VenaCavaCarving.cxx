#include "Evidence/VenaCavaCarving.h"

#include "Evidence/OrganCarving.h"
#include "Evidence/VesselTrack.h"
#include "Image/BallMorphology.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

// In milliliters.
constexpr double SmallestLiver = 700;
constexpr double LargestLiver = 4000;

// Where the vein may lie, from the organ's center, in radii of a ball of the organ's volume.
constexpr double LeftFrom = 0.2;
constexpr double LeftTo = 1.05;
constexpr double PosteriorFrom = -0.4;
constexpr double PosteriorTo = 0.65;

// In millimeters.
constexpr double BeyondOrgan = 40;
constexpr double SliceThickness = 5;
constexpr double ThickestSlices = 10; // a vein cannot be followed through thicker ones
constexpr double LeastInOrgan = 40;
constexpr double LeastBelow = 30;
constexpr double LeastAbove = 15;
constexpr double Wall = 1;          // of the vein
constexpr double Remnant = 6;       // of the mask, beside the vein
constexpr double RemnantRadius = 2; // what is thinner than twice as much is taken for its wall

// In volumes of the vein: what else hangs on to the organ only by it is kept with it.
constexpr double MostLost = 1.5;

// The axes of an image that are nearest to those of the body, each with its direction.
struct BodyAxes
{
  std::array<int, 3> Axis; // left, posterior, superior
  std::array<double, 3> Sign;
};

BodyAxes AxesOf(const ImageGeometry& geometry)
{
  BodyAxes axes{};
  const Eigen::Matrix3d& direction = geometry.Direction;
  direction.row(2).cwiseAbs().maxCoeff(&axes.Axis[2]);
  const int one = (axes.Axis[2] + 1) % 3;
  const int other = (axes.Axis[2] + 2) % 3;
  const bool isLeft = std::abs(direction(0, one)) >= std::abs(direction(0, other));
  axes.Axis[0] = isLeft ? one : other;
  axes.Axis[1] = isLeft ? other : one;
  for (int axis = 0; axis < 3; ++axis)
  {
    axes.Sign[axis] = direction(axis, axes.Axis[axis]) < 0 ? -1 : 1;
  }
  return axes;
}

// Of the voxels of a mask, in millimeters along the image's axes from its first voxel.
Eigen::Vector3d CenterOf(const BitMask& mask)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  mask.ForEachRun(0, mask.GetGeometry().Dimensions[2],
    [&sum](int begin, int end, int j, int k)
    { sum += (end - begin) * Eigen::Vector3d(0.5 * (begin + end - 1), j, k); });
  return mask.GetGeometry().Spacing.cwiseProduct(sum / static_cast<double>(mask.Count()));
}

// Along the body's axes: from the bottom to the top, and by the signs of the others.
DiskGrid GridFor(const BitMask& organ)
{
  const ImageGeometry& geometry = organ.GetGeometry();
  const Eigen::Vector3d center = CenterOf(organ);
  const double radius = RadiusOf(organ, { center, 0 });
  const BodyAxes axes = AxesOf(geometry);
  DiskGrid grid;
  grid.Across = axes.Axis[2];
  grid.Within = { { axes.Axis[0], axes.Axis[1] } };
  grid.Sign = { { axes.Sign[0], axes.Sign[1] } };
  const double spacing = geometry.Spacing[grid.Across];
  const VoxelBox bounds = organ.Bounds();
  const int step = std::max(1, static_cast<int>(std::lround(SliceThickness / spacing)));
  const int beyond = static_cast<int>(BeyondOrgan / spacing);
  const int first = std::max(0, bounds.Begin[grid.Across] - beyond);
  const int end = std::min(geometry.Dimensions[grid.Across], bounds.End[grid.Across] + beyond);
  grid.Thickness = step * spacing;
  const int middle = static_cast<int>(std::lround(center[grid.Across] / spacing));
  for (int slice = middle - (middle - first) / step * step; slice < end; slice += step)
  {
    grid.Slices.push_back(slice);
  }
  if (axes.Sign[2] < 0)
  {
    std::reverse(grid.Slices.begin(), grid.Slices.end());
  }
  const double from[] = { LeftFrom, PosteriorFrom };
  const double to[] = { LeftTo, PosteriorTo };
  for (int axis = 0; axis < 2; ++axis)
  {
    const int along = grid.Within[axis];
    const double last = (geometry.Dimensions[along] - 1) * geometry.Spacing[along];
    // Whole steps from the center, so that what the image's end cuts off moves no other place.
    const int begin = static_cast<int>(std::ceil(from[axis] * radius / DiskGrid::Step));
    const int stop = static_cast<int>(std::floor(to[axis] * radius / DiskGrid::Step));
    for (int place = begin; place <= stop; ++place)
    {
      const double at = center[along] + axes.Sign[axis] * place * DiskGrid::Step;
      if (at >= 0 && at <= last)
      {
        grid.First[axis] = grid.Count[axis] == 0 ? at : grid.First[axis];
        ++grid.Count[axis];
      }
    }
  }
  return grid;
}

class VenaCava
{
public:
  VenaCava(const ImageView<float>& smooth, const ImageMaker& make, const ParallelFor& parallelFor,
    const Monitor& monitor)
    : Smooth(smooth)
    , Make(make)
    , Parallel(parallelFor)
    , Ask(monitor)
  {
  }

  // Returns false if it was stopped.
  bool Find(const BitMask& organ)
  {
    const double volume = organ.GetGeometry().Milliliters(organ.Count());
    if (volume < SmallestLiver || volume > LargestLiver ||
      organ.GetGeometry().Spacing.maxCoeff() > ThickestSlices)
    {
      return true;
    }
    this->Grid = GridFor(organ);
    if (this->Grid.Size() == 0)
    {
      return true;
    }
    if (!this->Make(BoxOf(this->Grid, this->Smooth.Geometry)) || !this->Ask(0))
    {
      return false;
    }
    const std::vector<DiskSlice> slices =
      MeasureDisks(this->Smooth, organ, this->Grid, this->Parallel);
    if (!this->Ask(0.5))
    {
      return false;
    }
    this->Track = FindVesselTrack(this->Grid, slices, this->Parallel);
    return true;
  }

  bool IsClear() const
  {
    const auto disks = this->Track.InOrgan.size();
    return disks > 1 && static_cast<double>(disks) * this->Grid.Thickness >= LeastInOrgan &&
      (this->Track.LengthBefore >= LeastBelow || this->Track.LengthBehind >= LeastAbove);
  }

  BitMask MaskOf() const
  {
    BitMask vein(this->Smooth.Geometry);
    const auto& disks = this->Track.InOrgan;
    for (std::size_t next = 1; next < disks.size(); ++next)
    {
      const int from = this->Grid.Slices[disks[next - 1].Slice];
      const int to = this->Grid.Slices[disks[next].Slice];
      const int steps = std::abs(to - from);
      for (int step = 0; step <= steps; ++step)
      {
        this->Insert(to > from ? from + step : from - step,
          Between(disks[next - 1], disks[next], static_cast<double>(step) / steps), vein);
      }
    }
    return vein;
  }

private:
  static VesselTrack::Disk Between(const VesselTrack::Disk& one, const VesselTrack::Disk& other,
    double part)
  {
    const auto mix = [part](double a, double b) { return a + part * (b - a); };
    return { one.Slice,
      { { mix(one.Center[0], other.Center[0]), mix(one.Center[1], other.Center[1]) } },
      mix(one.Radius, other.Radius) };
  }

  void Insert(int slice, const VesselTrack::Disk& disk, BitMask& vein) const
  {
    const ImageGeometry& geometry = this->Smooth.Geometry;
    const double radius = disk.Radius + Wall;
    std::array<int, 2> begin{};
    std::array<int, 2> end{};
    for (int axis = 0; axis < 2; ++axis)
    {
      const int along = this->Grid.Within[axis];
      const double spacing = geometry.Spacing[along];
      begin[axis] =
        std::max(0, static_cast<int>(std::ceil((disk.Center[axis] - radius) / spacing)));
      end[axis] = std::min(geometry.Dimensions[along],
        static_cast<int>(std::floor((disk.Center[axis] + radius) / spacing)) + 1);
    }
    std::array<int, 3> voxel{};
    voxel[this->Grid.Across] = slice;
    for (int second = begin[1]; second < end[1]; ++second)
    {
      for (int first = begin[0]; first < end[0]; ++first)
      {
        voxel[this->Grid.Within[0]] = first;
        voxel[this->Grid.Within[1]] = second;
        const double x = first * geometry.Spacing[this->Grid.Within[0]] - disk.Center[0];
        const double y = second * geometry.Spacing[this->Grid.Within[1]] - disk.Center[1];
        if (x * x + y * y <= radius * radius)
        {
          vein.Insert(voxel[0], voxel[1], voxel[2]);
        }
      }
    }
  }

  const ImageView<float>& Smooth;
  const ImageMaker& Make;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  DiskGrid Grid;
  VesselTrack Track;
};

BitMask Joined(BitMask mask, const std::vector<VoxelRun>& runs)
{
  for (const VoxelRun& run : runs)
  {
    mask.InsertRun(run.Begin, run.End, run.J, run.K);
  }
  return mask;
}

// Beside the vein, what is left of the mask may be thin sheets of its wall.
bool RemoveRemnants(const BitMask& vein, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  const VoxelBox box =
    WidenedBy(vein.Bounds(), Remnant + 2 * RemnantRadius, 1, geometry).Cropped(WholeBox(geometry));
  BitMask near = vein.Cropped(box);
  BitMask opened = mask.Cropped(box);
  if (!Dilate(near, Remnant, parallelFor, monitor) ||
    !Erode(opened, RemnantRadius, parallelFor, monitor) ||
    !Dilate(opened, RemnantRadius, parallelFor, monitor))
  {
    return false;
  }
  near.Remove(opened);
  BitMask thin(geometry);
  thin.Insert(near, box.Begin);
  mask.Remove(thin);
  return true;
}

} // namespace

bool CarveVenaCava(const ImageView<float>& smooth, const ImageMaker& make,
  const std::vector<VoxelRun>& inside, const SeedSphere& seed, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
{
  if (modality != Modality::CT)
  {
    return true;
  }
  std::size_t most = mask.Count();
  for (const VoxelRun& run : inside)
  {
    most += run.End - run.Begin;
  }
  if (smooth.Geometry.Milliliters(most) < SmallestLiver) // as most organs are
  {
    return true;
  }
  const Monitor proceed = [&monitor](double fraction) { return monitor(0.5 * fraction); };
  VenaCava cava(smooth, make, parallelFor, proceed);
  if (!cava.Find(Joined(mask, inside)))
  {
    return false;
  }
  if (!cava.IsClear())
  {
    return true;
  }
  const BitMask vein = cava.MaskOf();
  const std::vector<std::size_t> sources = VoxelsAround(smooth.Geometry, seed);
  const auto isInVein = [&](std::size_t voxel)
  {
    const auto [i, j, k] = IndexOf(voxel, smooth.Geometry);
    return vein(i, j, k);
  };
  if (std::any_of(sources.begin(), sources.end(), isInVein))
  {
    return true;
  }
  BitMask carved = mask;
  carved.Remove(vein);
  const Monitor goOn = [&monitor](double) { return monitor(0.5); };
  if (!RemoveRemnants(vein, parallelFor, goOn, carved) || !KeepConnected(carved, sources, goOn))
  {
    return false;
  }
  const double lost = static_cast<double>(mask.Count() - carved.Count());
  if (lost <= MostLost * static_cast<double>(vein.Count()))
  {
    mask = std::move(carved);
  }
  return true;
}

} // namespace FlipFree
