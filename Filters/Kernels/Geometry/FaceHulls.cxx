#include "Geometry/FaceHulls.h"

#include <iterator>
#include <numeric>

namespace FlipFree
{
namespace
{

constexpr int MaximumCorners = 8;

// Some corners of a face, without memory of their own: there are many.
class VertexSet
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
  bool Contains(const VertexSet& other) const
  {
    return std::all_of(other.begin(), other.end(),
      [this](int vertex) { return this->Contains(vertex); });
  }
  bool Meets(const VertexSet& other) const
  {
    return std::any_of(other.begin(), other.end(),
      [this](int vertex) { return this->Contains(vertex); });
  }

private:
  std::array<int, MaximumCorners> Vertices{};
  int Size = 0;
};

// The faces, or, for one of too many corners, the triangles of its fan.
struct Parts
{
  std::vector<VertexSet> Corners;
  std::vector<int> Faces;
};

Parts PartsOf(const FaceList& faces)
{
  Parts parts;
  const auto append = [&](int face, const auto& corners)
  {
    VertexSet part;
    std::for_each(std::begin(corners), std::end(corners), [&](int vertex) { part.Add(vertex); });
    parts.Corners.push_back(part);
    parts.Faces.push_back(face);
  };
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const corners = faces.Face(face);
    const int size = faces.FaceSize(face);
    if (size <= MaximumCorners)
    {
      append(face, std::vector<int>(corners, corners + size));
      continue;
    }
    for (int corner = 2; corner < size; ++corner)
    {
      append(face, std::array<int, 3>{ { corners[0], corners[corner - 1], corners[corner] } });
    }
  }
  return parts;
}

// Hulls of four vertices that together are the hull of the set: every point of it lies in a
// tetrahedron with the first vertex (Caratheodory).
template <typename Append>
void Cover(const VertexSet& vertices, const Append& append)
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

// Pairs of parts of one face, each part as the bits of the face's corners.
using OwnPairs = std::vector<std::pair<unsigned int, unsigned int>>;

bool IsIn(unsigned int bits, int corner)
{
  return (bits >> corner & 1U) != 0;
}

int NumberOfBits(unsigned int bits)
{
  int count = 0;
  for (; bits != 0; bits &= bits - 1)
  {
    ++count;
  }
  return count;
}

// Two parts do not cross if, around the face, all corners of one come before all of the other.
bool Cross(unsigned int one, unsigned int two, int size)
{
  std::vector<int> sides;
  for (int corner = 0; corner < size; ++corner)
  {
    if (IsIn(one | two, corner))
    {
      sides.push_back(IsIn(one, corner) ? 0 : 1);
    }
  }
  int changes = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    changes += sides[i] != sides[(i + 1) % sides.size()] ? 1 : 0;
  }
  return changes > 2;
}

OwnPairs ListOwnPairs(int size)
{
  OwnPairs pairs;
  for (unsigned int one = 1; one < 1U << size; ++one)
  {
    for (unsigned int two = 1; two < 1U << size; ++two)
    {
      const int first = NumberOfBits(one);
      const int second = NumberOfBits(two);
      const bool isListed = size == 3
        ? first == 1 && second == 2
        : (first <= 2 && second == 3) || (first == 2 && second == 2 && one < two);
      if (isListed && (one & two) == 0 && !Cross(one, two, size))
      {
        pairs.emplace_back(one, two);
      }
    }
  }
  return pairs;
}

const OwnPairs& OwnPairsOf(int size)
{
  static const std::array<OwnPairs, MaximumCorners + 1> pairsOfSize = []
  {
    std::array<OwnPairs, MaximumCorners + 1> pairs;
    for (int corners = 3; corners <= MaximumCorners; ++corners)
    {
      pairs[corners] = ListOwnPairs(corners);
    }
    return pairs;
  }();
  return pairsOfSize[size];
}

// Blocks are large enough to be worth several threads.
constexpr std::size_t BlockSize = 1 << 16;

// What to list.
enum class Wanted
{
  Uncovered,
  Covered,
  Overlapping
};

using BlockVisitor = std::function<void(const std::vector<HullPair>&)>;

class PairLister
{
public:
  PairLister(const Parts& parts, int numberOfPoints, Wanted wanted)
    : Corners(parts.Corners)
    , Faces(parts.Faces)
    , ToList(wanted)
    , FirstOfStar(numberOfPoints + 1, 0)
  {
    for (const VertexSet& corners : this->Corners)
    {
      for (int vertex : corners)
      {
        ++this->FirstOfStar[vertex + 1];
      }
    }
    std::partial_sum(this->FirstOfStar.begin(), this->FirstOfStar.end(), this->FirstOfStar.begin());
    this->Stars.resize(this->FirstOfStar.back());
    std::vector<int> next = this->FirstOfStar;
    for (int part = 0; part < static_cast<int>(this->Corners.size()); ++part)
    {
      for (int vertex : this->Corners[part])
      {
        this->Stars[next[vertex]++] = part;
      }
    }
  }

  /// Calls visit with blocks of pairs. Returns the overlapping faces, if they are wanted.
  std::vector<std::pair<int, int>> Run(const BlockVisitor& visit)
  {
    std::vector<int> neighbors;
    for (int part = 0; part < static_cast<int>(this->Corners.size()); ++part)
    {
      this->ListOwn(part);
      neighbors.clear();
      for (int vertex : this->Corners[part])
      {
        this->AnyAround(vertex,
          [&](int other)
          {
            if (other > part)
            {
              neighbors.push_back(other);
            }
            return false;
          });
      }
      std::sort(neighbors.begin(), neighbors.end());
      neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
      for (int other : neighbors)
      {
        this->ListAdjacent(part, other);
        if (this->Pairs.size() >= BlockSize)
        {
          visit(this->Pairs);
          this->Pairs.clear();
        }
      }
    }
    if (!this->Pairs.empty())
    {
      visit(this->Pairs);
    }
    return std::move(this->Overlapping);
  }

private:
  template <typename Accept>
  bool AnyAround(int vertex, const Accept& accept) const
  {
    return std::any_of(this->Stars.begin() + this->FirstOfStar[vertex],
      this->Stars.begin() + this->FirstOfStar[vertex + 1], accept);
  }

  // The vertex with the fewest parts around it.
  int RarestOf(const VertexSet& vertices) const
  {
    return *std::min_element(vertices.begin(), vertices.end(),
      [this](int one, int two)
      {
        return this->FirstOfStar[one + 1] - this->FirstOfStar[one] <
          this->FirstOfStar[two + 1] - this->FirstOfStar[two];
      });
  }

  // Whether the sets lie in two parts for which accept(part of one, part of two) holds.
  template <typename Accept>
  bool LieInParts(const VertexSet& one, const VertexSet& two, const Accept& accept) const
  {
    const int ofTwo = this->RarestOf(two);
    return this->AnyAround(this->RarestOf(one),
      [&](int first)
      {
        return this->Corners[first].Contains(one) &&
          this->AnyAround(ofTwo,
            [&](int second)
            { return this->Corners[second].Contains(two) && accept(first, second); });
      });
  }

  void Append(const VertexSet& one, const VertexSet& two, int partOfOne, int partOfTwo)
  {
    const std::array<int, 2> faces{ { this->Faces[partOfOne], this->Faces[partOfTwo] } };
    Cover(one,
      [&](const Hull& first) {
        Cover(two, [&](const Hull& second) { this->Pairs.push_back({ first, second, faces }); });
      });
  }

  // (b)
  void ListAdjacent(int part, int other)
  {
    VertexSet common;
    VertexSet one;
    for (int vertex : this->Corners[part])
    {
      (this->Corners[other].Contains(vertex) ? common : one).Add(vertex);
    }
    if (common.size() > 2)
    {
      if (this->ToList == Wanted::Overlapping)
      {
        this->Overlapping.emplace_back(this->Faces[part], this->Faces[other]);
      }
      return;
    }
    if (this->ToList == Wanted::Overlapping)
    {
      return;
    }
    const auto areDisjoint = [this](int first, int second)
    { return !this->Corners[first].Meets(this->Corners[second]); };
    const int inOneAlone = one.size();
    for (unsigned int subset = 0; subset < 1U << common.size(); ++subset)
    {
      one.Resize(inOneAlone);
      for (int i = 0; i < common.size(); ++i)
      {
        if (IsIn(subset, i))
        {
          one.Add(common[i]);
        }
      }
      VertexSet two;
      for (int vertex : this->Corners[other])
      {
        if (!one.Contains(vertex))
        {
          two.Add(vertex);
        }
      }
      if (one.size() > 0 && two.size() > 0)
      {
        // Three corners lie in one face only, apart from OverlappingFaces. If both sets have three,
        // they lie in these two parts alone, which are adjacent.
        const bool isCovered =
          (one.size() < 3 || two.size() < 3) && this->LieInParts(one, two, areDisjoint);
        if (isCovered == (this->ToList == Wanted::Covered))
        {
          this->Append(one, two, part, other);
        }
      }
    }
  }

  // (c); what lies in two different faces is covered by these.
  void ListOwn(int part)
  {
    if (this->ToList == Wanted::Overlapping)
    {
      return;
    }
    const VertexSet& corners = this->Corners[part];
    for (const auto& pair : OwnPairsOf(corners.size()))
    {
      VertexSet one;
      VertexSet two;
      for (int corner = 0; corner < corners.size(); ++corner)
      {
        if (IsIn(pair.first | pair.second, corner))
        {
          (IsIn(pair.first, corner) ? one : two).Add(corners[corner]);
        }
      }
      const bool isCovered =
        this->LieInParts(one, two, [](int first, int second) { return first != second; });
      if (isCovered == (this->ToList == Wanted::Covered))
      {
        this->Append(one, two, part, part);
      }
    }
  }

  const std::vector<VertexSet>& Corners;
  const std::vector<int>& Faces;
  const Wanted ToList;
  // The parts around a vertex are Stars[FirstOfStar[vertex]] to, not including,
  // Stars[FirstOfStar[vertex + 1]].
  std::vector<int> FirstOfStar;
  std::vector<int> Stars;
  std::vector<HullPair> Pairs;
  std::vector<std::pair<int, int>> Overlapping;
};

} // namespace

FaceHulls::FaceHulls(const PointList& layout, const FaceList& faces)
  : NumberOfPoints(static_cast<int>(layout.rows()))
  , Polygons(faces)
{
  const Parts parts = PartsOf(faces);
  std::vector<Hull> hulls;
  for (std::size_t part = 0; part < parts.Corners.size(); ++part)
  {
    Cover(parts.Corners[part],
      [&](const Hull& hull)
      {
        hulls.push_back(hull);
        this->Faces.push_back(parts.Faces[part]);
      });
  }
  this->Hulls.resize(static_cast<Eigen::Index>(hulls.size()), 4);
  for (std::size_t hull = 0; hull < hulls.size(); ++hull)
  {
    this->Hulls.row(static_cast<Eigen::Index>(hull)) =
      Eigen::Map<const Eigen::RowVector4i>(hulls[hull].data());
  }
  this->TreeOfHulls = TriangleTree(layout, this->Hulls);
}

void FaceHulls::VisitAdjacentPairs(bool covered, const BlockVisitor& visit) const
{
  const Parts parts = PartsOf(this->Polygons);
  PairLister(parts, this->NumberOfPoints, covered ? Wanted::Covered : Wanted::Uncovered).Run(visit);
}

std::vector<HullPair> FaceHulls::AdjacentPairs() const
{
  std::vector<HullPair> all;
  this->VisitAdjacentPairs(false,
    [&](const std::vector<HullPair>& pairs) { all.insert(all.end(), pairs.begin(), pairs.end()); });
  return all;
}

std::vector<std::pair<int, int>> FaceHulls::OverlappingFaces() const
{
  const Parts parts = PartsOf(this->Polygons);
  return PairLister(parts, this->NumberOfPoints, Wanted::Overlapping)
    .Run([](const std::vector<HullPair>&) {});
}

bool FaceHulls::AreDisjoint(int one, int two) const
{
  const Hull first = this->HullAt(one);
  const Hull second = this->HullAt(two);
  return std::none_of(first.begin(), first.end(),
    [&](int vertex) { return std::find(second.begin(), second.end(), vertex) != second.end(); });
}

} // namespace FlipFree
