#include "ExampleSurfaces.h"
#include "Geometry/FaceHulls.h"
#include "Mesh/SurfaceTopology.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace FlipFree;

namespace
{

using VertexSet = std::set<int>;
using SetPair = std::pair<VertexSet, VertexSet>;

VertexSet SetOf(const Hull& hull)
{
  return VertexSet(hull.begin(), hull.end());
}

bool AreDisjoint(const VertexSet& one, const VertexSet& two)
{
  return std::none_of(one.begin(), one.end(),
    [&](int vertex) { return two.find(vertex) != two.end(); });
}

bool Contains(const VertexSet& large, const VertexSet& small)
{
  return std::includes(large.begin(), large.end(), small.begin(), small.end());
}

// All triangles of corners of a face.
std::vector<VertexSet> TrianglesOf(const FaceList& faces, int face)
{
  std::vector<VertexSet> triangles;
  const int* const v = faces.Face(face);
  for (int i = 0; i < faces.FaceSize(face); ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      for (int k = 0; k < j; ++k)
      {
        triangles.push_back({ v[i], v[j], v[k] });
      }
    }
  }
  return triangles;
}

// Two triangles of a face belong to one cut if no two of their edges cross: no four of their
// corners alternate around the face.
bool AreOfOneCut(const FaceList& faces, int face, const VertexSet& one, const VertexSet& two)
{
  std::vector<int> sides; // around the face: 1, 2, or 3 for a corner of both
  for (int corner = 0; corner < faces.FaceSize(face); ++corner)
  {
    const int vertex = faces.Face(face)[corner];
    const int side = (one.count(vertex) > 0 ? 1 : 0) + (two.count(vertex) > 0 ? 2 : 0);
    if (side > 0)
    {
      sides.push_back(side);
    }
  }
  const int n = static_cast<int>(sides.size());
  for (int a = 0; a < n; ++a)
  {
    for (int b = a + 1; b < n; ++b)
    {
      for (int c = b + 1; c < n; ++c)
      {
        for (int d = c + 1; d < n; ++d)
        {
          if (((sides[a] & sides[c] & 1) != 0 && (sides[b] & sides[d] & 2) != 0) ||
            ((sides[a] & sides[c] & 2) != 0 && (sides[b] & sides[d] & 1) != 0))
          {
            return false;
          }
        }
      }
    }
  }
  return one != two;
}

// What has to be apart for two triangles to meet only in their common vertices.
std::vector<SetPair> PartsOf(const VertexSet& one, const VertexSet& two)
{
  std::vector<int> common;
  std::set_intersection(one.begin(), one.end(), two.begin(), two.end(), std::back_inserter(common));
  std::vector<SetPair> parts;
  for (unsigned int subset = 0; subset < 1U << common.size(); ++subset)
  {
    SetPair pair(one, two);
    for (std::size_t i = 0; i < common.size(); ++i)
    {
      ((subset >> i & 1U) != 0 ? pair.second : pair.first).erase(common[i]);
    }
    if (!pair.first.empty() && !pair.second.empty())
    {
      parts.push_back(pair);
    }
  }
  return parts;
}

// From the definition: whatever has to be apart for some cut lies in a pair that is listed.
void ExpectAllCutsCovered(const FaceList& faces, int numberOfPoints)
{
  const FaceHulls hulls(TriangleTree::TopologicalLayout(numberOfPoints, faces), faces);
  ASSERT_TRUE(hulls.VisitAdjacentPairs(true, [](const auto&) {}).empty());
  std::vector<SetPair> listed;
  for (const HullPair& pair : AdjacentPairsOf(hulls))
  {
    ASSERT_TRUE(AreDisjoint(SetOf(pair.One), SetOf(pair.Two)));
    listed.emplace_back(SetOf(pair.One), SetOf(pair.Two));
  }
  for (int one = 0; one < hulls.NumberOfHulls(); ++one)
  {
    for (int two = 0; two < hulls.NumberOfHulls(); ++two)
    {
      if (hulls.AreDisjoint(one, two))
      {
        listed.emplace_back(SetOf(hulls.HullAt(one)), SetOf(hulls.HullAt(two)));
      }
    }
  }
  const auto isCovered = [&](const SetPair& pair)
  {
    return std::any_of(listed.begin(), listed.end(),
      [&](const SetPair& other)
      {
        return (Contains(other.first, pair.first) && Contains(other.second, pair.second)) ||
          (Contains(other.first, pair.second) && Contains(other.second, pair.first));
      });
  };
  for (int first = 0; first < faces.NumberOfFaces(); ++first)
  {
    for (int second = first; second < faces.NumberOfFaces(); ++second)
    {
      for (const VertexSet& one : TrianglesOf(faces, first))
      {
        for (const VertexSet& two : TrianglesOf(faces, second))
        {
          if (first == second && !AreOfOneCut(faces, first, one, two))
          {
            continue;
          }
          for (const SetPair& pair : PartsOf(one, two))
          {
            // Triangles without a common vertex first touch by a vertex or by two edges; of a
            // large face, an edge and a triangle are enough.
            const bool isLargeOwn =
              first == second && pair.first.size() == 3 && pair.second.size() == 3;
            ASSERT_TRUE(isLargeOwn || isCovered(pair)) << "faces " << first << " and " << second;
          }
        }
      }
    }
  }
}

FaceList Antiprism(int size)
{
  FaceList faces;
  FaceList caps;
  for (int cap = 0; cap < 2; ++cap)
  {
    for (int i = 0; i < size; ++i)
    {
      faces.Connectivity.push_back(cap == 0 ? size - 1 - i : size + i);
    }
    faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
  }
  for (int i = 0; i < size; ++i)
  {
    faces.Append({ i, (i + 1) % size, size + i });
    faces.Append({ (i + 1) % size, size + (i + 1) % size, size + i });
  }
  return faces;
}

} // namespace

TEST(FaceHulls, CoverAllCuts)
{
  for (int n : { 1, 2, 3 })
  {
    const TestSphere sphere(n);
    ExpectAllCutsCovered(sphere.Faces(), sphere.Mesh.NumberOfPoints());
    ExpectAllCutsCovered(FacesOf(sphere.Triangles()), sphere.Mesh.NumberOfPoints());
  }
  for (int across : { 4, 5 })
  {
    const TestTorus torus(4, across);
    ExpectAllCutsCovered(torus.Mesh.Faces, torus.Mesh.NumberOfPoints());
  }
  for (int size : { 4, 5, 6, 8 })
  {
    ExpectAllCutsCovered(Antiprism(size), 2 * size);
  }
}

// Of a face that has too many cuts, those of the fan.
TEST(FaceHulls, LargeFacesStandForTheirFans)
{
  const FaceList faces = Antiprism(9);
  const FaceHulls hulls(TriangleTree::TopologicalLayout(18, faces), faces);
  EXPECT_EQ(hulls.NumberOfHulls(), 2 * 7 + 18);
  EXPECT_EQ(hulls.FaceOf(6), 0);
  EXPECT_EQ(hulls.FaceOf(7), 1);
  EXPECT_EQ(SetOf(hulls.HullAt(0)), (VertexSet{ 8, 7, 6 }));
}

// Few pairs are left to list: what lies in two faces without a common vertex is not.
TEST(FaceHulls, ListsEightPairsPerVertexOfARegularMesh)
{
  const TestTorus torus(12, 12);
  const FaceHulls hulls(torus.Points, torus.Mesh.Faces);
  EXPECT_EQ(AdjacentPairsOf(hulls).size(), 8u * 144u);
}

TEST(FaceHulls, NamesFacesThatShareTooMuch)
{
  FaceList faces;
  faces.Append({ 0, 1, 2, 3 });
  faces.Append({ 2, 1, 0, 4 });
  const PointList layout = PointList::Zero(5, 3);
  const std::vector<std::pair<int, int>> expected{ { 0, 1 } };
  EXPECT_EQ(FaceHulls(layout, faces).VisitAdjacentPairs(true, [](const auto&) {}), expected);
}

TEST(FaceHulls, NamesFacesThatShareADiagonal)
{
  using Pairs = std::vector<std::pair<int, int>>;
  const auto overlapping = [](int numberOfPoints, const FaceList& faces)
  { return FaceHulls(PointList::Zero(numberOfPoints, 3), faces).FindOverlappingFaces(); };
  FaceList quads;
  quads.Append({ 0, 1, 2, 3 });
  quads.Append({ 0, 4, 2, 5 });
  EXPECT_EQ(overlapping(6, quads), (Pairs{ { 0, 1 } }));
  // One has an edge where the other can be cut.
  FaceList mixed;
  mixed.Append({ 0, 1, 2, 3 });
  mixed.Append({ 0, 4, 2 });
  EXPECT_EQ(overlapping(5, mixed), (Pairs{ { 0, 1 } }));
  FaceList adjacent;
  adjacent.Append({ 0, 1, 2, 3 });
  adjacent.Append({ 1, 0, 4, 5 });
  EXPECT_EQ(overlapping(6, adjacent), Pairs());
  const PolygonMesh neck = NeckOfTwoFaces();
  EXPECT_EQ(overlapping(16, neck.Faces), (Pairs{ { 0, 1 }, { 2, 3 }, { 10, 11 } }));
  // A large face is cut in one way, along diagonals from its first corner, 8.
  FaceList large = Antiprism(9);
  EXPECT_EQ(overlapping(18, large), Pairs());
  large.Append({ 8, 3, 18 });
  large.Append({ 7, 3, 18 });
  const Pairs found = overlapping(19, large);
  EXPECT_TRUE(std::count(found.begin(), found.end(), std::make_pair(0, 20)) > 0);
  EXPECT_TRUE(std::count(found.begin(), found.end(), std::make_pair(0, 21)) == 0);
}
