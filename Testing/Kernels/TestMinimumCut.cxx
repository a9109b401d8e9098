#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/MinimumCut.h"
#include "SourceSide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace FlipFree;

namespace
{

// What each node's terminals may carry, which CutNode::Terminal knows only as a difference.
struct Terminals
{
  std::vector<long> FromSource;
  std::vector<long> ToSink;

  explicit Terminals(const CutNetwork& network)
  {
    for (const CutNode& node : network)
    {
      this->FromSource.push_back(std::max(0, node.Terminal));
      this->ToSink.push_back(std::max(0, -node.Terminal));
    }
  }

  void Add(int node, std::int32_t capacity)
  {
    (capacity > 0 ? this->FromSource : this->ToSink)[node] += std::abs(capacity);
  }

  // The same network with these terminals.
  CutNetwork In(CutNetwork network) const
  {
    for (std::size_t node = 0; node < network.size(); ++node)
    {
      network[node].Terminal =
        static_cast<std::int32_t>(this->FromSource[node] - this->ToSink[node]);
    }
    return network;
  }

  // What is cut, whatever the sides.
  long InCommon() const
  {
    long common = 0;
    for (std::size_t node = 0; node < this->ToSink.size(); ++node)
    {
      common += std::min(this->FromSource[node], this->ToSink[node]);
    }
    return common;
  }
};

// Random capacities on a grid, many of them zero; terminals of either sign.
CutNetwork RandomNetwork(const ImageGeometry& geometry, int greatest, std::mt19937& random)
{
  CutNetwork network;
  std::uniform_int_distribution<std::int32_t> capacity(-greatest / 2, greatest);
  std::uniform_int_distribution<std::int32_t> terminal(-2 * greatest, 2 * greatest);
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      CutNode node;
      for (int way = 0; way < 6; ++way)
      {
        std::array<int, 3> at{ { i, j, k } };
        at[way / 2] += way % 2 == 1 ? 1 : -1;
        if (geometry.Contains(at[0], at[1], at[2]))
        {
          node.Neighbors[way] = static_cast<std::int32_t>(geometry.Offset(at[0], at[1], at[2]));
          node.Capacities[way] = std::max(0, capacity(random));
        }
      }
      node.Terminal = terminal(random);
      network.push_back(node);
    });
  return network;
}

long CostOf(const CutNetwork& network, const std::vector<unsigned char>& onSourceSide)
{
  long cost = 0;
  for (std::size_t node = 0; node < network.size(); ++node)
  {
    const std::int32_t terminal = network[node].Terminal;
    cost += onSourceSide[node] ? std::max(0, -terminal) : std::max(0, terminal);
    for (int way = 0; way < 6; ++way)
    {
      const int neighbor = network[node].Neighbors[way];
      if (neighbor >= 0 && onSourceSide[node] && !onSourceSide[neighbor])
      {
        cost += network[node].Capacities[way];
      }
    }
  }
  return cost;
}

// By trying every cut: the nodes that all of the cheapest have on the source's side.
std::vector<unsigned char> CheapestOfAll(const CutNetwork& network)
{
  const std::size_t size = network.size();
  long least = std::numeric_limits<long>::max();
  unsigned common = 0;
  for (unsigned cut = 0; cut < 1U << size; ++cut)
  {
    std::vector<unsigned char> side(size);
    for (std::size_t node = 0; node < size; ++node)
    {
      side[node] = cut >> node & 1U;
    }
    const long cost = CostOf(network, side);
    common = cost < least ? cut : (cost == least ? common & cut : common);
    least = std::min(least, cost);
  }
  std::vector<unsigned char> side(size);
  for (std::size_t node = 0; node < size; ++node)
  {
    side[node] = common >> node & 1U;
  }
  return side;
}

} // namespace

TEST(MinimumCut, IsTheCheapestOfAllCuts)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 60; ++trial)
  {
    for (const std::array<int, 3>& size :
      { std::array<int, 3>{ { 3, 2, 2 } }, std::array<int, 3>{ { 11, 1, 1 } } })
    {
      // Small capacities make many cuts equally cheap.
      CutNetwork network = RandomNetwork(Grid(size, { 1, 1, 1 }), trial % 2 ? 2 : 50, random);
      const std::vector<unsigned char> expected = CheapestOfAll(network);
      ASSERT_EQ(SourceSide(std::move(network), SerialFor, NeverStop), expected) << trial;
    }
  }
}

// Enough nodes for several parts, which are others where the nodes come in another order.
TEST(MinimumCut, IsTheSameWhateverTheParts)
{
  std::mt19937 random(7);
  for (const int greatest : { 2, 50 })
  {
    CutNetwork network = RandomNetwork(Grid({ { 52, 50, 54 } }, { 1, 1, 1 }), greatest, random);
    std::vector<std::int32_t> place(network.size());
    std::iota(place.begin(), place.end(), 0);
    std::shuffle(place.begin(), place.end(), random);
    CutNetwork shuffled(network.size());
    for (std::size_t node = 0; node < network.size(); ++node)
    {
      shuffled[place[node]] = network[node];
      for (std::int32_t& neighbor : shuffled[place[node]].Neighbors)
      {
        neighbor = neighbor < 0 ? neighbor : place[neighbor];
      }
    }
    const std::vector<unsigned char> side = SourceSide(std::move(network), SerialFor, NeverStop);
    const std::vector<unsigned char> other = SourceSide(std::move(shuffled), SerialFor, NeverStop);
    const auto count = static_cast<std::size_t>(std::count(side.begin(), side.end(), 1));
    EXPECT_GT(count, side.size() / 10);
    EXPECT_LT(count, side.size() - side.size() / 10);
    for (std::size_t node = 0; node < side.size(); ++node)
    {
      ASSERT_EQ(side[node], other[place[node]]) << node;
    }
  }
}

// Terminals change again and again; each cut is the one that is found anew.
TEST(MinimumCut, IsKept)
{
  std::mt19937 random(11);
  std::uniform_int_distribution<std::int32_t> change(-60, 60);
  for (const std::array<int, 3>& size :
    { std::array<int, 3>{ { 5, 4, 3 } }, std::array<int, 3>{ { 44, 40, 42 } } })
  {
    const CutNetwork network = RandomNetwork(Grid(size, { 1, 1, 1 }), 20, random);
    Terminals terminals(network);
    MinimumCut cut(network);
    std::uniform_int_distribution<int> place(0, cut.NumberOfNodes() - 1);
    for (int round = 0; round < 6; ++round)
    {
      ASSERT_TRUE(cut.Execute(ScatteredFor, NeverStop));
      const CutNetwork anew = terminals.In(network);
      const std::vector<unsigned char> side = SourceSide(CutNetwork(anew), SerialFor, NeverStop);
      for (int node = 0; node < cut.NumberOfNodes(); ++node)
      {
        ASSERT_EQ(cut.IsOnSourceSide(node), side[node] != 0) << round << ", " << node;
      }
      EXPECT_EQ(cut.GetCost(), CostOf(anew, side) + terminals.InCommon()) << round;
      for (int changed = 0; changed < cut.NumberOfNodes() / 8; ++changed)
      {
        const int node = place(random);
        const std::int32_t capacity = change(random);
        terminals.Add(node, capacity);
        cut.AddToTerminal(node, capacity);
      }
    }
  }
}

// One more source only adds nodes, one more sink only takes some away.
TEST(MinimumCut, IsMonotoneInItsTerminals)
{
  std::mt19937 random(13);
  for (int trial = 0; trial < 40; ++trial)
  {
    MinimumCut cut(RandomNetwork(Grid({ { 12, 10, 8 } }, { 1, 1, 1 }), 30, random));
    ASSERT_TRUE(cut.Execute(SerialFor, NeverStop));
    MinimumCut other = cut;
    const bool isSource = trial % 2 == 0;
    std::uniform_int_distribution<int> place(0, cut.NumberOfNodes() - 1);
    other.AddToTerminal(place(random), isSource ? CutNode::Infinite : -CutNode::Infinite);
    ASSERT_TRUE(other.Execute(SerialFor, NeverStop));
    for (int node = 0; node < cut.NumberOfNodes(); ++node)
    {
      const bool before = cut.IsOnSourceSide(node);
      const bool after = other.IsOnSourceSide(node);
      ASSERT_TRUE(isSource ? after || !before : before || !after) << trial << ", " << node;
    }
  }
}

TEST(MinimumCut, GoesOnAfterAStop)
{
  std::mt19937 random(17);
  const CutNetwork network = RandomNetwork(Grid({ { 52, 50, 54 } }, { 1, 1, 1 }), 50, random);
  MinimumCut cut(network);
  int questions = 0;
  EXPECT_FALSE(cut.Execute(SerialFor, [&](double) { return ++questions < 2; }));
  ASSERT_TRUE(cut.Execute(SerialFor, NeverStop));
  const std::vector<unsigned char> side = SourceSide(CutNetwork(network), SerialFor, NeverStop);
  for (int node = 0; node < cut.NumberOfNodes(); ++node)
  {
    ASSERT_EQ(cut.IsOnSourceSide(node), side[node] != 0) << node;
  }
}

TEST(MinimumCut, WithoutSourceOrSink)
{
  std::mt19937 random(5);
  const CutNetwork network = RandomNetwork(Grid({ { 4, 3, 2 } }, { 1, 1, 1 }), 9, random);
  for (const std::int32_t terminal : { 0, 7, -7 })
  {
    CutNetwork copy = network;
    for (CutNode& node : copy)
    {
      node.Terminal = terminal;
    }
    EXPECT_EQ(SourceSide(std::move(copy), SerialFor, NeverStop),
      std::vector<unsigned char>(network.size(), terminal > 0 ? 1 : 0));
  }
  EXPECT_TRUE(SourceSide({}, SerialFor, NeverStop).empty());
}

TEST(MinimumCut, Stops)
{
  std::mt19937 random(5);
  CutNetwork network = RandomNetwork(Grid({ { 4, 3, 2 } }, { 1, 1, 1 }), 9, random);
  EXPECT_TRUE(SourceSide(std::move(network), SerialFor, [](double) { return false; }).empty());
}
