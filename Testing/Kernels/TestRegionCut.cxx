// Proposals and margins against the costs of all cuts; the parts that a cut severs, on phantoms.
#include "Evidence/CorrectionCut.h"
#include "Evidence/RegionCut.h"
#include "Evidence/SeveredParts.h"
#include "ExampleVolumes.h"
#include "Image/BallInside.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace FlipFree;

namespace
{

constexpr std::array<int, 3> SmallSize{ { 3, 2, 2 } };
constexpr double UnitOfSmall = 0.5;

BlockNodes AllNodes(const ImageGeometry& blocks)
{
  return { blocks.NumberOfVoxels(), [](std::size_t) { return true; } };
}

// Twelve blocks, some nearer to the source, some to the sink.
CutNetwork SmallNetwork(std::mt19937& random)
{
  const ImageGeometry blocks = Grid(SmallSize, { 1, 1, 1 });
  std::uniform_int_distribution<std::int32_t> capacity(0, 40);
  std::uniform_int_distribution<std::int32_t> terminal(-60, 60);
  CutNetwork network(blocks.NumberOfVoxels());
  ForEachVoxel(blocks,
    [&](int i, int j, int k)
    {
      CutNode& node = network[blocks.Offset(i, j, k)];
      node.Terminal = terminal(random);
      for (int axis = 0; axis < 3; ++axis)
      {
        std::array<int, 3> next{ { i, j, k } };
        if (++next[axis] < blocks.Dimensions[axis])
        {
          const std::size_t other = blocks.Offset(next[0], next[1], next[2]);
          node.Neighbors[2 * axis + 1] = static_cast<std::int32_t>(other);
          network[other].Neighbors[2 * axis] = static_cast<std::int32_t>(blocks.Offset(i, j, k));
          node.Capacities[2 * axis + 1] = capacity(random);
          network[other].Capacities[2 * axis] = node.Capacities[2 * axis + 1];
        }
      }
    });
  return network;
}

double CostOf(const CutNetwork& network, unsigned inside)
{
  double cost = 0;
  for (std::size_t node = 0; node < network.size(); ++node)
  {
    const bool is = (inside >> node & 1U) != 0;
    cost += is ? std::max(0, -network[node].Terminal) : std::max(0, network[node].Terminal);
    for (int way = 0; way < 6; ++way)
    {
      const int neighbor = network[node].Neighbors[way];
      if (neighbor >= 0 && is && (inside >> neighbor & 1U) == 0)
      {
        cost += network[node].Capacities[way];
      }
    }
  }
  return UnitOfSmall * cost;
}

bool AreOnSide(unsigned cut, const std::vector<std::size_t>& blocks, bool inside)
{
  return std::all_of(blocks.begin(), blocks.end(),
    [&](std::size_t block) { return ((cut >> block & 1U) != 0) == inside; });
}

// Of all cuts, with what not following the proposal costs.
double LeastCost(const CutNetwork& network, const RegionProposal& proposal, bool inside)
{
  double least = std::numeric_limits<double>::max();
  for (unsigned cut = 0; cut < 1U << network.size(); ++cut)
  {
    if (!AreOnSide(cut, proposal.Blocks, inside))
    {
      continue;
    }
    const double lost = inside == proposal.IsInside ? 0 : proposal.Weight;
    least = std::min(least, CostOf(network, cut) + lost);
  }
  return least;
}

// Two balls of one gray value that a neck joins, as blocks, cut in the middle of the neck.
struct NeckedShape
{
  ImageGeometry Geometry = Grid({ { 100, 60, 60 } }, { 1, 1, 1 });
  Shape Whole = [](const Eigen::Vector3d& point)
  {
    return (point - Eigen::Vector3d(26, 30, 30)).norm() < 20 ||
      (point - Eigen::Vector3d(74, 30, 30)).norm() < 20 ||
      (point.x() > 26 && point.x() < 74 && std::hypot(point.y() - 30, point.z() - 30) < 12);
  };
  BitMask Mask = MaskOf(this->Geometry, this->Whole);
  BlockNodes Nodes = BlockNodes(this->Geometry.NumberOfVoxels(),
    [this](std::size_t voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
      return this->Mask(index[0], index[1], index[2]);
    });
  FloatImage Image = ImageOf(this->Geometry, this->Whole, 100, 0, 1, 4);

  std::vector<SeveredPart> Sever(int at) const
  {
    std::vector<float> depth;
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        // To the shape's outside, near enough: the blurred rim is what counts.
        const Eigen::Vector3d point(i, j, k);
        const double ball = 20 -
          std::min((point - Eigen::Vector3d(26, 30, 30)).norm(),
            (point - Eigen::Vector3d(74, 30, 30)).norm());
        const double neck = 12 - std::hypot(j - 30, k - 30);
        const double deep = std::max({ 0.0, ball, i > 26 && i < 74 ? neck : 0.0 });
        depth.push_back(static_cast<float>(deep * deep));
      });
    return FindSeveredParts(this->Geometry, this->Nodes, this->Image.Voxels, depth, 12,
      [&](std::size_t voxel) { return IndexOf(voxel, this->Geometry)[0] < at; });
  }

  void AddBeyond(int first, int last, float value)
  {
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        if (i >= first && i < last)
        {
          this->Image.Voxels[this->Geometry.Offset(i, j, k)] += value;
        }
      });
  }
};

} // namespace

TEST(RegionCut, ProposalsAndMarginsAreTheCostsOfCuts)
{
  std::mt19937 random(19);
  const BlockNodes nodes = AllNodes(Grid(SmallSize, { 1, 1, 1 }));
  int followed = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    const CutNetwork network = SmallNetwork(random);
    RegionProposal proposal;
    proposal.Blocks = { static_cast<std::size_t>(trial % 12) };
    proposal.IsInside = trial % 2 == 0;
    proposal.Weight = trial % 7 * 5;
    RegionCut cut(network, UnitOfSmall, nodes);
    cut.Add(proposal);
    ASSERT_TRUE(cut.Execute(SerialFor, NeverStop));
    const bool isInside = cut.IsInside(proposal.Blocks.front());
    const double least = LeastCost(network, proposal, isInside);
    const double other = LeastCost(network, proposal, !isInside);
    EXPECT_LE(least, other) << trial;
    EXPECT_NEAR(cut.MarginOf(proposal.Blocks, SerialFor, NeverStop), other - least, 1e-9) << trial;
    followed += isInside == proposal.IsInside ? 1 : 0;
  }
  EXPECT_GT(followed, 20);
  EXPECT_LT(followed, 60); // a proposal is not an order
}

// Added, and by its contrary taken back.
TEST(RegionCut, TakesProposalsBack)
{
  std::mt19937 random(23);
  const BlockNodes nodes = AllNodes(Grid(SmallSize, { 1, 1, 1 }));
  for (int trial = 0; trial < 20; ++trial)
  {
    RegionCut cut(SmallNetwork(random), UnitOfSmall, nodes);
    ASSERT_TRUE(cut.Execute(SerialFor, NeverStop));
    RegionCut other = cut;
    const std::vector<std::size_t> blocks{ 1, 4, 7 };
    const bool isInside = trial % 2 == 0;
    other.Add({ blocks, isInside, 90 });
    other.Fix({ 2 }, !isInside);
    ASSERT_TRUE(other.Execute(SerialFor, NeverStop));
    EXPECT_EQ(other.IsInside(2), !isInside);
    other.Add({ blocks, !isInside, 90 });
    other.Fix({ 2 }, isInside);
    ASSERT_TRUE(other.Execute(SerialFor, NeverStop));
    for (std::size_t block = 0; block < 12; ++block)
    {
      EXPECT_EQ(other.IsInside(block), cut.IsInside(block)) << trial << ", " << block;
    }
  }
}

TEST(RegionCut, MarginStops)
{
  std::mt19937 random(29);
  const BlockNodes nodes = AllNodes(Grid(SmallSize, { 1, 1, 1 }));
  RegionCut cut(SmallNetwork(random), UnitOfSmall, nodes);
  ASSERT_TRUE(cut.Execute(SerialFor, NeverStop));
  EXPECT_LT(cut.MarginOf({ 0 }, SerialFor, [](double) { return false; }), 0);
}

// A leak through the body would take a minute in blocks of the usual size.
TEST(RegionGrid, HasLargerBlocksOnlyInALargeMask)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 128, 128, 64 } };
  BitMask mask(geometry);
  for (std::size_t voxel = 0; voxel < MostBlocks; ++voxel)
  {
    mask.Insert(voxel);
  }
  constexpr double radius = 10;
  const std::array<int, 3> usual = BlockGrid(geometry, RegionBlockSize(radius)).Factor;
  EXPECT_EQ(RegionGrid(mask, radius).Factor, usual);
  mask.Insert(MostBlocks);
  const BlockGrid larger = RegionGrid(mask, radius);
  EXPECT_GT(larger.VoxelsPerBlock(), 1U);
  EXPECT_LE(mask.Count(), MostBlocks * larger.VoxelsPerBlock());
  EXPECT_LE(larger.VoxelsPerBlock(), 8U);
}

// Corrections cut a part of the image.
TEST(CorrectionGrid, IsThatOfAPartWithTheWholeMask)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 170, 170, 20 } };
  BitMask mask(geometry);
  for (int k = 6; k < 13; ++k)
  {
    for (int j = 10; j < 160; ++j)
    {
      for (int i = 10; i < 160; ++i)
      {
        mask.Insert(geometry.Offset(i, j, k));
      }
    }
  }
  const SeedSphere seed{ { 80, 80, 9 }, 3 };
  ASSERT_EQ(BlockGrid(geometry, RegionBlockSize(BallInside(mask, seed).Radius)).VoxelsPerBlock(),
    1U);
  const BlockGrid whole = CorrectionGrid(mask, seed);
  EXPECT_GT(whole.VoxelsPerBlock(), 1U);
  const BitMask part = mask.Cropped({ { { 4, 4, 4 } }, { { 166, 166, 16 } } });
  ASSERT_EQ(part.Count(), mask.Count());
  EXPECT_EQ(CorrectionGrid(part, seed).Factor, whole.Factor);
}

// The blurred rim of the neck is no edge, and not darker tissue.
TEST(SeveredParts, TissueThatGoesOnShowsNothing)
{
  const NeckedShape shape;
  const std::vector<SeveredPart> parts = shape.Sever(50);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].Volume, static_cast<double>(shape.Mask.Count()) / 2, 700);
  EXPECT_NEAR(parts[0].Area, EIGEN_PI * 8.5 * 8.5, 20); // without the rim
  EXPECT_LT(std::abs(parts[0].Step), 0.5);              // of noise of 4
  EXPECT_LT(parts[0].Edge, 0.1);
  EXPECT_GT(parts[0].Samples, 500);
}

TEST(SeveredParts, AStepIsSeenThroughNoise)
{
  for (const float step : { 3.0F, -3.0F })
  {
    NeckedShape shape;
    shape.AddBeyond(50, 100, step);
    const std::vector<SeveredPart> parts = shape.Sever(50);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_NEAR(parts[0].Step, step, 0.5);
    EXPECT_LT(parts[0].Edge, 0.15);
  }
}

TEST(SeveredParts, AThinSheetIsAnEdge)
{
  NeckedShape shape;
  shape.AddBeyond(50, 51, -60);
  const std::vector<SeveredPart> parts = shape.Sever(50);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_GT(parts[0].Edge, 0.9);
  EXPECT_LT(std::abs(parts[0].Step), 0.5);
}

TEST(SeveredParts, WhatDiffersFromTheOrganIsANeighbor)
{
  const auto evidenceOf = [](float step, float sheet)
  {
    NeckedShape shape;
    shape.AddBeyond(50, 100, step);
    shape.AddBeyond(50, 51, sheet);
    return EvidenceOfNeighbor(shape.Sever(50).front());
  };
  EXPECT_LT(*evidenceOf(0, 0), 1);
  EXPECT_LT(*evidenceOf(1.5F, 0), 1); // HU: vessels make as much
  EXPECT_GT(*evidenceOf(-4, 0), 1);
  EXPECT_GT(*evidenceOf(0, -60), 1);
  SeveredPart part;
  part.Area = 100;
  EXPECT_FALSE(EvidenceOfNeighbor(part)); // no samples
  part.Samples = 1;
  part.Step = -3;
  EXPECT_LT(*EvidenceOfNeighbor(part), 1);
  part.Step = -4;
  EXPECT_GT(*EvidenceOfNeighbor(part), 1);
  part.Step = 0;
  part.Edge = 0.11;
  EXPECT_GT(*EvidenceOfNeighbor(part), 1);
}

TEST(SeveredParts, PartsAreThoseThatAreConnected)
{
  const NeckedShape shape;
  const auto parts = FindSeveredParts(shape.Geometry, shape.Nodes, shape.Image.Voxels,
    std::vector<float>(shape.Geometry.NumberOfVoxels(), 100), 12,
    [&](std::size_t voxel)
    {
      const int i = IndexOf(voxel, shape.Geometry)[0];
      return i >= 20 && i <= 80;
    });
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].Volume, parts[1].Volume, 0.1 * parts[0].Volume);
  EXPECT_TRUE(FindSeveredParts(shape.Geometry, shape.Nodes, shape.Image.Voxels,
    std::vector<float>(shape.Geometry.NumberOfVoxels(), 100), 12,
    [](std::size_t) {
      return true;
    }).empty());
}
