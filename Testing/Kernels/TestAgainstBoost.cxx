// The minimum cut against Boost's, also by another algorithm; and how long both take.
#include "ExampleMasks.h"
#include "SourceSide.h"
#include "Stopwatch.h"

// In Boost, where the compiler cannot follow.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/edmonds_karp_max_flow.hpp>
#include <gtest/gtest.h>

#include <cstdio>

using namespace FlipFree;

namespace
{

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS,
  boost::property<boost::vertex_color_t, boost::default_color_type,
    boost::property<boost::vertex_distance_t, long,
      boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>,
  boost::property<boost::edge_capacity_t, long,
    boost::property<boost::edge_residual_capacity_t, long,
      boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;

void AddEdge(std::size_t from, std::size_t to, long forth, long back, Graph& graph)
{
  const auto edge = boost::add_edge(from, to, graph).first;
  const auto reverse = boost::add_edge(to, from, graph).first;
  boost::put(boost::edge_capacity, graph, edge, forth);
  boost::put(boost::edge_capacity, graph, reverse, back);
  boost::put(boost::edge_reverse, graph, edge, reverse);
  boost::put(boost::edge_reverse, graph, reverse, edge);
}

Graph GraphOf(const CutNetwork& network)
{
  const std::size_t size = network.size();
  Graph graph(size + 2);
  for (std::size_t node = 0; node < size; ++node)
  {
    const long terminal = network[node].Terminal;
    AddEdge(size, node, std::max(0L, terminal), 0, graph);
    AddEdge(node, size + 1, std::max(0L, -terminal), 0, graph);
    for (const int way : { 1, 3, 5 })
    {
      const int neighbor = network[node].Neighbors[way];
      if (neighbor >= 0)
      {
        AddEdge(node, neighbor, network[node].Capacities[way],
          network[neighbor].Capacities[way - 1], graph);
      }
    }
  }
  return graph;
}

// What the source still reaches.
std::vector<unsigned char> ReachedOf(const Graph& graph)
{
  const std::size_t size = boost::num_vertices(graph) - 2;
  std::vector<unsigned char> reached(size + 2, 0);
  std::vector<std::size_t> front{ size };
  reached[size] = 1;
  while (!front.empty())
  {
    const std::size_t node = front.back();
    front.pop_back();
    for (auto [edge, end] = boost::out_edges(node, graph); edge != end; ++edge)
    {
      const std::size_t to = boost::target(*edge, graph);
      if (!reached[to] && boost::get(boost::edge_residual_capacity, graph, *edge) > 0)
      {
        reached[to] = 1;
        front.push_back(to);
      }
    }
  }
  reached.resize(size);
  return reached;
}

// As where an organ is carved: like neighbors hold together, and terminals are far apart.
CutNetwork SmoothNetwork(const std::array<int, 3>& size, double terminals, std::mt19937& random)
{
  const ImageGeometry geometry = Grid(size, { 1, 1, 1 });
  CutNetwork network(geometry.NumberOfVoxels());
  std::exponential_distribution<double> edge(1);
  std::uniform_real_distribution<double> coin(0, 1);
  std::normal_distribution<double> normal(0, 3000);
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      const std::size_t node = geometry.Offset(i, j, k);
      const double chance = coin(random);
      network[node].Terminal = chance < terminals
        ? CutNode::Infinite
        : (chance < 2 * terminals ? -CutNode::Infinite : static_cast<std::int32_t>(normal(random)));
      for (int way = 0; way < 6; ++way)
      {
        std::array<int, 3> at{ { i, j, k } };
        at[way / 2] += way % 2 == 1 ? 1 : -1;
        if (geometry.Contains(at[0], at[1], at[2]))
        {
          network[node].Neighbors[way] =
            static_cast<std::int32_t>(geometry.Offset(at[0], at[1], at[2]));
          network[node].Capacities[way] =
            static_cast<std::int32_t>(10000 * std::exp(-edge(random)));
        }
      }
    });
  return network;
}

} // namespace

TEST(AgainstBoost, SameCutByShortestPaths)
{
  std::mt19937 random(8);
  for (int trial = 0; trial < 40; ++trial)
  {
    CutNetwork network = SmoothNetwork({ { 12, 9, 7 } }, trial % 2 ? 0.01 : 0, random);
    Graph graph = GraphOf(network);
    boost::edmonds_karp_max_flow(graph, network.size(), network.size() + 1);
    ASSERT_EQ(SourceSide(std::move(network), SerialFor, NeverStop), ReachedOf(graph)) << trial;
  }
}

TEST(AgainstBoost, SameCutOnALargeGrid)
{
  std::mt19937 random(9);
  CutNetwork network = SmoothNetwork({ { 48, 48, 40 } }, 0.002, random);
  Graph graph = GraphOf(network);
  Stopwatch watch;
  boost::boykov_kolmogorov_max_flow(graph, network.size(), network.size() + 1);
  const double theirs = watch.Lap();
  const std::vector<unsigned char> side = SourceSide(std::move(network), SerialFor, NeverStop);
  std::printf("%zu nodes: Boost %.3f s, ours %.3f s\n", side.size(), theirs, watch.Lap());
  EXPECT_EQ(side, ReachedOf(graph));
}
