#include "Geometry/TriangleTree.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace FlipFree;

namespace
{

struct Minimum
{
  int Value = 0;
  void Merge(const Minimum& other) { this->Value = std::min(this->Value, other.Value); }
};

} // namespace

TEST(TriangleTree, DisjointPairsAreThoseWithoutACommonVertex)
{
  for (int n : { 1, 2, 5 })
  {
    const TestSphere sphere(n);
    const TriangleList& triangles = sphere.Triangles();
    std::set<std::pair<int, int>> expected;
    for (int one = 0; one < triangles.rows(); ++one)
    {
      for (int two = one + 1; two < triangles.rows(); ++two)
      {
        std::set<int> vertices(triangles.row(one).begin(), triangles.row(one).end());
        vertices.insert(triangles.row(two).begin(), triangles.row(two).end());
        if (vertices.size() == 6)
        {
          expected.emplace(one, two);
        }
      }
    }
    const PointList topological =
      TriangleTree::TopologicalLayout(sphere.Mesh.NumberOfPoints(), sphere.Faces());
    for (const PointList& layout : { sphere.Points(), topological })
    {
      const TriangleTree tree(layout, triangles);
      std::set<std::pair<int, int>> visited;
      for (const auto& pair : tree.DisjointPairs(layout, triangles))
      {
        tree.VisitPairsBelow(
          pair, [](int, int) { return true; },
          [&](int one, int two)
          { EXPECT_TRUE(visited.emplace(one, two).second) << "visited twice"; });
      }
      EXPECT_EQ(visited, expected) << "n " << n;
    }
  }
}

// Volumes that are refitted where something changed are those that are refitted everywhere.
TEST(TriangleTree, RefitsStaleVolumesAsItRefitsAll)
{
  const TestSphere sphere(6);
  const int count = static_cast<int>(sphere.Triangles().rows());
  const TriangleTree tree(sphere.Points(), sphere.Triangles());
  std::vector<int> values(count, 1000);
  const auto leaf = [&](int triangle) { return Minimum{ values[triangle] }; };
  std::vector<Minimum> some;
  tree.Refit(some, leaf);
  for (int triangle : { 3, 17, 18, count - 1 })
  {
    values[triangle] = triangle;
  }
  std::vector<Minimum> all;
  tree.Refit(all, leaf);
  tree.Refit(some, leaf, SerialFor, [&](int node) { return all[node].Value < 1000; });
  ASSERT_EQ(some.size(), all.size());
  EXPECT_EQ(all.front().Value, 3);
  for (std::size_t node = 0; node < all.size(); ++node)
  {
    EXPECT_EQ(some[node].Value, all[node].Value) << "node " << node;
  }
}
