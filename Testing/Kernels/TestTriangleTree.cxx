#include "Geometry/TriangleTree.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace FlipFree;

namespace
{

bool AreStrangers(const TriangleList& triangles, int one, int two)
{
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      if (triangles(one, i) == triangles(two, j))
      {
        return false;
      }
    }
  }
  return true;
}

struct Lowest
{
  int Triangle = 0;
  void Merge(const Lowest& other) { this->Triangle = std::min(this->Triangle, other.Triangle); }
};

} // namespace

// Of all pairs of strangers, those of which a triangle is in the set, each once.
TEST(TriangleTree, VisitsSomePairsLikeBruteForce)
{
  std::mt19937 random(1);
  for (int n : { 1, 2, 5 })
  {
    const TestSphere sphere(n);
    const TriangleList& triangles = sphere.Triangles();
    const int count = static_cast<int>(triangles.rows());
    const TriangleTree tree(sphere.Points(), triangles);
    const auto front = tree.PartnersOf(tree.PairsOfStrangers(sphere.Points(), triangles));
    for (int size : { 0, 1, 3, count / 2, count })
    {
      std::set<int> chosen;
      while (static_cast<int>(chosen.size()) < size)
      {
        chosen.insert(std::uniform_int_distribution<int>(0, count - 1)(random));
      }
      std::set<std::pair<int, int>> expected;
      for (int one = 0; one < count; ++one)
      {
        for (int two = one + 1; two < count; ++two)
        {
          if ((chosen.count(one) || chosen.count(two)) && AreStrangers(triangles, one, two))
          {
            expected.emplace(one, two);
          }
        }
      }
      std::set<std::pair<int, int>> visited;
      const auto visit = [&](int one, int two)
      { EXPECT_TRUE(visited.emplace(one, two).second) << "visited twice"; };
      const auto always = [](int, int) { return true; };
      tree.VisitSomePairsBelow(front, tree.NodesAbove({ chosen.begin(), chosen.end() }), always,
        visit, SerialFor);
      EXPECT_EQ(visited, expected);
      if (size == count)
      {
        visited.clear();
        tree.VisitPairsBelow(front, always, visit, SerialFor);
        EXPECT_EQ(visited, expected);
        // In parts, some of them empty where there are few nodes.
        visited.clear();
        constexpr int parts = 64;
        for (int part = 0; part < parts; ++part)
        {
          const int nodes = tree.NumberOfNodes();
          tree.VisitPairsBelow(front, nodes * part / parts, nodes * (part + 1) / parts, always,
            visit);
        }
        EXPECT_EQ(visited, expected);
      }
    }
  }
}

// Volumes that are refitted where something changed are those that are refitted everywhere.
TEST(TriangleTree, RefitsSomeAsItRefitsAll)
{
  const TestSphere sphere(6);
  const int count = static_cast<int>(sphere.Triangles().rows());
  const TriangleTree tree(sphere.Points(), sphere.Triangles());
  std::vector<int> values(count, 1000);
  const auto leaf = [&](int triangle) { return Lowest{ values[triangle] }; };
  std::vector<Lowest> some;
  tree.Refit(some, leaf);
  const std::vector<int> changed{ 3, 17, 18, count - 1 };
  for (int triangle : changed)
  {
    values[triangle] = triangle;
  }
  tree.RefitSome(some, leaf, tree.NodesAbove(changed), SerialFor);
  std::vector<Lowest> all;
  tree.Refit(all, leaf);
  ASSERT_EQ(some.size(), all.size());
  EXPECT_EQ(all.front().Triangle, 3);
  for (std::size_t node = 0; node < all.size(); ++node)
  {
    EXPECT_EQ(some[node].Triangle, all[node].Triangle) << "node " << node;
  }
}
