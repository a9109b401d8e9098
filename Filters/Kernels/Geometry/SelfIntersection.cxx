#include "Geometry/SelfIntersection.h"

#include "Geometry/HullIntersection.h"

namespace FlipFree
{

std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const FaceList& faces, const ParallelFor& parallelFor)
{
  return FindSelfIntersections(points, FaceHulls(points, faces), parallelFor);
}

std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const FaceHulls& hulls, const ParallelFor& parallelFor)
{
  const std::vector<TriangleBox> boxes = hulls.RefitBoxes(points);
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
  const auto overlapping = hulls.OverlappingFaces();
  pairs.insert(pairs.end(), overlapping.begin(), overlapping.end());
  const auto append = [&](const std::vector<HullPair>& candidates)
  {
    for (const HullPair& pair :
      Select(
        candidates, [&](const HullPair& parts) { return HullsMeet(points, parts.One, parts.Two); },
        parallelFor))
    {
      pairs.emplace_back(pair.Faces[0], pair.Faces[1]);
    }
  };
  hulls.VisitAdjacentPairs(false, append);
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

} // namespace FlipFree
