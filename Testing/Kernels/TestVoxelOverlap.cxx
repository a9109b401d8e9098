#include "Measures/VoxelOverlap.h"

#include "ExampleSurfaces.h"
#include "Mesh/SurfaceVoxelization.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

struct Mask
{
  ImageGeometry Grid;
  std::vector<unsigned char> Voxels;

  Mask(const Surface& surface, const ImageGeometry& grid)
    : Grid(grid)
    , Voxels(grid.NumberOfVoxels(), 0)
  {
    FillRuns<unsigned char>(VoxelizeSurface(surface.Points, surface.Triangles, grid), 3, grid,
      this->Voxels.data());
  }
  operator BitMask() const
  {
    return VoxelsWhere(
      ImageView<unsigned char>{ this->Voxels.data(), this->Grid },
      [](unsigned char value) { return value != 0; }, SerialFor);
  }
};

ImageGeometry UnitGrid()
{
  ImageGeometry grid;
  grid.Dimensions = { { 24, 20, 20 } };
  return grid;
}

} // namespace

TEST(VoxelOverlap, OfShiftedCubesIsClosedForm)
{
  const Mask reference(Box({ 2, 2, 2 }, { 12, 12, 12 }), UnitGrid());
  for (int shift = 0; shift <= 10; ++shift)
  {
    const Mask shifted(Box({ 2.0 + shift, 2, 2 }, { 12.0 + shift, 12, 12 }), UnitGrid());
    const VoxelOverlap overlap = MeasureOverlap(shifted, reference);
    EXPECT_EQ(overlap.Segmentation, 1000u);
    EXPECT_EQ(overlap.Reference, 1000u);
    EXPECT_EQ(overlap.Intersection, 1000u - 100u * shift);
    EXPECT_DOUBLE_EQ(overlap.Dice(), (10.0 - shift) / 10);
    EXPECT_DOUBLE_EQ(overlap.Jaccard(), (10.0 - shift) / (10 + shift));
    EXPECT_DOUBLE_EQ(overlap.RelativeVolumeDifference(), 0);
  }
}

TEST(VoxelOverlap, VolumeDifferenceIsSignedAndTheRestIsSymmetric)
{
  const Mask reference(Box({ 2, 2, 2 }, { 12, 12, 12 }), UnitGrid());
  const Mask smaller(Box({ 2, 2, 2 }, { 12, 12, 7 }), UnitGrid());
  const VoxelOverlap there = MeasureOverlap(smaller, reference);
  const VoxelOverlap back = MeasureOverlap(reference, smaller);
  EXPECT_DOUBLE_EQ(there.RelativeVolumeDifference(), -0.5);
  EXPECT_DOUBLE_EQ(back.RelativeVolumeDifference(), 1);
  EXPECT_DOUBLE_EQ(there.Dice(), 2.0 / 3);
  EXPECT_EQ(there.Dice(), back.Dice());
  EXPECT_EQ(there.Jaccard(), back.Jaccard());
  EXPECT_EQ(MeasureOverlap(smaller, reference, ScatteredFor).Intersection, there.Intersection);
}

TEST(VoxelOverlap, CountsWhatOneByOneCounts)
{
  Mask one(Box({ 2, 2, 2 }, { 12, 12, 12 }), UnitGrid());
  Mask two = one;
  // All inside; then any mixture, with any value for inside.
  for (unsigned trial = 0; trial < 4; ++trial)
  {
    std::size_t counts[3] = { 0, 0, 0 };
    for (std::size_t voxel = 0; voxel < one.Voxels.size(); ++voxel)
    {
      const auto hash = static_cast<unsigned>(voxel * 2654435761U) >> 16U;
      one.Voxels[voxel] = trial == 0 ? 255 : hash % (trial + 1);
      two.Voxels[voxel] = trial == 0 ? 1 : hash / 7 % (trial + 1);
      counts[0] += one.Voxels[voxel] != 0;
      counts[1] += two.Voxels[voxel] != 0;
      counts[2] += one.Voxels[voxel] != 0 && two.Voxels[voxel] != 0;
    }
    for (const ParallelFor& parallelFor : { ParallelFor(SerialFor), ParallelFor(ScatteredFor) })
    {
      const VoxelOverlap overlap = MeasureOverlap(one, two, parallelFor);
      EXPECT_EQ(overlap.Segmentation, counts[0]);
      EXPECT_EQ(overlap.Reference, counts[1]);
      EXPECT_EQ(overlap.Intersection, counts[2]);
    }
  }
}

TEST(VoxelOverlap, RefusesEmptyMasksAndOtherGrids)
{
  const Mask mask(Box({ 2, 2, 2 }, { 12, 12, 12 }), UnitGrid());
  Mask empty = mask;
  empty.Voxels.assign(empty.Voxels.size(), 0);
  const auto errorOf = [](const Mask& segmentation, const Mask& reference)
  { return ErrorOf([&] { MeasureOverlap(segmentation, reference); }); };
  EXPECT_EQ(errorOf(mask, empty).find("the reference is empty"), 0u) << errorOf(mask, empty);
  EXPECT_EQ(errorOf(empty, mask).find("the segmentation is empty: no voxel is inside; "), 0u);

  Mask other = mask;
  other.Grid.Dimensions = { { 20, 24, 20 } };
  EXPECT_NE(errorOf(other, mask).find("dimensions of the segmentation (20, 24, 20)"),
    std::string::npos)
    << errorOf(other, mask);
  other = mask;
  other.Grid.Origin.y() = 0.5;
  EXPECT_NE(errorOf(other, mask).find("origins"), std::string::npos);
  other = mask;
  other.Grid.Spacing.z() = 1.5;
  EXPECT_NE(errorOf(other, mask).find("spacings"), std::string::npos);
  other = mask;
  other.Grid.Direction = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NE(errorOf(other, mask).find("direction matrices"), std::string::npos);
  other = mask;
  other.Grid.Spacing.z() = 1.0000001;
  EXPECT_EQ(errorOf(other, mask), "");
}
