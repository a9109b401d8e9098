#include "Guard/CandidatePairs.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace FlipFree;

namespace
{

using Feature = std::vector<int>; // sorted vertices
using FeaturePair = std::pair<Feature, Feature>;

bool Disjoint(const Feature& one, const Feature& two)
{
  return std::none_of(one.begin(), one.end(),
    [&](int vertex) { return std::binary_search(two.begin(), two.end(), vertex); });
}

// From the definition: every pair of features, every pair of triangles that contain them.
std::set<FeaturePair> BruteForce(const TriangleList& triangles)
{
  std::set<Feature> vertices;
  std::set<Feature> edges;
  std::set<Feature> faces;
  for (Eigen::Index row = 0; row < triangles.rows(); ++row)
  {
    Feature face{ triangles(row, 0), triangles(row, 1), triangles(row, 2) };
    std::sort(face.begin(), face.end());
    faces.insert(face);
    for (int i = 0; i < 3; ++i)
    {
      vertices.insert({ face[i] });
      edges.insert({ face[i == 2 ? 0 : i], face[i == 0 ? 1 : 2] });
    }
  }
  const auto areCovered = [&](const Feature& one, const Feature& two)
  {
    for (const Feature& first : faces)
    {
      for (const Feature& second : faces)
      {
        if (Disjoint(first, second) &&
          std::includes(first.begin(), first.end(), one.begin(), one.end()) &&
          std::includes(second.begin(), second.end(), two.begin(), two.end()))
        {
          return true;
        }
      }
    }
    return false;
  };
  std::set<FeaturePair> pairs;
  for (const Feature& face : faces)
  {
    for (const Feature& vertex : vertices)
    {
      if (Disjoint(vertex, face) && !areCovered(vertex, face))
      {
        pairs.insert({ vertex, face });
      }
    }
  }
  for (const Feature& one : edges)
  {
    for (const Feature& two : edges)
    {
      if (one < two && Disjoint(one, two) && !areCovered(one, two))
      {
        pairs.insert({ one, two });
      }
    }
  }
  return pairs;
}

std::set<FeaturePair> List(const ContourMesh& mesh)
{
  const CandidatePairs listed(mesh.NumberOfPoints(), mesh.Triangles);
  std::set<FeaturePair> pairs;
  const auto insert = [&](const auto& one, const auto& two)
  {
    FeaturePair pair{ Feature(one.begin(), one.end()), Feature(two.begin(), two.end()) };
    std::sort(pair.first.begin(), pair.first.end());
    std::sort(pair.second.begin(), pair.second.end());
    EXPECT_TRUE(pairs.insert(pair).second) << "listed twice";
  };
  for (const auto& pair : listed.VertexFacePairs())
  {
    insert(pair.Vertex, pair.Face);
  }
  for (const auto& pair : listed.EdgeEdgePairs())
  {
    insert(pair.One, pair.Two);
  }
  return pairs;
}

} // namespace

TEST(CandidatePairs, DisjointTrianglesCoverSpheres)
{
  for (int n : { 1, 2, 3, 8 })
  {
    EXPECT_TRUE(List(TestSphere(n).Mesh).empty()) << "n " << n;
  }
  EXPECT_TRUE(BruteForce(TestSphere(1).Mesh.Triangles).empty());
  EXPECT_TRUE(BruteForce(TestSphere(2).Mesh.Triangles).empty());
}

TEST(CandidatePairs, ListsTheRestLikeBruteForce)
{
  const ContourMesh seven = SevenVertexTorus().Mesh;
  EXPECT_EQ(List(seven), BruteForce(seven.Triangles));
  EXPECT_EQ(List(seven).size(), 14u + 42u);

  // Other tori of few vertices: vertex i is joined to i +- 1, i +- step and, by the diagonals,
  // i +- (1 + step), which must be six different ones.
  for (int count = 7; count < 12; ++count)
  {
    for (int step = 2; 2 * step + 2 < count; ++step)
    {
      FaceList faces;
      for (int i = 0; i < count; ++i)
      {
        faces.Append({ i, (i + 1) % count, (i + 1 + step) % count, (i + step) % count });
      }
      const ContourMesh mesh = BuildContourMesh(count, faces);
      EXPECT_EQ(List(mesh), BruteForce(mesh.Triangles)) << count << " vertices, step " << step;
    }
  }
}

// Of all pairs of disjoint triangles with a changed vertex, each is visited once: at rest and with
// a gap that reaches everywhere, or else where triangles come near.
TEST(CandidatePairs, VisitsChangedPairsLikeBruteForce)
{
  std::mt19937 random(1);
  for (int n : { 1, 2, 5 })
  {
    const TestSphere sphere(n);
    const TriangleList& triangles = sphere.Triangles();
    const int count = sphere.Mesh.NumberOfPoints();
    const CandidatePairs candidates(count, triangles);
    std::vector<MotionBox> boxes;
    for (int size : { count, 0, 1, 3, count / 2 })
    {
      std::vector<char> changed(count, 0);
      std::fill(changed.begin(), changed.begin() + size, 1);
      std::shuffle(changed.begin(), changed.end(), random);
      const auto featureOf = [&](int triangle)
      {
        Feature feature(triangles.row(triangle).begin(), triangles.row(triangle).end());
        std::sort(feature.begin(), feature.end());
        return feature;
      };
      const auto isChanged = [&](const Feature& feature)
      {
        return std::any_of(feature.begin(), feature.end(),
          [&](int vertex) { return changed[vertex] != 0; });
      };
      std::set<std::pair<int, int>> expected;
      for (int one = 0; one < triangles.rows(); ++one)
      {
        for (int two = one + 1; two < triangles.rows(); ++two)
        {
          const Feature first = featureOf(one);
          const Feature second = featureOf(two);
          if (Disjoint(first, second) && (isChanged(first) || isChanged(second)))
          {
            expected.emplace(one, two);
          }
        }
      }
      std::set<std::pair<int, int>> visited;
      candidates.VisitDisjointTriangles(
        { sphere.Points(), sphere.Points() }, 1e3, changed, boxes,
        [&](int one, int two) { EXPECT_TRUE(visited.emplace(one, two).second) << "visited twice"; },
        SerialFor);
      EXPECT_EQ(visited, expected) << "n " << n << ", " << size << " changed";
    }
  }
}
