#include "Guard/CandidatePairs.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace FlipFree;

// Of all pairs of disjoint hulls with a changed vertex, each is visited once: at rest and with
// a gap that reaches everywhere, or else where hulls come near.
TEST(CandidatePairs, VisitsChangedPairsLikeBruteForce)
{
  std::mt19937 random(1);
  for (int n : { 1, 2, 5 })
  {
    const TestSphere sphere(n);
    const int count = sphere.Mesh.NumberOfPoints();
    const CandidatePairs candidates(count, sphere.Faces());
    const FaceHulls& hulls = candidates.Hulls();
    std::vector<MotionBox> boxes;
    for (int size : { count, 0, 1, 3, count / 2 })
    {
      std::vector<char> changed(count, 0);
      std::fill(changed.begin(), changed.begin() + size, 1);
      std::shuffle(changed.begin(), changed.end(), random);
      const auto isChanged = [&](const Hull& hull) {
        return std::any_of(hull.begin(), hull.end(),
          [&](int vertex) { return changed[vertex] != 0; });
      };
      std::set<std::set<Hull>> expected;
      for (int one = 0; one < hulls.NumberOfHulls(); ++one)
      {
        for (int two = one + 1; two < hulls.NumberOfHulls(); ++two)
        {
          if (hulls.AreDisjoint(one, two) &&
            (isChanged(hulls.HullAt(one)) || isChanged(hulls.HullAt(two))))
          {
            expected.insert({ hulls.HullAt(one), hulls.HullAt(two) });
          }
        }
      }
      std::set<std::set<Hull>> visited;
      candidates.VisitDisjointHulls(
        { sphere.Points(), sphere.Points() }, 1e3, changed, boxes,
        [&](const Hull& one, const Hull& two) {
          EXPECT_TRUE(visited.insert({ one, two }).second) << "visited twice";
        },
        SerialFor);
      EXPECT_EQ(visited, expected) << "n " << n << ", " << size << " changed";
    }
  }
}
