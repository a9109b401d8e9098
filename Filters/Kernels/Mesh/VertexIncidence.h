/**
 * Vertex-to-item incidence: the triangles, or other items of three vertices, at each vertex.
 */
#ifndef FlipFreeVertexIncidence_h
#define FlipFreeVertexIncidence_h

#include <numeric>
#include <vector>

namespace FlipFree
{

class VertexIncidence
{
public:
  /// Item i has the vertices vertexOf(i, 0), vertexOf(i, 1), vertexOf(i, 2).
  template <typename VertexOf>
  VertexIncidence(int numberOfVertices, int numberOfItems, const VertexOf& vertexOf)
    : Begin(numberOfVertices + 1, 0)
    , Items(3 * static_cast<std::size_t>(numberOfItems))
  {
    for (int item = 0; item < numberOfItems; ++item)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        ++this->Begin[vertexOf(item, corner) + 1];
      }
    }
    std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
    std::vector<int> next = this->Begin;
    for (int item = 0; item < numberOfItems; ++item)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        this->Items[next[vertexOf(item, corner)]++] = item;
      }
    }
  }

  /// Calls visit(item), in ascending order.
  template <typename Visit>
  void ForEachAt(int vertex, const Visit& visit) const
  {
    for (int index = this->Begin[vertex]; index < this->Begin[vertex + 1]; ++index)
    {
      visit(this->Items[index]);
    }
  }

private:
  std::vector<int> Begin;
  std::vector<int> Items;
};

} // namespace FlipFree

#endif
