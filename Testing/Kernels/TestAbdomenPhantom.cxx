#include "Phantom/AbdomenPhantom.h"

#include "ExampleSurfaces.h"
#include "Image/VoxelOffsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace FlipFree;
using Eigen::Vector3d;

namespace
{

// The grid that the phantom is drawn for, its voxels enlarged to be quick.
ImageGeometry AbdomenGrid(double enlarged = 1)
{
  ImageGeometry grid;
  grid.Dimensions = { { static_cast<int>(220 / enlarged), static_cast<int>(170 / enlarged),
    static_cast<int>(90 / enlarged) } };
  grid.Spacing = { 330.0 / grid.Dimensions[0], 255.0 / grid.Dimensions[1],
    270.0 / grid.Dimensions[2] };
  return grid;
}

struct Volume
{
  ImageGeometry Grid;
  std::vector<std::int16_t> Intensities;
  std::vector<std::uint8_t> Labels;
};

Volume Sample(const ImageGeometry& grid, const AbdomenOptions& anatomy = {},
  const SamplingOptions& options = {}, const ParallelFor& parallelFor = SerialFor)
{
  Volume volume{ grid, {}, {} };
  volume.Intensities.resize(grid.NumberOfVoxels());
  volume.Labels.resize(grid.NumberOfVoxels());
  const Phantom phantom = MakeAbdomenPhantom(GridExtent(grid), anatomy);
  EXPECT_TRUE(SampleTissues(phantom.Tissues, grid, options, volume.Intensities.data(),
    volume.Labels.data(), parallelFor));
  return volume;
}

// Which takes most of the time, and changes no label.
SamplingOptions WithoutPartialVolume()
{
  SamplingOptions options;
  options.PartialVolume = false;
  return options;
}

// For tests of the anatomy.
const Volume& DefaultVolume()
{
  static const Volume volume = Sample(AbdomenGrid(), {}, WithoutPartialVolume());
  return volume;
}

constexpr std::uint8_t Label(AbdomenLabel organ)
{
  return static_cast<std::uint8_t>(organ);
}

Vector3d LocalOf(const ImageGeometry& grid, std::size_t offset)
{
  const std::array<int, 3> index = IndexOf(offset, grid);
  Vector3d local;
  for (int axis = 0; axis < 3; ++axis)
  {
    local[axis] = (index[axis] - 0.5 * (grid.Dimensions[axis] - 1)) * grid.Spacing[axis];
  }
  return local;
}

// Sizes of a label's components; voxels are neighbors if they share at least `shared` coordinates
// (2: faces only, 0: corners too).
std::vector<std::size_t> Components(const Volume& volume, std::uint8_t label, int shared)
{
  std::vector<char> open(volume.Labels.size());
  for (std::size_t at = 0; at < open.size(); ++at)
  {
    open[at] = volume.Labels[at] == label;
  }
  std::vector<std::size_t> sizes;
  std::vector<std::size_t> front;
  for (std::size_t seed = 0; seed < open.size(); ++seed)
  {
    if (!open[seed])
    {
      continue;
    }
    open[seed] = 0;
    front = { seed };
    std::size_t size = 0;
    while (!front.empty())
    {
      const std::array<int, 3> index = IndexOf(front.back(), volume.Grid);
      front.pop_back();
      ++size;
      for (int way = 0; way < 27; ++way)
      {
        const int x = way % 3 - 1;
        const int y = way / 3 % 3 - 1;
        const int z = way / 9 - 1;
        if ((x == 0) + (y == 0) + (z == 0) < shared ||
          !volume.Grid.Contains(index[0] + x, index[1] + y, index[2] + z))
        {
          continue;
        }
        const std::size_t next = volume.Grid.Offset(index[0] + x, index[1] + y, index[2] + z);
        if (open[next])
        {
          open[next] = 0;
          front.push_back(next);
        }
      }
    }
    sizes.push_back(size);
  }
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

} // namespace

TEST(AbdomenAnatomy, OrgansHavePlausibleVolumes)
{
  const Volume& volume = DefaultVolume();
  const struct
  {
    AbdomenLabel Organ;
    double Minimum;
    double Maximum;
  } ranges[] = { { AbdomenLabel::Spleen, 100, 300 }, { AbdomenLabel::RightKidney, 90, 220 },
    { AbdomenLabel::LeftKidney, 90, 220 }, { AbdomenLabel::Gallbladder, 10, 50 },
    { AbdomenLabel::Esophagus, 10, 40 }, { AbdomenLabel::Liver, 1000, 1900 },
    { AbdomenLabel::Stomach, 150, 600 }, { AbdomenLabel::Aorta, 50, 130 },
    { AbdomenLabel::VenaCava, 50, 130 }, { AbdomenLabel::PortalVein, 8, 50 },
    { AbdomenLabel::Pancreas, 25, 120 } };
  for (const auto& range : ranges)
  {
    const double milliliters =
      std::count(volume.Labels.begin(), volume.Labels.end(), Label(range.Organ)) *
      volume.Grid.Spacing.prod() / 1000;
    EXPECT_GT(milliliters, range.Minimum) << "label " << int(Label(range.Organ));
    EXPECT_LT(milliliters, range.Maximum) << "label " << int(Label(range.Organ));
  }
  EXPECT_EQ(*std::max_element(volume.Labels.begin(), volume.Labels.end()), 11);
}

// Where three organs meet, a voxel may be connected by a corner; more than a handful may not.
TEST(AbdomenAnatomy, EveryOrganIsInOnePiece)
{
  const Volume& volume = DefaultVolume();
  for (std::uint8_t label = 1; label <= 11; ++label)
  {
    EXPECT_EQ(Components(volume, label, 0).size(), 1u) << "label " << int(label);
    const std::vector<std::size_t> byFaces = Components(volume, label, 2);
    std::size_t crumbs = 0;
    for (std::size_t i = 1; i < byFaces.size(); ++i)
    {
      crumbs += byFaces[i];
    }
    EXPECT_LE(crumbs, 5u) << "label " << int(label);
  }
}

// The nearest voxel of another label is at least as far as the seed's ball claims; 0.7 of the depth
// is the radius, within the coarseness of voxels.
TEST(AbdomenAnatomy, SeedsLieAsDeepAsTheyClaim)
{
  const Volume& volume = DefaultVolume();
  const Phantom phantom = MakeAbdomenPhantom(GridExtent(volume.Grid));
  EXPECT_EQ(phantom.Seeds.size(), 11u);
  EXPECT_STREQ(NameOf(AbdomenLabel::RightKidney), "right kidney");
  for (const PhantomSeed& seed : phantom.Seeds)
  {
    double depth = 1000;
    for (std::size_t at = 0; at < volume.Labels.size(); ++at)
    {
      if (volume.Labels[at] != seed.Label)
      {
        depth = std::min(depth, (LocalOf(volume.Grid, at) - seed.Start.Center).norm());
      }
    }
    EXPECT_LT(seed.Start.Radius, 0.73 * depth) << "label " << int(seed.Label);
    EXPECT_GT(seed.Start.Radius, 0.5 * depth) << "label " << int(seed.Label);
  }
}

TEST(AbdomenPhantom, LesionsDarkenTheLiverAndLeaveItsOutline)
{
  const ImageGeometry grid = AbdomenGrid(3);
  const Volume without = Sample(grid, {}, WithoutPartialVolume());
  AbdomenOptions anatomy;
  anatomy.Lesions = 6;
  const Volume with = Sample(grid, anatomy, WithoutPartialVolume());
  EXPECT_EQ(with.Labels, without.Labels);
  int darker = 0;
  for (std::size_t at = 0; at < with.Labels.size(); ++at)
  {
    if (with.Intensities[at] != without.Intensities[at])
    {
      EXPECT_EQ(with.Labels[at], Label(AbdomenLabel::Liver));
      darker += with.Intensities[at] < 90;
    }
  }
  // Six balls of 4 to 12 mm in radius.
  EXPECT_GT(darker * grid.Spacing.prod(), 1500);
  EXPECT_LT(darker * grid.Spacing.prod(), 6 * 7300);
  anatomy.Seed = 1;
  EXPECT_NE(Sample(grid, anatomy, WithoutPartialVolume()).Intensities, with.Intensities);
}

TEST(AbdomenPhantom, ScalesWithTheCrossSection)
{
  const Volume full = Sample(AbdomenGrid(3), {}, WithoutPartialVolume());
  ImageGeometry half = full.Grid;
  half.Spacing *= 0.5;
  EXPECT_EQ(Sample(half, {}, WithoutPartialVolume()).Labels, full.Labels);

  // A slab of six slices in the middle has what the whole has there, and fewer seeds.
  ImageGeometry slab = full.Grid;
  slab.Dimensions[2] = 6;
  const Volume part = Sample(slab, {}, WithoutPartialVolume());
  const std::size_t first = full.Grid.Offset(0, 0, 12);
  EXPECT_TRUE(std::equal(part.Labels.begin(), part.Labels.end(), full.Labels.begin() + first));
  const Phantom phantom = MakeAbdomenPhantom(GridExtent(slab));
  EXPECT_GT(phantom.Seeds.size(), 0u);
  EXPECT_LT(phantom.Seeds.size(), 11u);
}

// Brute force: every tissue asked at every voxel. A shape whose value exceeds the distance to its
// surface would be dropped from a box too early and be missed here.
TEST(AbdomenPhantom, HierarchyLabelsWhatEveryVoxelAloneWould)
{
  const Volume volume = Sample(AbdomenGrid(8));
  const TissueStack stack = MakeAbdomenPhantom(GridExtent(volume.Grid)).Tissues;
  for (std::size_t at = 0; at < volume.Labels.size(); ++at)
  {
    const Vector3d drawn = stack.ToDrawing(LocalOf(volume.Grid, at));
    auto layer = stack.Layers.rbegin();
    while (layer != stack.Layers.rend() && !(layer->Shape(drawn) < 0))
    {
      ++layer;
    }
    const int expected = layer == stack.Layers.rend() ? 0 : layer->Tissue.Label;
    ASSERT_EQ(int(volume.Labels[at]), expected) << LocalOf(volume.Grid, at).transpose();
  }
}

TEST(AbdomenPhantom, IsCutInAnyOrderIntoTheSameBits)
{
  const ImageGeometry grid = AbdomenGrid(6);
  SamplingOptions options;
  options.NoiseStandardDeviation = 12;
  options.NoiseCorrelation = 0.3;
  const Volume forward = Sample(grid, {}, options);
  const Volume backward = Sample(grid, {}, options, ScatteredFor);
  EXPECT_EQ(forward.Intensities, backward.Intensities);
  EXPECT_EQ(forward.Labels, backward.Labels);
}
