// Headers of MetaImage files.
#include "Exchange/MetaImageHeader.h"

#include "gtest/gtest.h"

namespace
{

using namespace FlipFree;

std::string MetaImageFile(const std::string& fields, const std::string& place = "LOCAL")
{
  return "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_SHORT\n" + fields +
    "ElementDataFile = " + place + "\n";
}

VolumeFileHeader ReadMetaImage(const std::string& bytes)
{
  return ReadMetaImageHeader("image.mha", bytes);
}

TEST(MetaImageHeader, EachRowOfTheMatrixIsAnAxis)
{
  const VolumeFileHeader header = ReadMetaImage(
    MetaImageFile("BinaryDataByteOrderMSB = False\nElementSpacing = 2 1.5 3\nOffset = 10 20 30\n"
                  "TransformMatrix = 0 1 0 0 0.6 0.8 1 0 0\n"));
  EXPECT_TRUE(header.Warnings.empty());
  EXPECT_TRUE(header.Geometry.ToPhysical(Eigen::Vector3d(1, 0, 0))
                .isApprox(Eigen::Vector3d(10, 22, 30), 1e-12));
  EXPECT_TRUE(header.Geometry.ToPhysical(Eigen::Vector3d(0, 2, 0))
                .isApprox(Eigen::Vector3d(10, 21.8, 32.4), 1e-12));
  EXPECT_TRUE(header.Geometry.ToPhysical(Eigen::Vector3d(0, 0, 1))
                .isApprox(Eigen::Vector3d(13, 20, 30), 1e-12));
}

TEST(MetaImageHeader, OtherNamesOfFields)
{
  const VolumeFileHeader header = ReadMetaImage(
    MetaImageFile("ElementSize = 2 2 2\nPosition = 1 2 3\nBinaryDataByteOrderMSB = True\n"));
  EXPECT_EQ(header.Geometry.Spacing, Eigen::Vector3d(2, 2, 2));
  EXPECT_EQ(header.Geometry.Origin, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(header.Storage.IsBigEndian);
}

void ExpectMetaImageRefusal(const std::string& bytes, const std::string& word)
{
  try
  {
    ReadMetaImage(bytes);
    FAIL() << "not refused: " << word;
  }
  catch (const FileProblem& problem)
  {
    EXPECT_NE(std::string(problem.what()).find(word), std::string::npos) << problem.what();
  }
}

TEST(MetaImageHeader, OneWarningSaysAllThatWasTaken)
{
  struct Field
  {
    std::string Line;
    std::string Taken;
  };
  const std::vector<Field> fields{ { "ElementSpacing = 2 2 2\n", "1 mm was taken" },
    { "TransformMatrix = 1 0 0 0 1 0 0 0 1\n", "left, posterior and superior were taken" },
    { "Offset = 1 2 3\n", "the origin was taken" },
    { "ElementByteOrderMSB = False\n", "the least significant first was taken" } };
  for (unsigned int left = 0; left < 16; ++left)
  {
    std::string lines;
    for (std::size_t index = 0; index < fields.size(); ++index)
    {
      lines += (left >> index & 1) ? "" : fields[index].Line;
    }
    const std::vector<std::string> warnings = ReadMetaImage(MetaImageFile(lines)).Warnings;
    ASSERT_EQ(warnings.size(), left ? 1 : 0);
    for (std::size_t index = 0; left && index < fields.size(); ++index)
    {
      EXPECT_EQ(warnings[0].find(fields[index].Taken) != std::string::npos,
        (left >> index & 1) == 1)
        << warnings[0];
    }
  }
  std::string bytes = MetaImageFile(fields[0].Line + fields[1].Line + fields[2].Line);
  bytes.replace(bytes.find("MET_SHORT"), 9, "MET_UCHAR"); // has no order of bytes
  EXPECT_TRUE(ReadMetaImage(bytes).Warnings.empty());
}

TEST(MetaImageHeader, NamesOfAxesAreSeen)
{
  const std::string others =
    "ElementSpacing = 2 2 2\nOffset = 1 2 3\nElementByteOrderMSB = False\n";
  const auto warnings = [&others](const std::string& names)
  { return ReadMetaImage(MetaImageFile(others + "AnatomicalOrientation = " + names)).Warnings; };
  EXPECT_TRUE(warnings("RAI\n").empty()); // which says what is taken
  ASSERT_EQ(warnings("LPS\n").size(), 1U);
  EXPECT_NE(warnings("LPS\n")[0].find("other than by names (AnatomicalOrientation)"),
    std::string::npos);
  EXPECT_TRUE(warnings("LPS\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n").empty());
}

TEST(MetaImageHeader, NegativeSpacingsAreRefused)
{
  ExpectMetaImageRefusal(MetaImageFile("ElementSpacing = 2 -2 2\n"),
    "ElementSpacing is negative, but a spacing must be positive");
  ExpectMetaImageRefusal(MetaImageFile("ElementSpacing = 2 1.9e-9 2\n"),
    "is 1.9e-09, but voxels have a size");
}

TEST(MetaImageHeader, ScaledVoxels)
{
  const VolumeFileHeader header =
    ReadMetaImage(MetaImageFile("ElementToIntensityFunctionSlope = 0.5\n"
                                "ElementToIntensityFunctionOffset = -1024\n"));
  EXPECT_EQ(header.Slope, 0.5);
  EXPECT_EQ(header.Intercept, -1024);
  EXPECT_EQ(header.ValueType(), VoxelType::Float32);
  EXPECT_FALSE(ReadMetaImage(MetaImageFile("ElementToIntensityFunctionSlope = 1\n")).IsScaled());
  ExpectMetaImageRefusal(MetaImageFile("ElementToIntensityFunctionSlope = 0\n"),
    "ElementToIntensityFunctionSlope is 0");
  ExpectMetaImageRefusal(MetaImageFile("ElementToIntensityFunctionOffset = nan\n"),
    "ElementToIntensityFunctionOffset is nan");
}

TEST(MetaImageHeader, WhereVoxelsAre)
{
  const std::string local = MetaImageFile("CompressedData = True\n");
  EXPECT_EQ(ReadMetaImage(local + "voxels").Storage.Offset, local.size());
  EXPECT_EQ(ReadMetaImage(local).Storage.Form, VoxelStorage::Coding::Deflated);
  const VoxelStorage other =
    ReadMetaImage(MetaImageFile("HeaderSize = 100\n", "image.raw")).Storage;
  EXPECT_EQ(other.Files.front(), "image.raw");
  EXPECT_EQ(other.Offset, 100);
  EXPECT_TRUE(ReadMetaImage(MetaImageFile("HeaderSize = -1\n", "image.raw")).Storage.IsAtEnd);
  ExpectMetaImageRefusal(MetaImageFile("HeaderSize = -1\nCompressedData = True\n", "image.zraw"),
    "HeaderSize is -1");
  EXPECT_EQ(ReadMetaImage(MetaImageFile("BinaryData = False\n")).Storage.Form,
    VoxelStorage::Coding::Text);
  EXPECT_EQ(ReadMetaImage(MetaImageFile("", "LIST\na.raw\nb.raw\nc.raw")).Storage.Files[2],
    "c.raw");
  EXPECT_EQ(ReadMetaImage(MetaImageFile("", "s%03d.raw 1 3")).Storage.Files[2], "s003.raw");
}

TEST(MetaImageHeader, ComponentsAreRefused)
{
  EXPECT_THROW(ReadMetaImage(MetaImageFile("ElementNumberOfChannels = 3\n")), FileProblem);
}

} // namespace
