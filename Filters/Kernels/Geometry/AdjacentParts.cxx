#include "Geometry/AdjacentParts.h"

#include <numeric>

namespace FlipFree
{
namespace
{

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

class PairLister
{
public:
  PairLister(const FaceParts& parts, int numberOfPoints, bool covered)
    : Parts(parts)
    , Corners(parts.Corners)
    , Faces(parts.Faces)
    , AreCoveredWanted(covered)
    , FirstOfStar(numberOfPoints + 1, 0)
  {
    for (const CornerSet& corners : this->Corners)
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

  std::vector<std::pair<int, int>> Run(const HullPairVisitor& visit)
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
  int RarestOf(const CornerSet& vertices) const
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
  bool LieInParts(const CornerSet& one, const CornerSet& two, const Accept& accept) const
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

  void Append(const CornerSet& one, const CornerSet& two, int partOfOne, int partOfTwo)
  {
    const std::array<int, 2> faces{ { this->Faces[partOfOne], this->Faces[partOfTwo] } };
    Cover(one,
      [&](const Hull& first) {
        Cover(two, [&](const Hull& second) { this->Pairs.push_back({ first, second, faces }); });
      });
  }

  // Whether two corners that both faces have are neighbors in one of them at most.
  bool ShareDiagonal(int part, int other, const CornerSet& common) const
  {
    return common.size() == 2 && this->Faces[part] != this->Faces[other] &&
      !(this->Parts.AreNeighbors(part, common[0], common[1]) &&
        this->Parts.AreNeighbors(other, common[0], common[1]));
  }

  // (b)
  void ListAdjacent(int part, int other)
  {
    CornerSet common;
    CornerSet one;
    for (int vertex : this->Corners[part])
    {
      (this->Corners[other].Contains(vertex) ? common : one).Add(vertex);
    }
    if (common.size() > 2 || this->ShareDiagonal(part, other, common))
    {
      this->Overlapping.emplace_back(this->Faces[part], this->Faces[other]);
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
      CornerSet two;
      for (int vertex : this->Corners[other])
      {
        if (!one.Contains(vertex))
        {
          two.Add(vertex);
        }
      }
      if (one.size() > 0 && two.size() > 0)
      {
        // Three corners lie in one face only, apart from overlapping faces. If both sets have
        // three, they lie in these two parts alone, which are adjacent.
        const bool isCovered =
          (one.size() < 3 || two.size() < 3) && this->LieInParts(one, two, areDisjoint);
        if (isCovered == this->AreCoveredWanted)
        {
          this->Append(one, two, part, other);
        }
      }
    }
  }

  // (c). What lies in two different parts, `one` in F and `two` in G, is covered by these. Proof:
  // if F and G have no common vertex, it lies in a pair (a). Otherwise let S be their common
  // vertices, at most two (others overlap and are reported), and P those of them in `one`: F
  // without S but with P contains `one`, and G without P contains `two`, which has no vertex in
  // common with `one`. That is a pair (b), which is tested unless a pair (a) covers it.
  void ListOwn(int part)
  {
    const CornerSet& corners = this->Corners[part];
    for (const auto& pair : OwnPairsOf(corners.size()))
    {
      CornerSet one;
      CornerSet two;
      for (int corner = 0; corner < corners.size(); ++corner)
      {
        if (IsIn(pair.first | pair.second, corner))
        {
          (IsIn(pair.first, corner) ? one : two).Add(corners[corner]);
        }
      }
      const bool isCovered =
        this->LieInParts(one, two, [](int first, int second) { return first != second; });
      if (isCovered == this->AreCoveredWanted)
      {
        this->Append(one, two, part, part);
      }
    }
  }

  const FaceParts& Parts;
  const std::vector<CornerSet>& Corners;
  const std::vector<int>& Faces;
  const bool AreCoveredWanted;
  // The parts around a vertex are Stars[FirstOfStar[vertex]] to, not including,
  // Stars[FirstOfStar[vertex + 1]].
  std::vector<int> FirstOfStar;
  std::vector<int> Stars;
  std::vector<HullPair> Pairs;
  std::vector<std::pair<int, int>> Overlapping;
};

} // namespace

std::vector<std::pair<int, int>> VisitAdjacentParts(const FaceParts& parts, int numberOfPoints,
  bool covered, const HullPairVisitor& visit)
{
  return PairLister(parts, numberOfPoints, covered).Run(visit);
}

std::string NameOfOverlap(const std::pair<int, int>& faces)
{
  return "faces " + std::to_string(faces.first) + " and " + std::to_string(faces.second) +
    " share more than a vertex or an edge: both can be cut along the same diagonal, which would "
    "then be an edge of more than two triangles";
}

} // namespace FlipFree
