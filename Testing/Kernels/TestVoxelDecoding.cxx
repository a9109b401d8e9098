// Voxels as files store them.
#include "Exchange/VoxelDecoding.h"

#include "gtest/gtest.h"

#include <vector>

namespace
{

using namespace FlipFree;

VolumeFileHeader HeaderOfVoxels(VoxelType type, int voxels)
{
  VolumeFileHeader header;
  header.Name = "image.nrrd";
  header.Geometry.Dimensions = { { voxels, 1, 1 } };
  header.Storage.Type = type;
  return header;
}

TEST(VoxelDecoding, OfEitherByteOrder)
{
  const unsigned char bytes[] = { 0x01, 0x02, 0xFF, 0xFE };
  VolumeFileHeader header = HeaderOfVoxels(VoxelType::Int16, 2);
  std::int16_t values[2];
  DecodeVoxels(header, bytes, 2, values);
  EXPECT_EQ(values[0], 0x0201);
  EXPECT_EQ(values[1], -257);
  header.Storage.IsBigEndian = true;
  DecodeVoxels(header, bytes, 2, values);
  EXPECT_EQ(values[0], 0x0102);
  EXPECT_EQ(values[1], -2);
  DecodeVoxels(header, values, 2, values); // in place
  EXPECT_EQ(values[0], 0x0201);
}

TEST(VoxelDecoding, ScaledValuesHaveFractions)
{
  VolumeFileHeader header = HeaderOfVoxels(VoxelType::UInt16, 2);
  header.Slope = 0.25;
  header.Intercept = -1024;
  const std::uint16_t stored[] = { 4097, 65535 };
  ASSERT_EQ(header.ValueType(), VoxelType::Float32);
  float values[2];
  DecodeVoxels(header, stored, 2, values);
  EXPECT_EQ(values[0], 0.25F);
  EXPECT_EQ(values[1], 15359.75F);

  header.Storage.Type = VoxelType::Int32; // more digits than single precision has
  ASSERT_EQ(header.ValueType(), VoxelType::Float64);
  const std::int32_t large[] = { 1 << 30, -7 };
  double exact[2];
  DecodeVoxels(header, large, 2, exact);
  EXPECT_EQ(exact[0], (1 << 28) - 1024);
}

TEST(VoxelDecoding, Digits)
{
  VolumeFileHeader header = HeaderOfVoxels(VoxelType::UInt8, 3);
  header.Storage.Form = VoxelStorage::Coding::Text;
  std::uint8_t values[3];
  DecodeDigits(header, "1 20,\n255 ", values);
  EXPECT_EQ(values[2], 255);
  EXPECT_THROW(DecodeDigits(header, "1 20", values), FileProblem);
  header.Slope = 0.5;
  float scaled[3];
  DecodeDigits(header, "1 20 255", scaled);
  EXPECT_EQ(scaled[2], 127.5F);
  header.Slope = 1;
  EXPECT_THROW(DecodeDigits(header, "1 20 256", values), FileProblem);
  EXPECT_THROW(DecodeDigits(header, "1 20 2.5", values), FileProblem);
  EXPECT_THROW(DecodeDigits(header, "1 20 " + std::string(500, '7'), values), FileProblem);

  header.Storage.Form = VoxelStorage::Coding::Hex;
  DecodeDigits(header, "01 fF\n1 0", values);
  EXPECT_EQ(values[1], 255);
  EXPECT_EQ(values[2], 16);
  EXPECT_THROW(DecodeDigits(header, "01ff", values), FileProblem);
  EXPECT_THROW(DecodeDigits(header, "01ffxx", values), FileProblem);
}

TEST(VoxelDecoding, FilesThatAreMissingOrTooSmall)
{
  VolumeFileHeader header = HeaderOfVoxels(VoxelType::Int16, 100);
  header.Storage.Files = { "a.raw" };
  EXPECT_NO_THROW(RequireFiles(header, { 200 }));
  const auto reason = [&header](const std::vector<double>& sizes)
  {
    try
    {
      RequireFiles(header, sizes);
    }
    catch (const FileProblem& problem)
    {
      return std::string(problem.what());
    }
    return std::string();
  };
  EXPECT_NE(reason({ 199 }).find("'a.raw' holds fewer voxels"), std::string::npos);
  EXPECT_NE(reason({ MissingFile }).find("There is no file 'a.raw', which has the voxels of"),
    std::string::npos);
  EXPECT_NE(reason({ IrregularFile }).find("not a regular file"), std::string::npos);
  header.Storage.Files = { "caf\xE9.raw" }; // in Latin-1; messages are in UTF-8
  EXPECT_NE(reason({ MissingFile }).find("no file 'caf\xC3\xA9.raw'"), std::string::npos);
  header.Storage.Files = { "a.raw", "b.raw", "c.raw" };
  EXPECT_NE(reason({ 100, 100, 100 }).find("3 files"), std::string::npos);
  header.Storage.Files = { "image.nii.gz" };
  header.Storage.MayBePacked = true;
  TakePacked(header.Storage);
  EXPECT_NO_THROW(RequireFiles(header, { 20 }));
  EXPECT_NE(reason({ 0 }).find("fewer voxels"), std::string::npos);
}

} // namespace
