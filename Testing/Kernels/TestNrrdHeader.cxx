// Headers of NRRD files: spaces, units, and axes that are not of space.
#include "Exchange/NrrdHeader.h"

#include "gtest/gtest.h"

namespace
{

using namespace FlipFree;

/// A file of 5 x 4 x 3 shorts.
std::string NrrdFile(const std::string& fields,
  const std::string& grid = "dimension: 3\nsizes: 5 4 3")
{
  return "NRRD0005\ntype: short\nendian: little\nencoding: raw\n" + grid + "\n" + fields + "\n\n";
}

VolumeFileHeader ReadNrrd(const std::string& bytes)
{
  return ReadNrrdHeader("image.nrrd", bytes);
}

void ExpectNrrdRefusal(const std::string& bytes, const std::string& word)
{
  try
  {
    ReadNrrd(bytes);
    FAIL() << "not refused: " << word;
  }
  catch (const FileProblem& problem)
  {
    EXPECT_NE(std::string(problem.what()).find(word), std::string::npos) << problem.what();
  }
}

const std::string NrrdDirections =
  "space directions: (2,0,0) (0,1.5,0.3) (0,0,3)\nspace origin: (10,20,30)\n";

TEST(NrrdHeader, EverySpaceIsTheSamePlaceInThePatient)
{
  struct Space
  {
    std::string Name;
    Eigen::Vector3d Signs;
  };
  for (const Space& space : { Space{ "left-posterior-superior", { 1, 1, 1 } },
         Space{ "right-anterior-superior", { -1, -1, 1 } },
         Space{ "left-anterior-superior", { 1, -1, 1 } }, Space{ "LPS", { 1, 1, 1 } },
         Space{ "RAS", { -1, -1, 1 } }, Space{ "LAS", { 1, -1, 1 } },
         Space{ "Right-Anterior-Superior-Time", { -1, -1, 1 } } })
  {
    const VolumeFileHeader header =
      ReadNrrd(NrrdFile("space: " + space.Name + "\n" + NrrdDirections));
    EXPECT_TRUE(header.Warnings.empty()) << space.Name;
    const Eigen::Vector3d far = Eigen::Vector3d(10, 20, 30) + Eigen::Vector3d(8, 4.5, 0.9 + 6);
    EXPECT_TRUE(header.Geometry.ToPhysical(Eigen::Vector3d(4, 3, 2))
                  .isApprox(space.Signs.cwiseProduct(far), 1e-12))
      << space.Name;
  }
  // Axes within half a degree of each other.
  ExpectNrrdRefusal(
    NrrdFile("space: LPS\nspace directions: (1,0,0) (0,1,200) (0,0,1.5)\nspace origin: (0,0,0)\n"),
    "directions independent");
  ExpectNrrdRefusal(NrrdFile("space: upside-down\n" + NrrdDirections), "space is none of");
}

TEST(NrrdHeader, WhatIsNotSaidIsAWarning)
{
  EXPECT_EQ(ReadNrrd(NrrdFile("space: scanner-xyz\n" + NrrdDirections)).Warnings.size(), 1);
  EXPECT_EQ(ReadNrrd(NrrdFile("space dimension: 3\n" + NrrdDirections)).Warnings.size(), 1);
  EXPECT_EQ(ReadNrrd(NrrdFile("spacings: 2 1.5 3")).Warnings.size(), 1);
  const std::vector<std::string> nothing = ReadNrrd(NrrdFile("# nothing")).Warnings;
  ASSERT_EQ(nothing.size(), 1);
  for (const std::string taken :
    { "1 mm was taken", "left, posterior", "and where its first voxel" })
  {
    EXPECT_NE(nothing[0].find(taken), std::string::npos) << nothing[0];
  }
  const std::string space = "space: LPS\nspace directions: (2,0,0) (0,1.5,0) (0,0,3)\n";
  const std::vector<std::string> warnings = ReadNrrd(NrrdFile(space)).Warnings;
  ASSERT_EQ(warnings.size(), 1);
  EXPECT_EQ(warnings[0],
    "'image.nrrd' does not say where its first voxel is (the origin was taken).");
  EXPECT_EQ(ReadNrrd(NrrdFile("spacings: 2 1.5 3")).Geometry.Spacing, Eigen::Vector3d(2, 1.5, 3));
  std::string bytes = NrrdFile(NrrdDirections);
  bytes.erase(bytes.find("endian"), std::string("endian: little\n").size());
  ExpectNrrdRefusal(bytes, "endian is missing");
}

TEST(NrrdHeader, UnitsOfSpace)
{
  const std::string space = "space: left-posterior-superior\n" + NrrdDirections;
  const Eigen::Vector3d origin(10, 20, 30);
  EXPECT_EQ(ReadNrrd(NrrdFile(space + "space units: \"mm\" \"mm\" \"mm\"")).Geometry.Origin,
    origin);
  EXPECT_EQ(ReadNrrd(NrrdFile(space + "space units: \"cm\" \"cm\" \"cm\"")).Geometry.Origin,
    10 * origin);
  EXPECT_TRUE(
    ReadNrrd(NrrdFile(space + "space units: \"um\" \"um\" \"um\""))
      .Geometry.Spacing.isApprox(1e-3 * ReadNrrd(NrrdFile(space)).Geometry.Spacing, 1e-12));
  EXPECT_EQ(ReadNrrd(NrrdFile("spacings: 2 1.5 3\nunits: \"m\" \"m\" \"m\"")).Geometry.Spacing[1],
    1500);
  ExpectNrrdRefusal(NrrdFile(space + "space units: \"s\" \"s\" \"s\""), "unit that is no length");
}

TEST(NrrdHeader, AxesThatAreNotOfSpace)
{
  const std::string space =
    "space: left-posterior-superior\nspace directions: none (2,0,0) (0,1,0) (0,0,3)\n";
  ExpectNrrdRefusal(
    NrrdFile(space, "dimension: 4\nsizes: 3 5 4 6\nkinds: vector domain domain domain"),
    "3 components");
  EXPECT_EQ(ReadNrrd(NrrdFile(space, "dimension: 4\nsizes: 1 5 4 6")).Geometry.Dimensions[2], 6);
  ExpectNrrdRefusal(NrrdFile("", "dimension: 4\nsizes: 5 4 6 7"), "5 x 4 x 6 x 7");
  ExpectNrrdRefusal(NrrdFile("", "dimension: 2\nsizes: 5 4"), "2 dimensions (5 x 4)");
  ExpectNrrdRefusal(NrrdFile("", "dimension: 3\nsizes: 3 5 4\nkinds: vector domain domain"),
    "2 dimensions (5 x 4)");

  const VolumeFileHeader layers =
    ReadNrrd(NrrdFile(space + "Segment0_ID:=Segment_1\nSegment0_Name:=a: b := c",
      "dimension: 4\nsizes: 2 5 4 6\nkinds: list domain domain domain"));
  EXPECT_EQ(layers.Layers.Count, 2);
  EXPECT_TRUE(layers.Layers.AreInterleaved);
  EXPECT_EQ(layers.NumberOfStoredBytes(), 2 * 2 * 120);
  EXPECT_EQ(layers.Pairs.at("Segment0_Name"), "a: b := c");
}

TEST(NrrdHeader, LayersBetweenAxesOfSpaceAreRefused)
{
  const std::string last =
    "space: left-posterior-superior\nspace directions: (2,0,0) (0,1,0) (0,0,3) none\n"
    "Segment0_ID:=Segment_1";
  const VolumeFileHeader header = ReadNrrd(NrrdFile(last, "dimension: 4\nsizes: 5 4 6 2"));
  EXPECT_EQ(header.Layers.Count, 2);
  EXPECT_FALSE(header.Layers.AreInterleaved);
  const std::string between =
    "space: left-posterior-superior\nspace directions: (2,0,0) none (0,1,0) (0,0,3)\n"
    "Segment0_ID:=Segment_1";
  ExpectNrrdRefusal(NrrdFile(between, "dimension: 4\nsizes: 5 2 4 6"),
    "space directions puts the layers of segments between");
  EXPECT_NO_THROW(ReadNrrd(NrrdFile(between, "dimension: 4\nsizes: 5 1 4 6")));
}

TEST(NrrdHeader, SpacingsAlongTheAxesOfASpace)
{
  const VolumeFileHeader header =
    ReadNrrd(NrrdFile("space: RAS\nspacings: 2 1.5 3\nspace origin: (10,20,30)"));
  EXPECT_EQ(header.Geometry.Origin, Eigen::Vector3d(-10, -20, 30));
  EXPECT_TRUE(header.Geometry.ToPhysical(Eigen::Vector3d(1, 1, 1))
                .isApprox(Eigen::Vector3d(-12, -21.5, 33), 1e-12));
  ASSERT_EQ(header.Warnings.size(), 1);
  EXPECT_NE(header.Warnings[0].find("along the axes of the space"), std::string::npos);
  ExpectNrrdRefusal(NrrdFile("spacings: 2 -1.5 3"),
    "spacings is negative, but a spacing must be positive");
}

TEST(NrrdHeader, DirectionsWithoutLengthAreRefused)
{
  ExpectNrrdRefusal(NrrdFile("space: LPS\nspace directions: (1,0,0) (0,1.9e-9,0) (0,0,2)\n"),
    "spacing (1, 1.9e-09, 2)");
}

TEST(NrrdHeader, BoundsOfAxesAreRefused)
{
  ExpectNrrdRefusal(NrrdFile("spacings: 2 1.5 3\naxis mins: 0 0 7"), "axis mins places");
  ExpectNrrdRefusal(NrrdFile("axismaxs: 0 0 7"), "axis maxs places");
  EXPECT_NO_THROW(ReadNrrd(NrrdFile("spacings: 2 1.5 3\naxis mins: NaN nan NaN")));
  EXPECT_NO_THROW(ReadNrrd(NrrdFile("space: LPS\n" + NrrdDirections + "axis mins: NaN NaN NaN")));
}

TEST(NrrdHeader, ColonsInKeysAndFieldsWithoutBlanks)
{
  const VolumeFileHeader header = ReadNrrd(
    NrrdFile("spacings:2 1.5 3\ncontent: a := b\nDICOM:a:=1\nhttp://a:=2\ntype:of scan:=CT\n"
             "endian:=x\nunknown: y\nlabels:"));
  const std::map<std::string, std::string> pairs{ { "DICOM:a", "1" }, { "http://a", "2" },
    { "type:of scan", "CT" }, { "endian", "x" } };
  EXPECT_EQ(header.Pairs, pairs);
  EXPECT_EQ(header.Geometry.Spacing, Eigen::Vector3d(2, 1.5, 3));
  ExpectNrrdRefusal(NrrdFile("unknown:y"), "not valid NRRD");
}

TEST(NrrdHeader, PairsAreUtf8)
{
  const VolumeFileHeader header =
    ReadNrrd(NrrdFile("spacings: 1 1 1\nlatin:=caf\xE9\nutf:=caf\xC3\xA9\nk\xE9y:=v"));
  EXPECT_EQ(header.Pairs.at("latin"), "caf\xC3\xA9");
  EXPECT_EQ(header.Pairs.at("utf"), "caf\xC3\xA9");
  EXPECT_EQ(header.Pairs.at("k\xC3\xA9y"), "v");
}

TEST(NrrdHeader, LongLinesAndColonsInKeysAreText)
{
  const std::string space = "space: left-posterior-superior\n" + NrrdDirections;
  const VolumeFileHeader header = ReadNrrd(NrrdFile(space + "content: " + std::string(9000, 'x') +
    "\n" + std::string(300, 'k') + ":=" + std::string(20000, 'v')));
  EXPECT_EQ(header.Pairs.begin()->second.size(), 20000);
  EXPECT_TRUE(header.Warnings.empty());
}

TEST(NrrdHeader, LinesThatEndAsOnOtherSystems)
{
  std::string bytes = NrrdFile("space: left-posterior-superior\n" + NrrdDirections);
  std::string other;
  for (const char letter : bytes)
  {
    other += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  }
  const VolumeFileHeader header = ReadNrrd(other);
  EXPECT_EQ(header.Storage.Offset, other.size() - 2); // a blank line more than it takes
  EXPECT_EQ(header.Geometry.Origin, Eigen::Vector3d(10, 20, 30));
}

TEST(NrrdHeader, WhereVoxelsAre)
{
  const auto storage = [](const std::string& fields)
  { return ReadNrrd(NrrdFile("spacings: 1 1 1\n" + fields)).Storage; };
  EXPECT_EQ(storage("data file: a b.raw").Files.front(), "a b.raw");
  EXPECT_EQ(storage("data file: s%02d.raw 1 3 1").Files[2], "s03.raw");
  EXPECT_EQ(storage("data file: s%02d.raw 6 1 -2").Files,
    (std::vector<std::string>{ "s06.raw", "s04.raw", "s02.raw" }));
  EXPECT_TRUE(storage("byte skip: -1").IsAtEnd);
  EXPECT_EQ(storage("line skip: 2\nbyte skip: 7").Skipped, 7);
  EXPECT_EQ(storage("line skip: 2\nbyte skip: 7").Lines, 2);
  EXPECT_EQ(storage("line skip: 2\nbyte skip: -1").Lines,
    0); // voxels are at the end, whatever precedes
  for (const std::string encoding : { "gzip", "text", "hex" })
  {
    std::string bytes = NrrdFile("spacings: 1 1 1\nbyte skip: -1");
    bytes.replace(bytes.find("raw"), 3, encoding);
    ExpectNrrdRefusal(bytes, "byte skip is -1");
  }
}

} // namespace
