// Surfaces as the bytes of files: what is read back of them.
#include "Exchange/ByteOrder.h"
#include "Exchange/PolygonFile.h"
#include "Exchange/SurfaceBytes.h"
#include "Exchange/VtpBytes.h"
#include "Exchange/VtpHeader.h"

#include <gtest/gtest.h>

#include <locale>

using namespace FlipFree;

namespace
{

const std::vector<std::string> TwoComments{ "FlipFree, millimeters, SPACE=LPS", "provenance {}" };

// A pyramid over a square, with a triangle without an area.
struct Pyramid
{
  Pyramid()
    : Points(5, 3)
    , Triangles(7, 3)
  {
    this->Points << 0, 0, 0, 0.1F, 0, 0, 0.1F, 12345.678F, 0, 0, 12345.678F, 0, -1e-20F, 1,
      1.0F / 3;
    this->Triangles << 0, 3, 2, 0, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 4, 4, 0;
    this->Faces.Append({ 0, 3, 2, 1 });
    this->Faces.Append({ 0, 1, 4 });
    this->Faces.Append({ 1, 2, 4 });
  }

  PointList Points;
  TriangleList Triangles;
  FaceList Faces;
};

std::vector<double> CoordinatesOf(const PointList& points)
{
  return { points.data(), points.data() + points.size() };
}

// The numbers of an array of a VTP file.
template <typename T>
std::vector<T> NumbersIn(const std::string& bytes, const std::string& name)
{
  const std::string mark = "offset=\"";
  const std::size_t element = bytes.find("Name=\"" + name + "\"");
  const std::size_t offset = bytes.find(mark, element) + mark.size();
  const std::size_t start = bytes.find("\n_") + 2 + std::stoul(bytes.substr(offset));
  const auto size = NumberFrom<std::uint64_t>(&bytes[start], false);
  std::vector<T> numbers;
  for (std::size_t at = start + 8; at < start + 8 + size; at += sizeof(T))
  {
    numbers.push_back(NumberFrom<T>(&bytes[at], false));
  }
  return numbers;
}

} // namespace

TEST(SurfaceBytes, PlyIsReadBack)
{
  const Pyramid it;
  const TriangleList triangles = it.Triangles.topRows(6);
  const std::string bytes = PlyBytes(it.Points, triangles, TwoComments);
  EXPECT_EQ(bytes.find("ply\nformat binary_little_endian 1.0\ncomment FlipFree, millimeters, "
                       "SPACE=LPS\ncomment provenance {}\nelement vertex 5\n"),
    0U);
  const CheckedPolygons read = ReadPolygonFile("a.ply", bytes);
  EXPECT_EQ(read.GetPoints(), CoordinatesOf(it.Points));
  EXPECT_EQ(read.GetCorners(),
    std::vector<int>(triangles.data(), triangles.data() + triangles.size()));
  EXPECT_EQ(read.GetOffsets(), (std::vector<int>{ 0, 3, 6, 9, 12, 15, 18 }));
}

TEST(SurfaceBytes, ObjIsReadBackWithItsFaces)
{
  Pyramid it;
  it.Points(0, 0) = 1.0 / 3; // beyond single precision
  const std::string bytes = ObjBytes(it.Points, it.Faces, TwoComments);
  EXPECT_EQ(bytes.find("# FlipFree, millimeters, SPACE=LPS\n# provenance {}\nv 0.333333333333333"),
    0U);
  EXPECT_EQ(bytes.back(), '\n');
  const CheckedPolygons read = ReadPolygonFile("a.obj", bytes);
  EXPECT_EQ(read.GetPoints(), CoordinatesOf(it.Points));
  EXPECT_EQ(read.GetCorners(), it.Faces.Connectivity);
  EXPECT_EQ(read.GetOffsets(), it.Faces.Offsets);
}

// As in German.
struct Comma : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
};

TEST(SurfaceBytes, ObjHasPointsInNumbersWhateverTheLocale)
{
  const Pyramid it;
  const std::string bytes = ObjBytes(it.Points, it.Faces, TwoComments);
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const std::string withCommas = ObjBytes(it.Points, it.Faces, TwoComments);
  std::locale::global(before);
  EXPECT_EQ(withCommas, bytes);
}

TEST(SurfaceBytes, StlHasTrianglesWithTheirNormals)
{
  const Pyramid it;
  const std::string bytes = StlBytes(it.Points, it.Triangles, TwoComments);
  ASSERT_EQ(bytes.size(), 84U + 50U * 7U);
  std::string header = TwoComments[0];
  header.resize(80, ' ');
  EXPECT_EQ(bytes.substr(0, 80), header);
  EXPECT_EQ(NumberFrom<std::uint32_t>(&bytes[80], false), 7U);
  const auto number = [&bytes](std::size_t triangle, std::size_t index)
  { return NumberFrom<float>(&bytes[84 + 50 * triangle + 4 * index], false); };
  for (std::size_t triangle = 0; triangle < 7; ++triangle)
  {
    for (std::size_t index = 0; index < 9; ++index)
    {
      const int corner =
        it.Triangles(static_cast<Eigen::Index>(triangle), static_cast<Eigen::Index>(index / 3));
      EXPECT_EQ(number(triangle, 3 + index),
        it.Points(corner, static_cast<Eigen::Index>(index % 3)));
    }
    const Eigen::Vector3f normal(number(triangle, 0), number(triangle, 1), number(triangle, 2));
    EXPECT_NEAR(normal.norm(), triangle < 6 ? 1 : 0, 1e-6);
  }
  EXPECT_EQ(number(0, 2), -1); // the square is seen from below
  EXPECT_EQ(number(0, 0), 0);
  // Longer than the header.
  EXPECT_EQ(StlBytes(it.Points, it.Triangles, { std::string(99, 'x') }).size(), bytes.size());
  EXPECT_EQ(
    ReadPolygonFile("a.stl", StlBytes(it.Points, it.Triangles.topRows(6), {})).NumberOfPoints(), 5);
}

TEST(SurfaceBytes, VtpHasTheFacesAndAllArrays)
{
  Pyramid it;
  it.Points(0, 0) = 1.0 / 3; // beyond single precision
  const std::vector<float> confidence{ 0.5F, 0.25F, 1, 0, 0.1F };
  const std::vector<unsigned char> classes{ 0, 1, 2, 255, 4 };
  const double certified = 1;
  VtpContent content;
  content.Fields = { VtpNumbers("Certified", &certified, 1), VtpText("Provenance", "{\"a\":1}") };
  content.PointData = { VtpNumbers("Displacement", it.Points.data(), 15, 3),
    VtpNumbers("Confidence", confidence.data(), 5), VtpNumbers("Class", classes.data(), 5) };
  const std::string bytes = VtpBytes(it.Points, it.Faces, content);
  EXPECT_NO_THROW(ValidateVtp("a.vtp", bytes));
  EXPECT_ANY_THROW(ValidateVtp("a.vtp", bytes.substr(0, bytes.size() / 2)));
  EXPECT_NE(bytes.find("NumberOfPoints=\"5\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                       "NumberOfStrips=\"0\" NumberOfPolys=\"3\""),
    std::string::npos);
  EXPECT_EQ(NumbersIn<double>(bytes, "Points"), CoordinatesOf(it.Points));
  EXPECT_EQ(NumbersIn<double>(bytes, "Displacement"), CoordinatesOf(it.Points));
  EXPECT_EQ(NumbersIn<double>(bytes, "Certified"), std::vector<double>{ 1 });
  EXPECT_EQ(NumbersIn<float>(bytes, "Confidence"), confidence);
  EXPECT_EQ(NumbersIn<unsigned char>(bytes, "Class"), classes);
  EXPECT_EQ(NumbersIn<std::int32_t>(bytes, "connectivity"), it.Faces.Connectivity);
  EXPECT_EQ(NumbersIn<std::int32_t>(bytes, "offsets"), (std::vector<int>{ 4, 7, 10 }));
  const std::vector<char> text = NumbersIn<char>(bytes, "Provenance");
  EXPECT_EQ(std::string(text.begin(), text.end()), std::string("{\"a\":1}") + '\0');
}

TEST(SurfaceBytes, VtpHasLines)
{
  const Pyramid it;
  const int parent = -1;
  FaceList line;
  line.Append({ 0, 1, 2, 3, 4 });
  VtpContent content;
  content.AreLines = true;
  content.CellData = { VtpNumbers("Parent", &parent, 1) };
  const std::string bytes = VtpBytes(it.Points, line, content);
  EXPECT_NO_THROW(ValidateVtp("a.vtp", bytes));
  EXPECT_NE(bytes.find("NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberOfPolys=\"0\""),
    std::string::npos);
  EXPECT_NE(bytes.find("<Lines>"), std::string::npos);
  EXPECT_EQ(NumbersIn<std::int32_t>(bytes, "Parent"), std::vector<int>{ -1 });
}
