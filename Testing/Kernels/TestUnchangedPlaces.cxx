// Where constraints have changed nothing, the surface without them stays.
#include "Deformation/UnchangedPlaces.h"
#include "Geometry/WindingNumber.h"

#include <gtest/gtest.h>

#include <random>

using namespace FlipFree;

namespace
{

ImageGeometry PlacesGrid()
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 80, 60, 50 } };
  geometry.Spacing = { 1, 1, 2 };
  return geometry;
}

BitMask Block(const VoxelBox& box)
{
  BitMask mask(PlacesGrid());
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      mask.InsertRun(box.Begin[0], box.End[0], j, k);
    }
  }
  return mask;
}

} // namespace

TEST(UnchangedPlaces, WeighByTheDistanceFromChangesAndConstraints)
{
  const UnchangedPlaces places(Block({ { { 10, 10, 10 } }, { { 20, 12, 12 } } }),
    { { ConstraintKind::Boundary, { 60, 40, 20 }, 0 },
      { ConstraintKind::Seed, { 60, 5, 80 }, 4 } });
  PointList points(7, 3);
  points << 15, 11, 21, // in the change
    24, 11, 21,         // 5 mm from it
    29, 11, 21,         // 10 mm
    36, 11, 21,         // 17 mm
    60, 44, 20,         // 4 mm from a point
    60, 14, 80,         // 5 mm from a seed
    79, 59, 98;         // far
  const Eigen::VectorXd weights = places.WeightsOf(points, SerialFor);
  EXPECT_EQ(weights[0], 0);
  EXPECT_EQ(weights[1], 0);
  EXPECT_GT(weights[2], 0.1);
  EXPECT_LT(weights[2], 0.9);
  EXPECT_EQ(weights[3], 1);
  EXPECT_EQ(weights[4], 0);
  EXPECT_EQ(weights[5], 0);
  EXPECT_EQ(weights[6], 1);
}

// A layer of 4 mm, and a finger of 20 mm: only the latter reaches far away from what stays.
TEST(UnchangedPlaces, TellDeepPartsFromLayers)
{
  const BitMask before = Block({ { { 10, 10, 10 } }, { { 40, 40, 30 } } });
  BitMask after = before;
  const BitMask finger = Block({ { { 40, 20, 15 } }, { { 60, 26, 18 } } });
  const BitMask layer = Block({ { { 10, 36, 10 } }, { { 40, 40, 30 } } });
  after.Unite(finger);
  after.Remove(layer);
  BitMask deep;
  ASSERT_TRUE(FindDeepChange(before, after, 8, SerialFor, NeverStop, deep));
  EXPECT_EQ(deep, finger);
  ASSERT_TRUE(FindDeepChange(after, before, 8, SerialFor, NeverStop, deep));
  EXPECT_EQ(deep, finger);
  ASSERT_TRUE(FindDeepChange(before, before, 8, SerialFor, NeverStop, deep));
  EXPECT_EQ(deep.Count(), 0U);
  BitMask both = finger;
  both.Unite(layer);
  EXPECT_EQ(DifferenceOf(before, after), both);
  EXPECT_FALSE(FindDeepChange(
    before, after, 8, SerialFor, [](double) { return false; }, deep));
}

TEST(UnchangedPlaces, FindAllDeepParts)
{
  const BitMask before = Block({ { { 0, 0, 0 } }, { { 10, 60, 50 } } });
  const BitMask low = Block({ { { 10, 2, 2 } }, { { 30, 8, 4 } } });
  const BitMask high = Block({ { { 10, 41, 2 } }, { { 30, 46, 4 } } });
  BitMask after = before;
  after.Unite(low);
  after.Unite(high);
  after.Unite(Block({ { { 10, 20, 30 } }, { { 13, 30, 40 } } })); // a flat one
  BitMask deep;
  ASSERT_TRUE(FindDeepChange(before, after, 8, SerialFor, NeverStop, deep));
  BitMask all = low;
  all.Unite(high);
  EXPECT_EQ(deep, all);
}

TEST(UnchangedPlaces, AreNearestOnTheSurface)
{
  const DeformableSurface sphere = MakeStartSphere(8, { 1, 2, 3 }, 20);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-30, 30);
  PointList queries(200, 3);
  for (Eigen::Index query = 0; query < queries.rows(); ++query)
  {
    queries.row(query) << place(random), place(random), place(random);
  }
  const PointList places = ClosestPlaces(sphere.Points, sphere.Mesh.Triangles, queries, SerialFor);
  for (Eigen::Index query = 0; query < queries.rows(); ++query)
  {
    const Eigen::Vector3d at = queries.row(query).transpose();
    const SurfacePlace nearest = ClosestPlace(sphere.Points, sphere.Mesh.Triangles, at);
    EXPECT_NEAR((places.row(query).transpose() - at).norm(), (nearest.Point - at).norm(), 1e-12);
  }
}
