/**
 * Faces as sets of vertices, whose convex hulls contain the triangles of every cut.
 */
#ifndef FlipFreeFaceParts_h
#define FlipFreeFaceParts_h

#include "KernelTypes.h"

#include <algorithm>
#include <array>
#include <vector>

namespace FlipFree
{

/// The convex hull of up to four vertices. If there are fewer, the last one is repeated.
using Hull = std::array<int, 4>;

/// A face of more corners has too many cuts.
constexpr int MaximumCorners = 8;

/// Some corners of a face, without memory of their own: there are many.
class CornerSet
{
public:
  void Add(int vertex) { this->Vertices[this->Size++] = vertex; }
  void Resize(int size) { this->Size = size; }
  const int* begin() const { return this->Vertices.data(); }
  const int* end() const { return this->Vertices.data() + this->Size; }
  int size() const { return this->Size; }
  int operator[](int i) const { return this->Vertices[i]; }
  bool Contains(int vertex) const
  {
    return std::find(this->begin(), this->end(), vertex) != this->end();
  }
  bool Contains(const CornerSet& other) const
  {
    return std::all_of(other.begin(), other.end(),
      [this](int vertex) { return this->Contains(vertex); });
  }
  bool Meets(const CornerSet& other) const
  {
    return std::any_of(other.begin(), other.end(),
      [this](int vertex) { return this->Contains(vertex); });
  }

private:
  std::array<int, MaximumCorners> Vertices{};
  int Size = 0;
};

/// The faces, or, for one of too many corners, the triangles of its fan, as Triangulate makes it.
struct FaceParts
{
  explicit FaceParts(const FaceList& faces);

  std::vector<CornerSet> Corners;
  std::vector<int> Faces; ///< of each part

  /// Whether two corners of a part are neighbors in its face, not only in the fan.
  bool AreNeighbors(int part, int one, int two) const;

private:
  std::vector<unsigned char>
    Sides; // per part, bit i: from corner i to the next is a side of the face
};

/// Calls append(hull) with hulls of four vertices that together are the hull of the set: every
/// point of it lies in a tetrahedron with the first vertex (Caratheodory).
template <typename Append>
void Cover(const CornerSet& vertices, const Append& append)
{
  const int size = vertices.size();
  if (size <= 4)
  {
    const auto at = [&](int i) { return vertices[std::max(0, std::min(i, size - 1))]; };
    append(Hull{ { at(0), at(1), at(2), at(3) } });
    return;
  }
  for (int i = 1; i < size; ++i)
  {
    for (int j = i + 1; j < size; ++j)
    {
      for (int k = j + 1; k < size; ++k)
      {
        append(Hull{ { vertices[0], vertices[i], vertices[j], vertices[k] } });
      }
    }
  }
}

} // namespace FlipFree

#endif
