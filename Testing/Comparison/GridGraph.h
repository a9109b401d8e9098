/**
 * A graph as Boost.Graph requires it for maximum flows, whose nodes are voxels with up to six
 * neighbors and one terminal each. Boost's own graph types take several times the memory, since
 * they cannot know this.
 */
#ifndef FlipFreeGridGraph_h
#define FlipFreeGridGraph_h

#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace FlipFree
{

/// Node n has eight slots for edges: 0 to 5 lead to its neighbors, opposite ones side by side; 6
/// leads to its terminal, and 7 is the edge back, which is the terminal's.
class GridGraph
{
public:
  using Vertex = std::uint32_t;
  static constexpr Vertex None = std::numeric_limits<Vertex>::max();
  static constexpr std::uint64_t Slots = 8;
  static constexpr std::uint64_t ToTerminal = 6;
  static constexpr std::uint64_t FromTerminal = 7;

  struct Edge
  {
    std::uint64_t Slot = 0; ///< counted through all nodes
    friend bool operator==(Edge a, Edge b) { return a.Slot == b.Slot; }
    friend bool operator!=(Edge a, Edge b) { return a.Slot != b.Slot; }
  };

  /// All nodes are connected to the sink, no edge has a capacity. `beat` is called now and then; it
  /// may throw.
  GridGraph(Vertex nodes, std::function<void()> beat)
    : Neighbors(nodes, { { None, None, None, None, None, None } })
    , Capacities(nodes * Slots, 0)
    , HangsOnSource(nodes, false)
    , Beat(std::move(beat))
  {
  }

  Vertex NumberOfNodes() const { return static_cast<Vertex>(this->Neighbors.size()); }
  Vertex Source() const { return this->NumberOfNodes(); }
  Vertex Sink() const { return this->NumberOfNodes() + 1; }

  /// Joins two nodes, both ways; `slot` is 0, 2 or 4.
  void Join(Vertex a, Vertex b, int slot, float capacity)
  {
    this->Neighbors[a][slot] = b;
    this->Neighbors[b][slot + 1] = a;
    this->Capacities[a * Slots + slot] = capacity;
    this->Capacities[b * Slots + slot + 1] = capacity;
  }
  /// Connects a node to the source by a positive preference, to the sink by a negative one.
  void Hang(Vertex node, float preference)
  {
    this->HangsOnSource[node] = preference > 0;
    this->Capacities[node * Slots + FromTerminal] = preference > 0 ? preference : 0;
    this->Capacities[node * Slots + ToTerminal] = preference > 0 ? 0 : -preference;
  }

  Vertex TerminalOf(Vertex node) const
  {
    return this->HangsOnSource[node] ? this->Source() : this->Sink();
  }
  Vertex SourceOf(Edge edge) const
  {
    const auto node = static_cast<Vertex>(edge.Slot / Slots);
    return edge.Slot % Slots == FromTerminal ? this->TerminalOf(node) : node;
  }
  Vertex TargetOf(Edge edge) const
  {
    const auto node = static_cast<Vertex>(edge.Slot / Slots);
    const std::uint64_t slot = edge.Slot % Slots;
    return slot < ToTerminal ? this->Neighbors[node][slot]
                             : (slot == ToTerminal ? this->TerminalOf(node) : node);
  }
  Edge ReverseOf(Edge edge) const
  {
    const std::uint64_t slot = edge.Slot % Slots;
    return slot < ToTerminal
      ? Edge{ this->Neighbors[edge.Slot / Slots][slot] * Slots + (slot ^ 1U) }
      : Edge{ edge.Slot ^ 1U };
  }
  bool Exists(Edge edge) const
  {
    const std::uint64_t slot = edge.Slot % Slots;
    return slot >= ToTerminal || this->Neighbors[edge.Slot / Slots][slot] != None;
  }
  float& Capacity(Edge edge) { return this->Capacities[edge.Slot]; }
  void KeepBeating() const { this->Beat(); }

  /// Every `Step`-th slot up to an end, those without an edge, or of another vertex, left out.
  class EdgeIterator
    : public boost::iterator_facade<EdgeIterator, Edge, boost::forward_traversal_tag, Edge>
  {
  public:
    EdgeIterator() = default;
    EdgeIterator(const GridGraph* graph, Vertex of, std::uint64_t slot, std::uint64_t end,
      std::uint64_t step)
      : Graph(graph)
      , Of(of)
      , Slot(slot)
      , End(end)
      , Step(step)
    {
      this->SkipOthers();
    }

  private:
    friend class boost::iterator_core_access;
    void increment()
    {
      this->Slot += this->Step;
      this->SkipOthers();
    }
    bool equal(const EdgeIterator& other) const { return this->Slot == other.Slot; }
    Edge dereference() const { return { this->Slot }; }
    void SkipOthers()
    {
      while (this->Slot < this->End &&
        !(this->Graph->Exists({ this->Slot }) &&
          (this->Of == None || this->Graph->SourceOf({ this->Slot }) == this->Of)))
      {
        this->Slot += this->Step;
      }
    }

    const GridGraph* Graph = nullptr;
    Vertex Of = None; ///< None: of all
    std::uint64_t Slot = 0;
    std::uint64_t End = 0;
    std::uint64_t Step = 1;
  };

  std::pair<EdgeIterator, EdgeIterator> OutEdges(Vertex vertex) const
  {
    const std::uint64_t all = this->NumberOfNodes() * Slots;
    return vertex < this->NumberOfNodes()
      ? this->Range(None, vertex * Slots, vertex * Slots + FromTerminal, 1)
      : this->Range(vertex, FromTerminal, all + FromTerminal, Slots);
  }
  std::pair<EdgeIterator, EdgeIterator> AllEdges() const
  {
    return this->Range(None, 0, this->NumberOfNodes() * Slots, 1);
  }

private:
  std::pair<EdgeIterator, EdgeIterator> Range(Vertex of, std::uint64_t begin, std::uint64_t end,
    std::uint64_t step) const
  {
    return { EdgeIterator(this, of, begin, end, step), EdgeIterator(this, of, end, end, step) };
  }

  std::vector<std::array<Vertex, 6>> Neighbors;
  std::vector<float> Capacities;
  std::vector<bool> HangsOnSource;
  std::function<void()> Beat;
};

// What Boost.Graph finds by the names it knows.

inline std::pair<boost::counting_iterator<GridGraph::Vertex>,
  boost::counting_iterator<GridGraph::Vertex>>
vertices(const GridGraph& graph)
{
  return { boost::counting_iterator<GridGraph::Vertex>(0),
    boost::counting_iterator<GridGraph::Vertex>(graph.NumberOfNodes() + 2) };
}
inline std::size_t num_vertices(const GridGraph& graph)
{
  return graph.NumberOfNodes() + 2UL;
}
inline std::pair<GridGraph::EdgeIterator, GridGraph::EdgeIterator> edges(const GridGraph& graph)
{
  return graph.AllEdges();
}
inline std::size_t num_edges(const GridGraph& graph)
{
  const auto all = graph.AllEdges();
  return static_cast<std::size_t>(std::distance(all.first, all.second));
}
inline std::pair<GridGraph::EdgeIterator, GridGraph::EdgeIterator> out_edges(
  GridGraph::Vertex vertex, const GridGraph& graph)
{
  graph.KeepBeating();
  return graph.OutEdges(vertex);
}
inline std::size_t out_degree(GridGraph::Vertex vertex, const GridGraph& graph)
{
  const auto all = graph.OutEdges(vertex);
  return static_cast<std::size_t>(std::distance(all.first, all.second));
}
inline GridGraph::Vertex source(GridGraph::Edge edge, const GridGraph& graph)
{
  return graph.SourceOf(edge);
}
inline GridGraph::Vertex target(GridGraph::Edge edge, const GridGraph& graph)
{
  return graph.TargetOf(edge);
}

/// The capacities, which the maximum flow turns into what is left of them.
struct GridCapacityMap
{
  using key_type = GridGraph::Edge;
  using value_type = float;
  using reference = float;
  using category = boost::read_write_property_map_tag;
  GridGraph* Graph = nullptr;
};
inline float get(const GridCapacityMap& map, GridGraph::Edge edge)
{
  return map.Graph->Capacity(edge);
}
inline void put(const GridCapacityMap& map, GridGraph::Edge edge, float value)
{
  map.Graph->Capacity(edge) = value;
}

struct GridReverseMap
{
  using key_type = GridGraph::Edge;
  using value_type = GridGraph::Edge;
  using reference = GridGraph::Edge;
  using category = boost::readable_property_map_tag;
  const GridGraph* Graph = nullptr;
};
inline GridGraph::Edge get(const GridReverseMap& map, GridGraph::Edge edge)
{
  return map.Graph->ReverseOf(edge);
}

} // namespace FlipFree

namespace boost
{

template <>
struct graph_traits<FlipFree::GridGraph>
{
  using vertex_descriptor = FlipFree::GridGraph::Vertex;
  using edge_descriptor = FlipFree::GridGraph::Edge;
  using vertex_iterator = counting_iterator<FlipFree::GridGraph::Vertex>;
  using edge_iterator = FlipFree::GridGraph::EdgeIterator;
  using out_edge_iterator = FlipFree::GridGraph::EdgeIterator;
  using adjacency_iterator = void;
  using in_edge_iterator = void;
  using directed_category = directed_tag;
  using edge_parallel_category = disallow_parallel_edge_tag;
  struct traversal_category
    : public virtual vertex_list_graph_tag
    , public virtual edge_list_graph_tag
    , public virtual incidence_graph_tag
  {
  };
  using vertices_size_type = std::size_t;
  using edges_size_type = std::size_t;
  using degree_size_type = std::size_t;
  static vertex_descriptor null_vertex() { return FlipFree::GridGraph::None; }
};

} // namespace boost

#endif
