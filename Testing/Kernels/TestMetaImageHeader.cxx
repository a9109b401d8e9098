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
  const VolumeFileHeader header =
    ReadMetaImage(MetaImageFile("ElementSpacing = 2 1.5 3\nOffset = 10 20 30\n"
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

TEST(MetaImageHeader, WithoutAVoxelSizeThereIsAWarning)
{
  EXPECT_EQ(ReadMetaImage(MetaImageFile("")).Warnings.size(), 1);
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
