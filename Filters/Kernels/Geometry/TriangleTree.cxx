#include "Geometry/TriangleTree.h"

#include <algorithm>
#include <numeric>

namespace FlipFree
{
namespace
{

// Enough to balance the load between threads.
constexpr int NumberOfSubtrees = 64;

using VertexGraph = std::vector<std::vector<int>>;

// Number of edges from `start`; the number of points where there is no path.
Eigen::VectorXi EdgeDistances(const VertexGraph& graph, int start)
{
  const int unreached = static_cast<int>(graph.size());
  Eigen::VectorXi distances = Eigen::VectorXi::Constant(unreached, unreached);
  std::vector<int> queue(1, start);
  distances[start] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head)
  {
    for (int neighbor : graph[queue[head]])
    {
      if (distances[neighbor] == unreached)
      {
        distances[neighbor] = distances[queue[head]] + 1;
        queue.push_back(neighbor);
      }
    }
  }
  return distances;
}

// The connected components, each with its vertices in ascending order; that of vertex 0 first.
std::vector<std::vector<int>> ComponentsOf(const VertexGraph& graph)
{
  const int count = static_cast<int>(graph.size());
  std::vector<std::vector<int>> components;
  std::vector<char> isVisited(graph.size(), 0);
  for (int start = 0; start < count; ++start)
  {
    if (isVisited[start])
    {
      continue;
    }
    std::vector<int> component(1, start);
    isVisited[start] = 1;
    for (std::size_t head = 0; head < component.size(); ++head)
    {
      for (const int neighbor : graph[component[head]])
      {
        if (!isVisited[neighbor])
        {
          isVisited[neighbor] = 1;
          component.push_back(neighbor);
        }
      }
    }
    std::sort(component.begin(), component.end());
    components.push_back(std::move(component));
  }
  return components;
}

// Sets the rows of one component's vertices.
void LayOut(const VertexGraph& graph, const std::vector<int>& component, PointList& layout)
{
  const auto count = static_cast<Eigen::Index>(component.size());
  const auto distancesFrom = [&](Eigen::Index start)
  {
    const Eigen::VectorXi all = EdgeDistances(graph, component[start]);
    Eigen::VectorXi own(count);
    for (Eigen::Index index = 0; index < count; ++index)
    {
      own[index] = all[component[index]];
    }
    return own;
  };
  PointList own = PointList::Zero(count, 3);
  for (int axis = 0; axis < 3; ++axis)
  {
    // Each pair starts in the middle of the earlier axes and ends far away, near the middle again.
    Eigen::Index one = 0;
    own.rowwise().squaredNorm().minCoeff(&one);
    const Eigen::VectorXi fromOne = distancesFrom(one);
    Eigen::Index two = 0;
    (fromOne.cast<double>() - own.rowwise().norm()).maxCoeff(&two);
    own.col(axis) = (fromOne - distancesFrom(two)).cast<double>();
  }
  for (Eigen::Index index = 0; index < count; ++index)
  {
    layout.row(component[index]) = own.row(index);
  }
}

bool ShareVertex(const ElementList& elements, int one, int two)
{
  for (Eigen::Index corner = 0; corner < elements.cols(); ++corner)
  {
    if ((elements.row(two).array() == elements(one, corner)).any())
    {
      return true;
    }
  }
  return false;
}

} // namespace

TriangleTree::TriangleTree(const PointList& layout, const ElementList& elements)
{
  const int count = static_cast<int>(elements.rows());
  if (count == 0)
  {
    return;
  }
  PointList centers(count, 3);
  for (int element = 0; element < count; ++element)
  {
    centers.row(element).setZero();
    for (Eigen::Index corner = 0; corner < elements.cols(); ++corner)
    {
      centers.row(element) += layout.row(elements(element, corner));
    }
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  this->Nodes.reserve(2 * static_cast<std::size_t>(count) - 1);
  this->Split(centers, order.data(), order.data() + count);

  const int ofSubtree = std::max(1, count / NumberOfSubtrees);
  for (int node = 0; node < this->NumberOfNodes();)
  {
    if (this->Nodes[node].Count > ofSubtree)
    {
      this->AboveSubtrees.push_back(node++);
    }
    else
    {
      this->Subtrees.push_back(node);
      node += 2 * this->Nodes[node].Count - 1;
    }
  }
}

void TriangleTree::Split(const PointList& centers, int* first, int* last)
{
  const std::size_t self = this->Nodes.size();
  this->Nodes.emplace_back();
  this->Nodes[self].Count = static_cast<int>(last - first);
  if (last - first == 1)
  {
    this->Nodes[self].Element = *first;
    return;
  }
  TriangleBox extent;
  for (const int* element = first; element != last; ++element)
  {
    extent.Add(centers.row(*element).data());
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other)
  {
    if (extent.High[other] - extent.Low[other] > extent.High[axis] - extent.Low[axis])
    {
      axis = other;
    }
  }
  int* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last,
    [&](int one, int two)
    {
      const double a = centers(one, axis);
      const double b = centers(two, axis);
      // The index decides between equals, so that every library sorts alike.
      return a < b || (a == b && one < two);
    });
  this->Split(centers, first, middle);
  this->Nodes[self].Second = this->NumberOfNodes();
  this->Split(centers, middle, last);
}

PointList TriangleTree::TopologicalLayout(int numberOfPoints, const FaceList& faces)
{
  VertexGraph graph(numberOfPoints);
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int size = faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      const int vertex = faces.Face(face)[corner];
      const int next = faces.Face(face)[(corner + 1) % size];
      graph[vertex].push_back(next);
      graph[next].push_back(vertex);
    }
  }
  PointList layout = PointList::Zero(numberOfPoints, 3);
  double end = 0;
  for (const std::vector<int>& component : ComponentsOf(graph))
  {
    LayOut(graph, component, layout);
    // Beside the one before.
    double low = 0;
    double high = 0;
    for (const int vertex : component)
    {
      low = std::min(low, layout(vertex, 0));
      high = std::max(high, layout(vertex, 0));
    }
    const double shift = component.front() == 0 ? 0 : end - low + 1;
    for (const int vertex : component)
    {
      layout(vertex, 0) += shift;
    }
    end = shift + high;
  }
  return layout;
}

std::vector<int> TriangleTree::Order() const
{
  std::vector<int> order;
  order.reserve(this->NumberOfElements());
  for (const Node& node : this->Nodes)
  {
    if (node.Count == 1)
    {
      order.push_back(node.Element);
    }
  }
  return order;
}

std::vector<TriangleTree::NodePair> TriangleTree::DisjointPairs(const PointList& layout,
  const ElementList& elements) const
{
  std::vector<NodePair> disjoint;
  if (!this->Nodes.empty())
  {
    this->CollectDisjointPairs(NodePair(0, 0), this->RefitBoxes(layout, elements), elements,
      disjoint);
  }
  return disjoint;
}

bool TriangleTree::CollectDisjointPairs(const NodePair& pair, const std::vector<TriangleBox>& boxes,
  const ElementList& elements, std::vector<NodePair>& disjoint) const
{
  if (!boxes[pair.first].Touches(boxes[pair.second]))
  {
    return false;
  }
  if (this->IsFinal(pair))
  {
    return ShareVertex(elements, this->Nodes[pair.first].Element, this->Nodes[pair.second].Element);
  }
  bool hasAdjacent = false;
  std::vector<NodePair> allDisjoint;
  this->Expand(pair,
    [&](const NodePair& child)
    {
      if (this->CollectDisjointPairs(child, boxes, elements, disjoint))
      {
        hasAdjacent = true;
      }
      else
      {
        allDisjoint.push_back(child);
      }
    });
  if (hasAdjacent)
  {
    disjoint.insert(disjoint.end(), allDisjoint.begin(), allDisjoint.end());
  }
  return hasAdjacent;
}

std::vector<TriangleBox> TriangleTree::RefitBoxes(const PointList& points,
  const ElementList& elements) const
{
  std::vector<TriangleBox> boxes;
  this->Refit(boxes,
    [&](int element)
    {
      TriangleBox box;
      for (Eigen::Index corner = 0; corner < elements.cols(); ++corner)
      {
        box.Add(points.row(elements(element, corner)).data());
      }
      return box;
    });
  return boxes;
}

} // namespace FlipFree
