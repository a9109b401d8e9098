// Surfaces in files of other programs.
#include "Exchange/FileProblem.h"
#include "Exchange/PolygonFile.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>

using namespace FlipFree;

namespace
{

using Coordinates = std::vector<double>;
using Indices = std::vector<int>;

const Coordinates TetrahedronPoints{ 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3 };
const Indices TetrahedronCorners{ 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };
const std::string PlyVertices = "0 0 0\n1 0 0\n0 2 0\n0 0 3\n";
const std::string PlyFaces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string VertexElement =
  "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string FaceElement = "element face 4\nproperty list uchar int vertex_indices\n";

std::string PlyText(const std::string& content, const std::string& comment = "made")
{
  return "ply\nformat ascii 1.0\ncomment " + comment + "\n" + content;
}

std::string Tetrahedron(const std::string& comment = "made")
{
  return PlyText(VertexElement + FaceElement + "end_header\n" + PlyVertices + PlyFaces, comment);
}

void AppendNumber(std::string& bytes, std::uint32_t number)
{
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

std::string BinaryStl(std::string header)
{
  header.resize(80);
  AppendNumber(header, 4);
  for (std::size_t face = 0; face < 4; ++face)
  {
    float numbers[12] = {};
    for (std::size_t index = 0; index < 9; ++index)
    {
      const int corner = TetrahedronCorners[3 * face + index / 3];
      numbers[3 + index] =
        static_cast<float>(TetrahedronPoints[3 * static_cast<std::size_t>(corner) + index % 3]);
    }
    header.append(reinterpret_cast<const char*>(numbers), sizeof(numbers));
    header.append(2, '\x81'); // a color
  }
  return header;
}

std::string TextStl(const std::string& solid, const std::string& vertex)
{
  std::ostringstream text;
  text << solid << " name\n";
  for (std::size_t face = 0; face < 4; ++face)
  {
    text << "facet normal 0 0 0\nouter loop\n";
    for (std::size_t index = 0; index < 3; ++index)
    {
      const double* const point =
        &TetrahedronPoints[3 * static_cast<std::size_t>(TetrahedronCorners[3 * face + index])];
      text << vertex << " " << point[0] << " " << point[1] << " " << point[2] << "\n";
    }
    text << "endloop\nendfacet\n";
  }
  return text.str() + "end" + solid + "\n";
}

/// Where the points of each corner are, whatever their order is.
Coordinates CornerPlaces(const CheckedPolygons& polygons)
{
  Coordinates places;
  for (const int corner : polygons.GetCorners())
  {
    const auto* const point = &polygons.GetPoints()[3 * static_cast<std::size_t>(corner)];
    places.insert(places.end(), point, point + 3);
  }
  return places;
}

void ExpectTetrahedron(const std::string& name, const std::string& bytes, bool isTurned = false)
{
  SCOPED_TRACE(bytes.substr(0, 100));
  const CheckedPolygons found = ReadPolygonFile(name, bytes);
  EXPECT_EQ(found.GetOffsets(), (Indices{ 0, 3, 6, 9, 12 }));
  EXPECT_EQ(found.NumberOfPoints(), 4);
  Coordinates expected;
  for (const int corner : TetrahedronCorners)
  {
    const double* const point = &TetrahedronPoints[3 * static_cast<std::size_t>(corner)];
    const double sign = isTurned ? -1 : 1;
    expected.insert(expected.end(), { sign * point[0], sign * point[1], point[2] });
  }
  EXPECT_EQ(CornerPlaces(found), expected);
}

std::string SurfaceRefusal(const std::string& name, const std::string& bytes)
{
  try
  {
    ReadPolygonFile(name, bytes);
  }
  catch (const FileProblem& problem)
  {
    return problem.what();
  }
  return {};
}

TEST(PolygonFile, Ply)
{
  ExpectTetrahedron("a.ply", Tetrahedron());
  // Faces before vertices, further lists and elements.
  ExpectTetrahedron("a.PLY",
    PlyText(FaceElement + VertexElement + "end_header\n" + PlyFaces + PlyVertices));
  ExpectTetrahedron("a.ply",
    PlyText(VertexElement +
      "element face 4\nproperty list uint8 int32 vertex_index\n"
      "property list uchar float texcoord\nelement edge 1\n"
      "property int vertex1\nend_header\n" +
      PlyVertices + "3 0 2 1 1 .5\n3 0 1 3 0\n3 0 3 2 0\n3 1 2 3 2 1 1\n7\n"));
}

TEST(PolygonFile, Stl)
{
  ExpectTetrahedron("a.stl", BinaryStl("made"));
  ExpectTetrahedron("a.stl", BinaryStl("solid made"));
  ExpectTetrahedron("a.stl", BinaryStl("made") + "more");
  ExpectTetrahedron("a.stl", TextStl("solid", "vertex"));
  ExpectTetrahedron("a.stl", TextStl("SOLID", "VERTEX"));
}

TEST(PolygonFile, Obj)
{
  const std::string vertices = "v 0 0 0\nv 1 0 0 1 1 1\nv 0 2 0\nv 0 0 3\n";
  ExpectTetrahedron("a.obj",
    "o x\n" + vertices + "vn 0 0 1\nl 1 2\nf 1/1 3 2\nf -4 -3 -1\nf 1//1 4//1 \\\n3//1\nf 2 3 4\n");
}

TEST(PolygonFile, RasWhereACommentSaysSo)
{
  const std::string words = "3D Slicer output. SPACE=RAS";
  ExpectTetrahedron("a.ply", Tetrahedron(words), true);
  ExpectTetrahedron("a.stl", BinaryStl(words), true);
  ExpectTetrahedron("a.stl", TextStl("solid " + words, "vertex"), true);
  const std::string obj =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  ExpectTetrahedron("a.obj", "# " + words + "\n" + obj, true);
  ExpectTetrahedron("a.obj", "# 3D Slicer output. SPACE=LPS\n" + obj);
}

TEST(PolygonFile, Refusals)
{
  std::string wrongFace = Tetrahedron();
  wrongFace.replace(wrongFace.find("3 1 2 3"), 7, "3 1 2 4");
  std::string notFinite = Tetrahedron();
  notFinite.replace(notFinite.find("0 0 3"), 5, "0 0 nan");
  for (const auto& [name, bytes, reason] : std::vector<std::array<std::string, 3>>{
         { "a.ply", wrongFace, "face 3 has a vertex that does not exist" },
         { "a.ply", notFinite, "the position of vertex 3 is not finite" },
         { "a.ply", Tetrahedron().substr(0, 200), "truncated" },
         { "a.ply", "solid", "its header does not end" },
         { "a.stl", BinaryStl("x").substr(0, 200), "fewer triangles than its header says" },
         { "a.stl", "solid\nvertex 1,5 0 0\n", "not a number" },
         { "a.stl", "solid\nvertex 0 0 0\nvertex nan 0 0\nvertex 0 1 0\n",
           "the position of vertex 1 is not finite" },
         { "a.obj", "v 0 0 0\nf 0 1 1\n", "face 0 has a vertex that does not exist" },
         { "a.obj", "v 0 0 0\nf 1 1\n", "fewer than three" } })
  {
    const std::string refusal = SurfaceRefusal(name, bytes);
    EXPECT_NE(refusal.find("'" + name + "' cannot be read"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(reason), std::string::npos) << refusal;
  }
}

} // namespace
