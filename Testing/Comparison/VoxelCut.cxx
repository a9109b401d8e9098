#include "VoxelCut.h"

#include "GridGraph.h"
#include "MaskVoxels.h"

#include "Image/VoxelOffsets.h"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace FlipFree
{
namespace
{

using Vertex = GridGraph::Vertex;

// More than all that a node's edges to its neighbors can carry.
constexpr float Certain = 1e6F;

constexpr std::size_t CallsPerBeat = 4096;

struct Stopped
{
};

// Asks the monitor now and then. How long a maximum flow takes is not known beforehand; 20
// looks at each node are common.
class Heart
{
public:
  Heart(const Monitor& monitor, std::size_t nodes)
    : Ask(monitor)
    , Expected(20.0 * static_cast<double>(nodes))
  {
  }
  void Beat()
  {
    if (++this->Calls % CallsPerBeat == 0)
    {
      const auto calls = static_cast<double>(this->Calls);
      if (!this->Ask(calls / (calls + this->Expected)))
      {
        throw Stopped();
      }
    }
  }

private:
  const Monitor& Ask;
  double Expected;
  std::size_t Calls = 0;
};

// The candidates' numbers as nodes.
std::vector<Vertex> NumberNodes(const BitMask& candidates, Vertex& count)
{
  std::vector<Vertex> nodes(candidates.GetGeometry().NumberOfVoxels(), GridGraph::None);
  count = 0;
  candidates.ForEach([&](std::size_t voxel) { nodes[voxel] = count++; });
  return nodes;
}

// False if the monitor, asked before each plane, stopped it.
bool BuildGraph(const ImageView<float>& image, const std::vector<float>& logOdds,
  const BitMask& seeds, const VoxelCutSettings& settings, const std::vector<Vertex>& nodes,
  const Monitor& monitor, GridGraph& graph)
{
  const ImageGeometry& geometry = image.Geometry;
  const auto& size = geometry.Dimensions;
  const double contrast = 1 / (2 * settings.EdgeContrast * settings.EdgeContrast);
  const auto costOf = [&](std::size_t a, std::size_t b, int axis)
  {
    const double difference = static_cast<double>(image.Data[a]) - image.Data[b];
    return static_cast<float>(
      settings.Smoothness / geometry.Spacing[axis] * std::exp(-contrast * difference * difference));
  };
  std::vector<float> preferences(graph.NumberOfNodes(), 0);
  const std::array<std::ptrdiff_t, 3> steps = StepsOf(geometry);
  for (int k = 0; k < size[2]; ++k)
  {
    if (!monitor(0))
    {
      return false;
    }
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        const std::size_t voxel = geometry.Offset(i, j, k);
        const Vertex node = nodes[voxel];
        if (node != GridGraph::None)
        {
          preferences[node] += seeds(i, j, k) ? Certain : logOdds[voxel];
        }
        const std::array<bool, 3> hasNext{ { i + 1 < size[0], j + 1 < size[1], k + 1 < size[2] } };
        for (int axis = 0; axis < 3; ++axis)
        {
          if (!hasNext[axis])
          {
            continue;
          }
          const std::size_t next = voxel + steps[axis];
          const Vertex other = nodes[next];
          if (node == GridGraph::None && other == GridGraph::None)
          {
            continue;
          }
          const float cost = costOf(voxel, next, axis);
          if (node != GridGraph::None && other != GridGraph::None)
          {
            graph.Join(node, other, 2 * axis, cost);
          }
          else // the one that is not a candidate is background
          {
            preferences[node != GridGraph::None ? node : other] -= cost;
          }
        }
      }
    }
  }
  for (Vertex node = 0; node < graph.NumberOfNodes(); ++node)
  {
    graph.Hang(node, preferences[node]);
  }
  return true;
}

} // namespace

bool FindVoxelCut(const ImageView<float>& image, const std::vector<float>& logOdds,
  const BitMask& candidates, const BitMask& seeds, const VoxelCutSettings& settings,
  const Monitor& monitor, BitMask& organ)
{
  Vertex count = 0;
  std::vector<Vertex> nodes = NumberNodes(candidates, count);
  Heart heart(monitor, count);
  GridGraph graph(count, [&heart]() { heart.Beat(); });
  if (!BuildGraph(image, logOdds, seeds, settings, nodes, monitor, graph))
  {
    return false;
  }
  nodes = std::vector<Vertex>();

  const std::size_t size = num_vertices(graph);
  std::vector<GridGraph::Edge> parents(size);
  std::vector<boost::default_color_type> colors(size);
  std::vector<int> distances(size);
  const boost::typed_identity_property_map<Vertex> index;
  const auto mapOf = [&index](auto& values)
  { return boost::make_iterator_property_map(values.begin(), index); };
  try
  {
    boost::boykov_kolmogorov_max_flow(graph, GridCapacityMap{ &graph }, GridCapacityMap{ &graph },
      GridReverseMap{ &graph }, mapOf(parents), mapOf(colors), mapOf(distances), index,
      graph.Source(), graph.Sink());
  }
  catch (const Stopped&)
  {
    return false;
  }
  organ = BitMask(image.Geometry);
  Vertex node = 0;
  candidates.ForEach(
    [&](std::size_t voxel)
    {
      if (colors[node++] == boost::black_color) // what the source's tree has reached
      {
        InsertVoxel(organ, voxel);
      }
    });
  return true;
}

} // namespace FlipFree
