#include "ExampleSurfaces.h"
#include "Mesh/ContourMesh.h"
#include "Mesh/QuadSphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace FlipFree;

TEST(ContourMesh, SphereHasThePapersCounts)
{
  for (int n : { 1, 2, 3, 8, 32 })
  {
    const QuadSphere sphere =
      MakeQuadSphere(n, Eigen::Vector3d::Zero(), 1.0, QuadSphereSpacing::Equiangular);
    const ContourMesh mesh = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
    EXPECT_EQ(mesh.NumberOfPoints(), 6 * n * n);
    int quads = 0;
    int triangles = 0;
    for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
    {
      (mesh.Faces.FaceSize(face) == 4 ? quads : triangles)++;
    }
    EXPECT_EQ(quads, 6 * n * n - 6);
    EXPECT_EQ(triangles, 8);
    EXPECT_EQ(mesh.EulerNumber(), 2);
    ASSERT_EQ(mesh.Contours.size(), 3u * n);
    for (const auto& contour : mesh.Contours)
    {
      EXPECT_EQ(contour.size(), 4u * n);
    }
  }
}

TEST(QuadSphere, CheckerboardHasFieldsOfFourByFour)
{
  const QuadSphere sphere = MakeQuadSphere(8, { 0, 0, 0 }, 1, QuadSphereSpacing::Equiangular);
  const std::vector<unsigned char> fields = CheckerboardOf(sphere);
  ASSERT_EQ(fields.size(), 6U * 8 * 8);
  for (std::size_t vertex = 0; vertex < fields.size(); ++vertex)
  {
    const auto& [side, u, v] = sphere.Cells[vertex];
    EXPECT_EQ(fields[vertex], (u < 4) == (v < 4) ? 0 : 1) << side;
  }
}

TEST(ContourMesh, EveryVertexOfASphereLiesOnTwoContours)
{
  const int n = 5;
  const QuadSphere sphere =
    MakeQuadSphere(n, Eigen::Vector3d::Zero(), 1.0, QuadSphereSpacing::Radial);
  const ContourMesh mesh = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
  std::vector<int> count(mesh.NumberOfPoints(), 0);
  for (const auto& contour : mesh.Contours)
  {
    EXPECT_EQ(std::set<int>(contour.begin(), contour.end()).size(), contour.size());
    for (int vertex : contour)
    {
      ++count[vertex];
    }
  }
  EXPECT_EQ(count, std::vector<int>(mesh.NumberOfPoints(), 2));
}

TEST(ContourMesh, RefusesAnOpenMeshNamingItsVertex)
{
  QuadSphere sphere = MakeQuadSphere(2, Eigen::Vector3d::Zero(), 1.0, QuadSphereSpacing::Radial);
  const int last = sphere.Faces.NumberOfFaces() - 1;
  const int* face = sphere.Faces.Face(last);
  const int vertex = *std::min_element(face, face + sphere.Faces.FaceSize(last));
  sphere.Faces.Connectivity.resize(sphere.Faces.Offsets[last]);
  sphere.Faces.Offsets.pop_back();
  const std::string error =
    ErrorOf([&] { BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces); });
  EXPECT_NE(error.find("vertex " + std::to_string(vertex)), std::string::npos) << error;
  EXPECT_NE(error.find("3 faces instead of 4"), std::string::npos) << error;
}

TEST(ContourMesh, LargeFacesAreCutAsTheTrianglesAre)
{
  const FaceList faces = NeckOfTwoFaces().Faces;
  const FaceList cut = CutLargeFaces(faces);
  EXPECT_EQ(Triangulate(cut), Triangulate(faces));
  EXPECT_EQ(cut.NumberOfFaces(), 14 + 4 * 3);
  for (int face = 0; face < cut.NumberOfFaces(); ++face)
  {
    EXPECT_LE(cut.FaceSize(face), 4);
  }
  EXPECT_EQ(BuildMeshAtRest(16, cut).EulerNumber(), 2);
}
