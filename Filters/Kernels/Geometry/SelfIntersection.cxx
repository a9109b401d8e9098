#include "Geometry/SelfIntersection.h"

#include "Geometry/HullIntersection.h"

namespace FlipFree
{
namespace
{

bool AreMarked(const std::vector<char>& marked, const Hull& hull)
{
  return std::all_of(hull.begin(), hull.end(), [&](int vertex) { return marked[vertex] != 0; });
}

// The pairs of faces of which disjoint hulls meet that are marked.
std::vector<std::pair<int, int>> FindMeetingHulls(const PointList& points, const FaceHulls& hulls,
  const std::vector<char>& marked, const ParallelFor& parallelFor)
{
  std::vector<TriangleBox> boxes; // empty where nothing is marked
  hulls.Tree().Refit(
    boxes,
    [&](int index)
    {
      const Hull hull = hulls.HullAt(index);
      return AreMarked(marked, hull) ? BoxOf(points, hull) : TriangleBox();
    },
    parallelFor);
  std::vector<std::pair<int, int>> pairs = hulls.Tree().SelfPairs([&](int node, int other)
    { return boxes[node].Touches(boxes[other]); },
    [&](int one, int two) {
      return hulls.AreDisjoint(one, two) && HullsMeet(points, hulls.HullAt(one), hulls.HullAt(two));
    },
    parallelFor);
  for (auto& pair : pairs)
  {
    pair = std::minmax({ hulls.FaceOf(pair.first), hulls.FaceOf(pair.second) });
  }
  return pairs;
}

// The pairs of parts that meet and are marked.
std::vector<HullPair> SelectMeeting(const PointList& points, const std::vector<HullPair>& parts,
  const std::vector<char>& marked, const ParallelFor& parallelFor)
{
  return Select(
    parts,
    [&](const HullPair& pair)
    {
      return AreMarked(marked, pair.One) && AreMarked(marked, pair.Two) &&
        HullsMeet(points, pair.One, pair.Two);
    },
    parallelFor);
}

} // namespace

std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const FaceList& faces, const ParallelFor& parallelFor)
{
  return FindSelfIntersections(points, FaceHulls(points, faces), parallelFor);
}

std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const FaceHulls& hulls, const ParallelFor& parallelFor)
{
  const std::vector<char> all(points.rows(), 1);
  std::vector<std::pair<int, int>> pairs = FindMeetingHulls(points, hulls, all, parallelFor);
  const auto append = [&](const std::vector<HullPair>& parts)
  {
    for (const HullPair& pair : SelectMeeting(points, parts, all, parallelFor))
    {
      pairs.emplace_back(pair.Faces[0], pair.Faces[1]);
    }
  };
  const auto overlapping = hulls.VisitAdjacentPairs(false, append);
  pairs.insert(pairs.end(), overlapping.begin(), overlapping.end());
  if (!pairs.empty())
  {
    hulls.VisitAdjacentPairs(true, append);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::ptrdiff_t CountSelfIntersections(const PointList& points, const FaceList& faces,
  const ParallelFor& parallelFor)
{
  return static_cast<std::ptrdiff_t>(FindSelfIntersections(points, faces, parallelFor).size());
}

bool MarkedHullsMeet(const PointList& points, const FaceHulls& hulls,
  const std::vector<HullPair>& adjacent, const std::vector<char>& marked,
  const ParallelFor& parallelFor)
{
  return !FindMeetingHulls(points, hulls, marked, parallelFor).empty() ||
    !SelectMeeting(points, adjacent, marked, parallelFor).empty();
}

} // namespace FlipFree
