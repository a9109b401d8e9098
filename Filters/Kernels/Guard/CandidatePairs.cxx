#include "Guard/CandidatePairs.h"

#include <numeric>

namespace FlipFree
{
namespace
{

// Whether a vertex below a node has changed.
struct ChangeFlag
{
  char IsSet = 0;
  void Merge(const ChangeFlag& other) { this->IsSet |= other.IsSet; }
};

} // namespace

// The two kinds of pairs do not need each other: a thread for each.
CandidatePairs::CandidatePairs(int numberOfPoints, const FaceList& faces,
  const ParallelFor& parallelFor)
{
  parallelFor(0, 2,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      if (first == 0)
      {
        this->ListDisjoint(TriangleTree::TopologicalLayout(numberOfPoints, faces), faces);
      }
      if (last == 2)
      {
        this->ListAdjacent(numberOfPoints, faces);
      }
    });
}

void CandidatePairs::ListAdjacent(int numberOfPoints, const FaceList& faces)
{
  this->Overlapping = VisitAdjacentParts(FaceParts(faces), numberOfPoints, false,
    [this](const std::vector<HullPair>& pairs)
    { this->Adjacent.insert(this->Adjacent.end(), pairs.begin(), pairs.end()); });
}

void CandidatePairs::ListDisjoint(const PointList& layout, const FaceList& faces)
{
  this->HullsOfFaces = FaceHulls(layout, faces);
  const auto pairs = this->HullsOfFaces.DisjointPairs(layout);
  this->FirstPartner.assign(this->HullsOfFaces.Tree().NumberOfNodes() + 1, 0);
  for (const auto& pair : pairs)
  {
    ++this->FirstPartner[pair.first + 1];
    ++this->FirstPartner[pair.second + 1];
  }
  std::partial_sum(this->FirstPartner.begin(), this->FirstPartner.end(),
    this->FirstPartner.begin());
  this->Partners.resize(this->FirstPartner.back());
  std::vector<int> next = this->FirstPartner;
  for (const auto& pair : pairs)
  {
    this->Partners[next[pair.first]++] = pair.second;
    this->Partners[next[pair.second]++] = pair.first;
  }
}

void CandidatePairs::VisitDisjointHulls(const Motion& motion, double gap,
  const std::vector<char>& changed, std::vector<MotionBox>& boxes,
  const std::function<void(const Hull& one, const Hull& two)>& visit,
  const ParallelFor& parallelFor) const
{
  const FaceHulls& hulls = this->HullsOfFaces;
  const TriangleTree& tree = hulls.Tree();
  std::vector<ChangeFlag> flags;
  tree.Refit(flags,
    [&](int hull)
    {
      const Hull v = hulls.HullAt(hull);
      return ChangeFlag{ static_cast<char>(
        changed[v[0]] | changed[v[1]] | changed[v[2]] | changed[v[3]]) };
    });
  tree.Refit(
    boxes, [&](int hull) { return MotionBox(motion, hulls.HullAt(hull), gap / 2); }, parallelFor,
    [&](int node) { return flags[node].IsSet != 0; });
  const auto meet = [&](int node, int other)
  {
    return (flags[node].IsSet | flags[other].IsSet) != 0 &&
      !boxes[node].StaysApartFrom(boxes[other]);
  };
  const auto visitHulls = [&](int one, int two) { visit(hulls.HullAt(one), hulls.HullAt(two)); };
  parallelFor(0, tree.NumberOfNodes(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int node = static_cast<int>(first); node < last; ++node)
      {
        if (!flags[node].IsSet)
        {
          continue;
        }
        for (int index = this->FirstPartner[node]; index < this->FirstPartner[node + 1]; ++index)
        {
          // A pair of which both nodes have changed is left to the first one.
          const int other = this->Partners[index];
          if ((node < other || !flags[other].IsSet) && !boxes[node].StaysApartFrom(boxes[other]))
          {
            tree.VisitPairsBelow({ node, other }, meet, visitHulls);
          }
        }
      }
    });
}

} // namespace FlipFree
