/**
 * A bounding-volume tree over the elements of a fixed connectivity: triangles, or the hulls of
 * faces. Its structure is built once; the volumes belong to the caller and are refitted to each set
 * of positions. A volume is anything that can be made for an element and merged: a box of
 * positions, or one of whole motions.
 */
#ifndef FlipFreeTriangleTree_h
#define FlipFreeTriangleTree_h

#include "KernelTypes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
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
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], other.Low[axis]);
      this->High[axis] = std::max(this->High[axis], other.High[axis]);
    }
  }
  bool Touches(const TriangleBox& other) const
  {
    return this->Low[0] <= other.High[0] && other.Low[0] <= this->High[0] &&
      this->Low[1] <= other.High[1] && other.Low[1] <= this->High[1] &&
      this->Low[2] <= other.High[2] && other.Low[2] <= this->High[2];
  }
};

/// Of some rows of points.
template <typename Vertices>
TriangleBox BoxOf(const PointList& points, const Vertices& vertices)
{
  TriangleBox box;
  for (int vertex : vertices)
  {
    box.Add(points.row(vertex).data());
  }
  return box;
}

/// One row per element: the indices of its vertices. All elements have the same number; one that
/// has fewer repeats some.
using ElementList =
  Eigen::Ref<const Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

class TriangleTree
{
public:
  /// Empty.
  TriangleTree() = default;

  /// Splits at the median of the elements' centers, along the longest extent of `layout`: the
  /// positions that the mesh has at first, or any others in which neighbors lie close together.
  TriangleTree(const PointList& layout, const ElementList& elements);

  /// A layout for when no positions are known yet: differences of edge distances to three pairs of
  /// far vertices; components side by side.
  static PointList TopologicalLayout(int numberOfPoints, const FaceList& faces);

  int NumberOfNodes() const { return static_cast<int>(this->Nodes.size()); }
  int NumberOfElements() const { return (this->NumberOfNodes() + 1) / 2; }

  /// Computes one volume per node: makeLeaf(element) at the leaves, merged upwards by
  /// Volume::Merge. Nodes for which isStale(node) does not hold keep theirs.
  template <typename Volume, typename MakeLeaf, typename IsStale>
  void Refit(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf, const ParallelFor& parallelFor,
    const IsStale& isStale) const;
  template <typename Volume, typename MakeLeaf>
  void Refit(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf,
    const ParallelFor& parallelFor = SerialFor) const
  {
    this->Refit(volumes, makeLeaf, parallelFor, [](int) { return true; });
  }

  /// The boxes of all nodes at these positions.
  std::vector<TriangleBox> RefitBoxes(const PointList& points, const ElementList& elements) const;

  /// Calls visit(element) at every leaf that is reached through nodes for which enter(node) holds.
  template <typename Enter, typename Visit>
  void Query(const Enter& enter, const Visit& visit) const;

  /// The elements in the order of the leaves: consecutive ones are close together.
  std::vector<int> Order() const;

  /// Calls visit(place) at the leaves, those of the nearer child first, with the element's place
  /// in Order(). It returns a bound: nodes whose distanceTo(node) is greater are skipped with all
  /// that is below them.
  template <typename Scalar, typename DistanceTo, typename Visit>
  void QueryNearestFirst(const DistanceTo& distanceTo, Scalar bound, const Visit& visit) const;

  /// The pairs of elements for which accept(first, second) holds, the lesser index first, sorted.
  /// Pairs of nodes for which meet(node, other) does not hold are skipped with all that is below
  /// them. Both are called from several threads at once.
  template <typename Meet, typename Accept>
  std::vector<std::pair<int, int>> SelfPairs(const Meet& meet, const Accept& accept,
    const ParallelFor& parallelFor) const;

  /// Two nodes, standing for all pairs of an element below one and an element below the other.
  using NodePair = std::pair<int, int>;

  /// Pairs of nodes that together stand for every pair of disjoint elements, those without a
  /// common vertex, exactly once, and for no other pair. A traversal that starts from them does not
  /// descend to adjacent elements, whose volumes always meet. Pass the layout the tree was
  /// built with; it yields the fewest pairs.
  std::vector<NodePair> DisjointPairs(const PointList& layout, const ElementList& elements) const;

  /// Calls visit(first, second), the lesser index first, for the pairs of different elements that
  /// the two nodes stand for; meet as in SelfPairs.
  template <typename Meet, typename Visit>
  void VisitPairsBelow(const NodePair& pair, const Meet& meet, const Visit& visit) const;

private:
  // In depth-first order: the first child of a node follows it, a leaf has no second one.
  struct Node
  {
    int Second = -1;
    int Count = 0;
    int Element = -1;
  };

  void Split(const PointList& centers, int* first, int* last);

  bool IsFinal(const NodePair& pair) const
  {
    return this->Nodes[pair.first].Count == 1 && this->Nodes[pair.second].Count == 1;
  }

  // Replaces a pair of nodes by the pairs below it.
  template <typename Push>
  void Expand(const NodePair& pair, const Push& push) const;

  // Tells whether some elements below the two nodes are adjacent; if so, appends the pairs of
  // nodes that stand for the disjoint ones.
  bool CollectDisjointPairs(const NodePair& pair, const std::vector<TriangleBox>& boxes,
    const ElementList& elements, std::vector<NodePair>& disjoint) const;

  std::vector<Node> Nodes;
  // Subtrees are the unit of parallel work; every node is in one of them or above them.
  std::vector<int> Subtrees;
  std::vector<int> AboveSubtrees;
};

template <typename Volume, typename MakeLeaf, typename IsStale>
void TriangleTree::Refit(std::vector<Volume>& volumes, const MakeLeaf& makeLeaf,
  const ParallelFor& parallelFor, const IsStale& isStale) const
{
  volumes.resize(this->Nodes.size());
  const auto refit = [&](int node)
  {
    if (!isStale(node))
    {
      return;
    }
    if (this->Nodes[node].Count == 1)
    {
      volumes[node] = makeLeaf(this->Nodes[node].Element);
    }
    else
    {
      volumes[node] = volumes[node + 1];
      volumes[node].Merge(volumes[this->Nodes[node].Second]);
    }
  };
  // The nodes of a subtree are contiguous.
  const std::vector<int>& roots = this->Subtrees;
  parallelFor(0, static_cast<std::ptrdiff_t>(roots.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        const int root = roots[index];
        for (int node = root + 2 * this->Nodes[root].Count - 2; node >= root; --node)
        {
          refit(node);
        }
      }
    });
  std::for_each(this->AboveSubtrees.rbegin(), this->AboveSubtrees.rend(), refit);
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
      visit(this->Nodes[node].Element);
      continue;
    }
    stack.push_back(this->Nodes[node].Second);
    stack.push_back(node + 1);
  }
}

template <typename Scalar, typename DistanceTo, typename Visit>
void TriangleTree::QueryNearestFirst(const DistanceTo& distanceTo, Scalar bound,
  const Visit& visit) const
{
  struct Subtree
  {
    Scalar Distance;
    int Root;
    int Place; // of its first element
  };
  if (this->Nodes.empty())
  {
    return;
  }
  // Halving keeps the depth below 32, and each level leaves at most one subtree waiting.
  std::array<Subtree, 32> waiting;
  int size = 0;
  waiting[size++] = { distanceTo(0), 0, 0 };
  while (size > 0)
  {
    Subtree next = waiting[--size];
    while (next.Distance <= bound)
    {
      const Node& node = this->Nodes[next.Root];
      if (node.Count == 1)
      {
        bound = visit(next.Place);
        break;
      }
      Subtree far{ distanceTo(node.Second), node.Second, next.Place + node.Count / 2 };
      next = { distanceTo(next.Root + 1), next.Root + 1, next.Place };
      if (far.Distance < next.Distance)
      {
        std::swap(next, far);
      }
      if (far.Distance <= bound)
      {
        waiting[size++] = far;
      }
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
    push(NodePair(pair.first + 1, one.Second));
    push(NodePair(one.Second, one.Second));
    push(NodePair(pair.first + 1, pair.first + 1));
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

template <typename Meet, typename Visit>
void TriangleTree::VisitPairsBelow(const NodePair& pair, const Meet& meet, const Visit& visit) const
{
  // Halving keeps the depth below 32, and each level of either node leaves at most two waiting.
  std::array<std::array<int, 2>, 160> waiting;
  int size = 0;
  const auto push = [&](const NodePair& nodes)
  {
    if (meet(nodes.first, nodes.second))
    {
      waiting[size++] = { { nodes.first, nodes.second } };
    }
  };
  push(pair);
  while (size > 0)
  {
    --size;
    const NodePair top(waiting[size][0], waiting[size][1]);
    if (!this->IsFinal(top))
    {
      this->Expand(top, push);
    }
    else if (top.first != top.second)
    {
      const int one = this->Nodes[top.first].Element;
      const int two = this->Nodes[top.second].Element;
      visit(std::min(one, two), std::max(one, two));
    }
  }
}

template <typename Meet, typename Accept>
std::vector<std::pair<int, int>> TriangleTree::SelfPairs(const Meet& meet, const Accept& accept,
  const ParallelFor& parallelFor) const
{
  std::vector<std::pair<int, int>> pairs;
  std::mutex mutex;
  const auto collect = [&](int one, int two)
  {
    if (accept(one, two))
    {
      const std::lock_guard<std::mutex> lock(mutex);
      pairs.emplace_back(one, two);
    }
  };
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(this->Subtrees.size());
  parallelFor(0, count * count,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        if (index / count <= index % count)
        {
          this->VisitPairsBelow({ this->Subtrees[index / count], this->Subtrees[index % count] },
            meet, collect);
        }
      }
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace FlipFree

#endif
