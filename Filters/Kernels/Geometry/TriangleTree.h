/**
 * A bounding-volume tree over the triangles of a fixed connectivity. Its structure is built once;
 * only the volumes, which belong to the caller, are refitted to each set of positions. Any volume
 * will do that can be made for a triangle and merged: boxes of positions, or of whole motions.
 */
#ifndef FlipFreeTriangleTree_h
#define FlipFreeTriangleTree_h

#include "KernelTypes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace FlipFree
{

/// An axis-aligned box; empty at first.
struct TriangleBox
{
  double Low[3] = { std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() };
  double High[3] = { -std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };

  void Add(const double* point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = point[axis] < this->Low[axis] ? point[axis] : this->Low[axis];
      this->High[axis] = point[axis] > this->High[axis] ? point[axis] : this->High[axis];
    }
  }
  void Merge(const TriangleBox& other)
  {
    this->Add(other.Low);
    this->Add(other.High);
  }
  bool Touches(const TriangleBox& other) const
  {
    return this->Low[0] <= other.High[0] && other.Low[0] <= this->High[0] &&
      this->Low[1] <= other.High[1] && other.Low[1] <= this->High[1] &&
      this->Low[2] <= other.High[2] && other.Low[2] <= this->High[2];
  }
};

class TriangleTree
{
public:
  /// Splits at the median of the triangles' centers, along the longest extent of `layout`: the
  /// positions that the mesh has at first, or any others in which neighbors lie close together.
  TriangleTree(const PointList& layout, const TriangleList& triangles);

  /// A layout for when no positions are known yet: differences of edge distances to three pairs of
  /// far vertices.
  static PointList TopologicalLayout(int numberOfPoints, const TriangleList& triangles);

  int NumberOfNodes() const { return static_cast<int>(this->Nodes.size()); }
  int NumberOfTriangles() const { return (this->NumberOfNodes() + 1) / 2; }

  /// One volume per node: makeLeaf(triangle) at the leaves, merged upwards by Volume::Merge.
  template <typename Volume, typename MakeLeaf>
  void Refit(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf,
    const ParallelFor& parallelFor = SerialFor) const;

  /// Some of the nodes: leaves, and all nodes above them.
  struct NodeSet
  {
    std::vector<char> Contains; ///< per node
    std::vector<int> Nodes;     ///< in ascending order, so that those above come first
  };
  NodeSet NodesAbove(const std::vector<int>& triangles) const;

  /// The volumes of these nodes only.
  template <typename Volume, typename MakeLeaf>
  void RefitSome(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf, const NodeSet& nodes,
    const ParallelFor& parallelFor) const;

  /// The boxes of the triangles at these positions.
  std::vector<TriangleBox> RefitBoxes(const PointList& points, const TriangleList& triangles) const;

  /// All pairs of triangles, the lesser index first, in an order that depends on the tree only, for
  /// which accept(first, second) holds; pairs of nodes for which meet(node, other) does not hold
  /// are left out with all that is below them. Both are called from several threads at once.
  template <typename Meet, typename Accept>
  std::vector<std::pair<int, int>> SelfPairs(const Meet& meet, const Accept& accept,
    const ParallelFor& parallelFor) const;

  /// Two nodes, standing for all pairs of a triangle below one and a triangle below the other.
  using NodePair = std::pair<int, int>;

  /// Pairs of nodes that together stand for every pair of triangles without a common vertex, once,
  /// and for no other. It spares a traversal the neighbors, which always meet.
  std::vector<NodePair> PairsOfStrangers(const PointList& layout,
    const TriangleList& triangles) const;

  /// Pairs of nodes by node: the others that a node is in a pair with are
  /// Others[Begin[node]] to, not including, Others[Begin[node + 1]]; the first of them after the
  /// node itself is Others[Middle[node]].
  struct NodePartners
  {
    std::vector<int> Begin;
    std::vector<int> Middle;
    std::vector<int> Others;
  };
  NodePartners PartnersOf(const std::vector<NodePair>& front) const;

  /// Calls visit(first, second) for all pairs of triangles, the lesser index first, among those
  /// that the pairs of nodes stand for; pairs of nodes for which meet(node, other) does not hold
  /// are left out with all that is below them. Both are called from several threads at once.
  template <typename Meet, typename Visit>
  void VisitPairsBelow(const NodePartners& front, const Meet& meet, const Visit& visit,
    const ParallelFor& parallelFor) const;

  /// Only the pairs of these nodes, to but not including the last, with later ones; in this thread.
  template <typename Meet, typename Visit>
  void VisitPairsBelow(const NodePartners& front, int firstNode, int lastNode, const Meet& meet,
    const Visit& visit) const;

  /// Only those of which a triangle is in the set.
  template <typename Meet, typename Visit>
  void VisitSomePairsBelow(const NodePartners& front, const NodeSet& nodes, const Meet& meet,
    const Visit& visit, const ParallelFor& parallelFor) const;

  /// Like SelfPairs, among the pairs of triangles that `front` stands for.
  template <typename Meet, typename Accept>
  std::vector<std::pair<int, int>> PairsBelow(const std::vector<NodePair>& front, const Meet& meet,
    const Accept& accept, const ParallelFor& parallelFor) const;

  /// Calls visit(triangle) at every leaf that is reached through nodes for which enter(node) holds.
  template <typename Enter, typename Visit>
  void Query(const Enter& enter, const Visit& visit) const;

  /// Calls visit(triangle) at the leaves, those of the nearer child first. It returns a bound:
  /// nodes whose distanceTo(node) is greater are left out with all that is below them.
  template <typename DistanceTo, typename Visit>
  void QueryNearestFirst(const DistanceTo& distanceTo, double bound, const Visit& visit) const;

private:
  // In depth-first order: the first child of a node follows it, a leaf has no second one.
  struct Node
  {
    int Second = -1;
    int Count = 0;
    int Triangle = -1;
  };

  bool IsFinal(const NodePair& pair) const
  {
    return this->Nodes[pair.first].Count == 1 && this->Nodes[pair.second].Count == 1;
  }

  template <typename Volume, typename MakeLeaf>
  void RefitNode(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf, int node) const;

  void Split(const PointList& centers, int* first, int* last);

  // True when some triangles below the two nodes are neighbors; then the pairs of strangers below
  // them are in the front.
  bool CollectStrangers(const NodePair& pair, const std::vector<TriangleBox>& boxes,
    const TriangleList& triangles, std::vector<NodePair>& front) const;

  // Of a pair that meets.
  template <typename Meet, typename Visit>
  void VisitPairsBelow(const NodePair& pair, const Meet& meet, const Visit& visit) const;

  // Replaces a pair of nodes by the pairs below it.
  template <typename Push>
  void Expand(const NodePair& pair, const Push& push) const;

  std::vector<Node> Nodes;
  std::vector<int> Parents; // -1 for the root
  std::vector<int> Leaves;  // per triangle
  // What is refitted in parallel, and the nodes above it.
  std::vector<int> Subtrees;
  std::vector<int> AboveSubtrees;
};

template <typename Volume, typename MakeLeaf>
void TriangleTree::RefitNode(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf, int node) const
{
  if (this->Nodes[node].Count == 1)
  {
    volumes[node] = makeLeaf(this->Nodes[node].Triangle);
  }
  else
  {
    volumes[node] = volumes[node + 1];
    volumes[node].Merge(volumes[this->Nodes[node].Second]);
  }
}

template <typename Volume, typename MakeLeaf>
void TriangleTree::Refit(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf,
  const ParallelFor& parallelFor) const
{
  volumes.resize(this->Nodes.size());
  // All that is below a node follows it without a gap.
  const std::vector<int>& roots = this->Subtrees;
  parallelFor(0, static_cast<std::ptrdiff_t>(roots.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        const int root = roots[index];
        for (int node = root + 2 * this->Nodes[root].Count - 2; node >= root; --node)
        {
          this->RefitNode(volumes, makeLeaf, node);
        }
      }
    });
  for (auto node = this->AboveSubtrees.rbegin(); node != this->AboveSubtrees.rend(); ++node)
  {
    this->RefitNode(volumes, makeLeaf, *node);
  }
}

template <typename Volume, typename MakeLeaf>
void TriangleTree::RefitSome(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf,
  const NodeSet& nodes, const ParallelFor& parallelFor) const
{
  parallelFor(0, static_cast<std::ptrdiff_t>(nodes.Nodes.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        const int node = nodes.Nodes[index];
        if (this->Nodes[node].Count == 1)
        {
          this->RefitNode(volumes, makeLeaf, node);
        }
      }
    });
  for (auto node = nodes.Nodes.rbegin(); node != nodes.Nodes.rend(); ++node)
  {
    if (this->Nodes[*node].Count > 1)
    {
      this->RefitNode(volumes, makeLeaf, *node);
    }
  }
}

template <typename Push>
void TriangleTree::Expand(const NodePair& pair, const Push& push) const
{
  const Node& one = this->Nodes[pair.first];
  const Node& two = this->Nodes[pair.second];
  if (pair.first == pair.second)
  {
    if (one.Count > 1)
    {
      push(NodePair(pair.first + 1, one.Second));
      push(NodePair(one.Second, one.Second));
      push(NodePair(pair.first + 1, pair.first + 1));
    }
  }
  else if (one.Count >= two.Count)
  {
    push(NodePair(one.Second, pair.second));
    push(NodePair(pair.first + 1, pair.second));
  }
  else
  {
    push(NodePair(pair.first, two.Second));
    push(NodePair(pair.first, pair.second + 1));
  }
}

template <typename Meet, typename Accept>
std::vector<std::pair<int, int>> TriangleTree::SelfPairs(const Meet& meet, const Accept& accept,
  const ParallelFor& parallelFor) const
{
  // Opened from the root until there is enough to share out.
  constexpr std::size_t enough = 1024;
  std::vector<NodePair> front;
  if (!this->Nodes.empty())
  {
    front.emplace_back(0, 0);
  }
  for (bool grown = true; grown && front.size() < enough;)
  {
    grown = false;
    std::vector<NodePair> next;
    for (const NodePair& pair : front)
    {
      if (this->IsFinal(pair))
      {
        next.push_back(pair);
      }
      else if (meet(pair.first, pair.second))
      {
        grown = true;
        this->Expand(pair, [&](const NodePair& child) { next.push_back(child); });
      }
    }
    front.swap(next);
  }
  return this->PairsBelow(front, meet, accept, parallelFor);
}

template <typename Meet, typename Visit>
void TriangleTree::VisitPairsBelow(const NodePair& pair, const Meet& meet, const Visit& visit) const
{
  const auto visitLeaves = [&](const NodePair& leaves)
  {
    const int one = this->Nodes[leaves.first].Triangle;
    const int two = this->Nodes[leaves.second].Triangle;
    if (one != two)
    {
      visit(std::min(one, two), std::max(one, two));
    }
  };
  if (this->IsFinal(pair))
  {
    visitLeaves(pair);
    return;
  }
  // Halving keeps the depth below 32, and each level of either node leaves at most two waiting.
  struct Waiting
  {
    int First;
    int Second;
  };
  std::array<Waiting, 160> waiting;
  int size = 0;
  waiting[size++] = { pair.first, pair.second };
  const auto push = [&](const NodePair& child)
  {
    if (meet(child.first, child.second))
    {
      waiting[size++] = { child.first, child.second };
    }
  };
  while (size > 0)
  {
    --size;
    const NodePair top(waiting[size].First, waiting[size].Second);
    if (!this->IsFinal(top))
    {
      this->Expand(top, push);
      continue;
    }
    visitLeaves(top);
  }
}

template <typename Meet, typename Visit>
void TriangleTree::VisitPairsBelow(const NodePartners& front, int firstNode, int lastNode,
  const Meet& meet, const Visit& visit) const
{
  for (int node = firstNode; node < lastNode; ++node)
  {
    for (int index = front.Middle[node]; index < front.Begin[node + 1]; ++index)
    {
      const int other = front.Others[index];
      if (meet(node, other))
      {
        this->VisitPairsBelow(NodePair(node, other), meet, visit);
      }
    }
  }
}

template <typename Meet, typename Visit>
void TriangleTree::VisitPairsBelow(const NodePartners& front, const Meet& meet, const Visit& visit,
  const ParallelFor& parallelFor) const
{
  parallelFor(0, this->NumberOfNodes(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last) {
      this->VisitPairsBelow(front, static_cast<int>(first), static_cast<int>(last), meet, visit);
    });
}

template <typename Meet, typename Visit>
void TriangleTree::VisitSomePairsBelow(const NodePartners& front, const NodeSet& nodes,
  const Meet& meet, const Visit& visit, const ParallelFor& parallelFor) const
{
  const auto meetInSet = [&](int node, int other)
  { return (nodes.Contains[node] || nodes.Contains[other]) && meet(node, other); };
  parallelFor(0, static_cast<std::ptrdiff_t>(nodes.Nodes.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t item = first; item < last; ++item)
      {
        const int node = nodes.Nodes[item];
        for (int index = front.Begin[node]; index < front.Begin[node + 1]; ++index)
        {
          const int other = front.Others[index];
          // Of two nodes in the set, the first has seen to it.
          if ((other > node || !nodes.Contains[other]) && meet(node, other))
          {
            this->VisitPairsBelow(NodePair(node, other), meetInSet, visit);
          }
        }
      }
    });
}

template <typename Meet, typename Accept>
std::vector<std::pair<int, int>> TriangleTree::PairsBelow(const std::vector<NodePair>& front,
  const Meet& meet, const Accept& accept, const ParallelFor& parallelFor) const
{
  // The front is cut into a fixed number of parts, whose results are put together in their order:
  // the same list for any number of threads.
  constexpr std::ptrdiff_t parts = 256;
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(front.size());
  std::vector<std::vector<std::pair<int, int>>> found(parts);
  parallelFor(0, parts,
    [&](std::ptrdiff_t firstPart, std::ptrdiff_t lastPart)
    {
      for (std::ptrdiff_t part = firstPart; part < lastPart; ++part)
      {
        const auto add = [&](int one, int two)
        {
          if (accept(one, two))
          {
            found[part].emplace_back(one, two);
          }
        };
        const std::ptrdiff_t last = size * (part + 1) / parts;
        for (std::ptrdiff_t index = size * part / parts; index < last; ++index)
        {
          if (meet(front[index].first, front[index].second))
          {
            this->VisitPairsBelow(front[index], meet, add);
          }
        }
      }
    });

  std::vector<std::pair<int, int>> pairs;
  for (const auto& part : found)
  {
    pairs.insert(pairs.end(), part.begin(), part.end());
  }
  return pairs;
}

template <typename Enter, typename Visit>
void TriangleTree::Query(const Enter& enter, const Visit& visit) const
{
  std::vector<int> stack;
  if (!this->Nodes.empty())
  {
    stack.push_back(0);
  }
  while (!stack.empty())
  {
    const int node = stack.back();
    stack.pop_back();
    if (!enter(node))
    {
      continue;
    }
    if (this->Nodes[node].Count == 1)
    {
      visit(this->Nodes[node].Triangle);
      continue;
    }
    stack.push_back(this->Nodes[node].Second);
    stack.push_back(node + 1);
  }
}

template <typename DistanceTo, typename Visit>
void TriangleTree::QueryNearestFirst(const DistanceTo& distanceTo, double bound,
  const Visit& visit) const
{
  // Halving keeps the depth below 32, and each level leaves at most one node waiting.
  std::array<std::pair<double, int>, 64> waiting;
  int size = 0;
  if (!this->Nodes.empty())
  {
    waiting[size++] = { distanceTo(0), 0 };
  }
  while (size > 0)
  {
    const auto [distance, node] = waiting[--size];
    if (distance > bound)
    {
      continue;
    }
    if (this->Nodes[node].Count == 1)
    {
      bound = visit(this->Nodes[node].Triangle);
      continue;
    }
    std::pair<double, int> near{ distanceTo(node + 1), node + 1 };
    std::pair<double, int> far{ distanceTo(this->Nodes[node].Second), this->Nodes[node].Second };
    if (far < near)
    {
      std::swap(near, far);
    }
    waiting[size++] = far;
    waiting[size++] = near;
  }
}

} // namespace FlipFree

#endif
