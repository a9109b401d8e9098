// Headers of NIfTI and Analyze files, by their bytes: where voxels lie, and what a file says twice,
// wrongly or not at all.
#include "Exchange/NiftiHeader.h"
#include "Exchange/NiftiOrientation.h"

#include "gtest/gtest.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace
{

using namespace FlipFree;

const float NiftiNaN = std::numeric_limits<float>::quiet_NaN();

template <typename T>
std::string NiftiWith(std::string bytes, std::size_t offset, T value)
{
  return bytes.replace(offset, sizeof(value), reinterpret_cast<const char*>(&value), sizeof(value));
}

/// The sform in RAS, row by row.
std::string WithAffine(std::string bytes, int code, const Eigen::Matrix<float, 3, 4>& affine)
{
  const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> rows = affine;
  std::memcpy(&bytes[280], rows.data(), 48);
  return NiftiWith(bytes, 254, static_cast<std::int16_t>(code));
}

ImageGeometry UprightNifti()
{
  ImageGeometry grid;
  grid.Dimensions = { { 5, 4, 3 } };
  grid.Spacing = { 2, 1.5, 3 };
  grid.Origin = { -40, -150, 300 };
  return grid;
}

/// A file of shorts with both orientations set alike.
std::string UprightFile()
{
  return NiftiHeaderOf("image.nii", UprightNifti(), VoxelType::Int16);
}

VolumeFileHeader ReadNifti(const std::string& bytes)
{
  return ReadNiftiHeader("image.nii", bytes);
}

std::string NiftiWarnings(const std::string& bytes)
{
  std::string all;
  for (const std::string& warning : ReadNifti(bytes).Warnings)
  {
    all += warning + "\n";
  }
  return all;
}

void ExpectNiftiRefusal(const std::string& bytes, const std::string& word)
{
  try
  {
    ReadNifti(bytes);
    FAIL() << "not refused: " << word;
  }
  catch (const FileProblem& problem)
  {
    EXPECT_NE(std::string(problem.what()).find(word), std::string::npos) << problem.what();
    EXPECT_NE(std::string(problem.what()).find("image.nii"), std::string::npos);
  }
}

bool NiftiSays(const std::string& text, const std::string& word)
{
  return text.find(word) != std::string::npos;
}

TEST(NiftiHeader, WhatIsWrittenIsReadBack)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 300; ++trial)
  {
    ImageGeometry grid = UprightNifti();
    grid.Dimensions = { { 512, 300, 200 } };
    grid.Origin = 300 * Eigen::Vector3d(number(random), number(random), number(random));
    grid.Direction =
      Eigen::Quaterniond(number(random), number(random), number(random), number(random))
        .normalized()
        .toRotationMatrix();
    if (trial % 3 == 1) // left-handed
    {
      grid.Direction.col(1) *= -1;
    }
    const bool isSheared = trial % 3 == 2;
    if (isSheared)
    {
      grid.Direction.col(2) = (grid.Direction.col(2) + 0.3 * grid.Direction.col(1)).normalized();
    }
    const std::string bytes = NiftiHeaderOf("image.nii", grid, VoxelType::Int16);
    const VolumeFileHeader header = ReadNifti(bytes);
    EXPECT_LT(GreatestShift(header.Geometry, grid), 1e-3);
    EXPECT_EQ(header.Warnings.size(), 0);
    EXPECT_EQ(bytes.compare(252, 2, isSheared ? std::string(2, '\0') : std::string("\1\0", 2)), 0);
    if (!isSheared)
    {
      const std::string alone = NiftiWith<std::int16_t>(bytes, 254, 0);
      // Near half a turn, single precision holds a quaternion's rotation to half the digits.
      EXPECT_LT(GreatestShift(ReadNifti(alone).Geometry, grid), 1);
    }
  }
}

TEST(NiftiHeader, TheSformIsTakenAndADifferentQformIsNamed)
{
  Eigen::Matrix<float, 3, 4> affine;
  affine << -2, 0, 0, 70, 0, -1.5F, 0, 150, 0, 0, 3, 300; // 30 mm to the left of the qform
  for (const int code : { 1, 2, 4 })
  {
    const std::string bytes = WithAffine(UprightFile(), code, affine);
    EXPECT_EQ(ReadNifti(bytes).Geometry.Origin, Eigen::Vector3d(-70, -150, 300));
    EXPECT_TRUE(NiftiSays(NiftiWarnings(bytes), "up to 30 mm apart. The sform was taken"));
  }
  affine(0, 3) = 40.2F; // within half a voxel
  EXPECT_EQ(NiftiWarnings(WithAffine(UprightFile(), 1, affine)), "");
  EXPECT_EQ(ReadNifti(WithAffine(UprightFile(), 0, affine)).Geometry.Origin, UprightNifti().Origin);
}

TEST(NiftiHeader, AnSformThatCannotBeInvertedGivesWayToTheQform)
{
  Eigen::Matrix<float, 3, 4> affine;
  affine << -2, 0, 0, 70, 0, 0, 0, 150, 0, 0, 3, 300;
  for (const auto& [bytes, reason] :
    { std::make_pair(WithAffine(UprightFile(), 1, affine), "srow_y holds zeros"),
      std::make_pair(NiftiWith(UprightFile(), 280, NiftiNaN), "srow_x[0] is nan"),
      std::make_pair(NiftiWith(UprightFile(), 292, 2e9F), "srow_x[3] is 2e+09, beyond 1e+09 mm") })
  {
    EXPECT_LT(GreatestShift(ReadNifti(bytes).Geometry, UprightNifti()), 1e-4);
    EXPECT_TRUE(NiftiSays(NiftiWarnings(bytes),
      std::string("The sform of 'image.nii' cannot be used: ") + reason))
      << NiftiWarnings(bytes);
  }
  const std::string alone = NiftiWith<std::int16_t>(WithAffine(UprightFile(), 1, affine), 252, 0);
  ExpectNiftiRefusal(alone, "srow_y holds zeros");
  affine << -2, -2, 0, 0, 1, 1, 0, 0, 0, 0, 3, 0;
  ExpectNiftiRefusal(NiftiWith<std::int16_t>(WithAffine(UprightFile(), 1, affine), 252, 0),
    "cannot be inverted");
}

TEST(NiftiHeader, WhatTheSformDoesNotNeedIsNotJudged)
{
  for (const std::size_t offset : { 76, 256, 264, 268, 276 }) // pixdim[0], quaternion, qoffset
  {
    EXPECT_LT(
      GreatestShift(ReadNifti(NiftiWith(UprightFile(), offset, NiftiNaN)).Geometry, UprightNifti()),
      1e-4);
  }
  EXPECT_EQ(NiftiWarnings(NiftiWith(UprightFile(), 92, NiftiNaN)), ""); // repetition time
}

TEST(NiftiHeader, VoxelSizesBesideTheSform)
{
  for (const std::size_t axis : { 0, 1, 2 })
  {
    for (const float size : { 2.2F, 0.F, -2.F, NiftiNaN })
    {
      const std::string bytes = NiftiWith(UprightFile(), 80 + 4 * axis, size);
      EXPECT_EQ(ReadNifti(bytes).Geometry.Spacing, UprightNifti().Spacing);
      EXPECT_TRUE(NiftiSays(NiftiWarnings(bytes), "two voxel sizes")) << size;
    }
  }
  // Rounded entries of a matrix: the size beside it is exact.
  Eigen::Matrix<float, 3, 4> affine;
  affine << -2.000001F, 0, 0, 40, 0, -1.5F, 0, 150, 0, 0, 3, 300;
  const VolumeFileHeader header = ReadNifti(WithAffine(UprightFile(), 1, affine));
  EXPECT_EQ(header.Geometry.Spacing, UprightNifti().Spacing);
  EXPECT_TRUE(header.Warnings.empty());
  // Of a tilted gantry: the distance between slices, or how far one is from the next.
  affine << -2, 0, 0, 40, 0, -1.5F, 0.9F, 150, 0, 0, 3, 300;
  const std::string tilted = WithAffine(UprightFile(), 1, affine);
  for (const double size : { 3.0, std::hypot(3.0, 0.9) })
  {
    const std::string bytes = NiftiWith(tilted, 88, static_cast<float>(size));
    EXPECT_NEAR(ReadNifti(bytes).Geometry.Spacing[2], std::hypot(3.0, 0.9), 1e-6);
    EXPECT_EQ(NiftiWarnings(bytes).find("two voxel sizes"), std::string::npos) << size;
  }
  EXPECT_TRUE(NiftiSays(NiftiWarnings(NiftiWith(tilted, 88, 3.05F)), "two voxel sizes"));
}

TEST(NiftiHeader, QuaternionsThatRoundingMadeTooLong)
{
  std::string bytes = NiftiWith<std::int16_t>(UprightFile(), 254, 0);
  bytes = NiftiWith(NiftiWith(NiftiWith(bytes, 256, 0.70711F), 260, 0.70711F), 264, 0.F);
  const Eigen::Matrix3d product =
    ReadNifti(bytes).Geometry.Direction.transpose() * ReadNifti(bytes).Geometry.Direction;
  EXPECT_TRUE(product.isIdentity(1e-12));
  ExpectNiftiRefusal(NiftiWith(bytes, 264, 0.9F), "no rotation");
}

TEST(NiftiHeader, UnitsHoldForSizesAndPlaces)
{
  for (const auto& [code, length] : { std::pair(1, 1e-3F), std::pair(3, 1e3F), std::pair(0, 1.F) })
  {
    std::string bytes = NiftiWith(UprightFile(), 123, static_cast<char>(code | 8)); // seconds, too
    for (const std::size_t field : { 80, 84, 88, 268, 272, 276 })
    {
      float value = 0;
      std::memcpy(&value, &bytes[field], 4);
      bytes = NiftiWith(bytes, field, value * length);
    }
    for (std::size_t entry = 0; entry < 12; ++entry)
    {
      float value = 0;
      std::memcpy(&value, &bytes[280 + 4 * entry], 4);
      bytes = NiftiWith(bytes, 280 + 4 * entry, value * length);
    }
    EXPECT_LT(GreatestShift(ReadNifti(bytes).Geometry, UprightNifti()), 1e-4) << code;
    EXPECT_EQ(NiftiWarnings(bytes), "");
    const std::string qform = NiftiWith<std::int16_t>(bytes, 254, 0);
    EXPECT_LT(GreatestShift(ReadNifti(qform).Geometry, UprightNifti()), 1e-4) << code;
  }
}

TEST(NiftiHeader, WithoutAnOrientationThereIsAWarning)
{
  const std::string bytes =
    NiftiWith<std::int16_t>(NiftiWith<std::int16_t>(UprightFile(), 252, 0), 254, 0);
  EXPECT_TRUE(NiftiSays(NiftiWarnings(bytes), "neither a qform nor an sform"));
  EXPECT_EQ(ReadNifti(bytes).Geometry.Spacing, UprightNifti().Spacing);
  EXPECT_EQ(ReadNifti(bytes).Geometry.Direction.diagonal(), Eigen::Vector3d(-1, -1, 1));
  std::string analyze = UprightFile();
  analyze.replace(344, 3, 3, '\0');
  EXPECT_TRUE(NiftiSays(NiftiWarnings(analyze), "Analyze"));
  EXPECT_EQ(ReadNifti(analyze).Storage.Files.front(), "image.img");
}

TEST(NiftiHeader, ScalesThatMeanNone)
{
  const auto scaleOf = [](float slope, float intercept)
  { return ReadNifti(NiftiWith(NiftiWith(UprightFile(), 112, slope), 116, intercept)); };
  EXPECT_FALSE(scaleOf(0, 5).IsScaled());
  EXPECT_FALSE(scaleOf(NiftiNaN, 5).IsScaled());
  EXPECT_FALSE(scaleOf(1, 0).IsScaled());
  EXPECT_EQ(scaleOf(2, -1024).Intercept, -1024);
  EXPECT_EQ(scaleOf(2, -1024).ValueType(), VoxelType::Float32);
  ExpectNiftiRefusal(NiftiWith(NiftiWith(UprightFile(), 112, 2.F), 116, NiftiNaN), "scl_inter");
}

TEST(NiftiHeader, AScaleThatAnalyzeDoesNotHaveIsAWarning)
{
  std::string analyze = UprightFile();
  analyze.replace(344, 3, 3, '\0');
  for (const float none : { 0.F, 1.F, NiftiNaN })
  {
    EXPECT_FALSE(NiftiSays(NiftiWarnings(NiftiWith(analyze, 112, none)), "scale"));
  }
  const std::string scaled = NiftiWith(analyze, 112, 0.5F);
  EXPECT_TRUE(NiftiSays(NiftiWarnings(scaled), "the scale 0.5, as SPM writes it"));
  EXPECT_FALSE(ReadNifti(scaled).IsScaled());
}

TEST(NiftiHeader, VoxelsNeverBeginWithinTheHeader)
{
  for (const float offset : { 0.F, 348.F, 352.F })
  {
    EXPECT_EQ(ReadNifti(NiftiWith(UprightFile(), 108, offset)).Storage.Offset, 352);
  }
  EXPECT_EQ(ReadNifti(NiftiWith(UprightFile(), 108, 1000.F)).Storage.Offset, 1000);
  ExpectNiftiRefusal(NiftiWith(UprightFile(), 108, -8.F), "vox_offset");
  ExpectNiftiRefusal(NiftiWith(UprightFile(), 108, NiftiNaN), "vox_offset");
}

TEST(NiftiHeader, TheOtherByteOrder)
{
  std::string bytes = UprightFile();
  const auto reverse = [&bytes](std::size_t begin, std::size_t size, std::size_t count)
  {
    for (std::size_t field = 0; field < count; ++field)
    {
      std::reverse(&bytes[begin + field * size], &bytes[begin + field * size] + size);
    }
  };
  reverse(0, 4, 1);
  reverse(40, 2, 8);
  reverse(70, 2, 2);
  reverse(76, 4, 11);
  reverse(252, 2, 2);
  reverse(256, 4, 18);
  const VolumeFileHeader header = ReadNifti(bytes);
  EXPECT_NE(header.Storage.IsBigEndian, ReadNifti(UprightFile()).Storage.IsBigEndian);
  EXPECT_LT(GreatestShift(header.Geometry, UprightNifti()), 1e-4);
  EXPECT_EQ(header.Storage.Offset, 352);
}

TEST(NiftiHeader, TheSecondVersion)
{
  std::string bytes(544, '\0');
  bytes = NiftiWith<std::int32_t>(bytes, 0, 540);
  bytes.replace(4, 8, std::string("n+2\0\r\n\x1A\n", 8));
  bytes = NiftiWith<std::int16_t>(bytes, 12, 16); // float
  const std::int64_t sizes[] = { 3, 5, 4, 3, 1, 1, 1, 1 };
  std::memcpy(&bytes[16], sizes, sizeof(sizes));
  const double spacing[] = { 1, 2, 1.5, 3 };
  std::memcpy(&bytes[104], spacing, sizeof(spacing));
  bytes = NiftiWith<std::int64_t>(bytes, 168, 544);
  const double affine[] = { -2, 0, 0, 40, 0, -1.5, 0, 150, 0, 0, 3, 300 };
  std::memcpy(&bytes[400], affine, sizeof(affine));
  bytes = NiftiWith<std::int32_t>(bytes, 348, 1); // sform_code
  bytes = NiftiWith<std::int32_t>(bytes, 500, 2); // millimeters
  const VolumeFileHeader header = ReadNifti(bytes);
  EXPECT_LT(GreatestShift(header.Geometry, UprightNifti()), 1e-12);
  EXPECT_EQ(header.Storage.Type, VoxelType::Float32);
  EXPECT_EQ(header.Storage.Offset, 544);
  ExpectNiftiRefusal(bytes.substr(0, 500), "540 bytes");
  ExpectNiftiRefusal(NiftiWith<std::int64_t>(bytes, 24, std::int64_t(1) << 40), "dim[1]");
}

TEST(NiftiHeader, WhatIsNoVolumeOfNumbers)
{
  ExpectNiftiRefusal(NiftiWith<std::int16_t>(UprightFile(), 70, 128), "3 components");
  ExpectNiftiRefusal(NiftiWith<std::int16_t>(UprightFile(), 70, 1536), "datatype");
  ExpectNiftiRefusal(NiftiWith<std::int16_t>(UprightFile(), 40, 2), "2 dimensions (5 x 4)");
  const std::string series =
    NiftiWith<std::int16_t>(NiftiWith<std::int16_t>(UprightFile(), 40, 4), 48, 7);
  ExpectNiftiRefusal(series, "4 dimensions (5 x 4 x 3 x 7)");
  EXPECT_NO_THROW(ReadNifti(NiftiWith<std::int16_t>(series, 48, 0)));
}

TEST(NiftiHeader, MoreVoxelsThanTheFormatCanNumber)
{
  ImageGeometry grid = UprightNifti();
  grid.Dimensions[1] = 32768;
  EXPECT_THROW(NiftiHeaderOf("image.nii", grid, VoxelType::UInt8), FileProblem);
}

} // namespace

// As TotalSegmentator and the Connectome Workbench write it.
TEST(NiftiHeader, NamesLabelsByATable)
{
  const std::string xml =
    "<?xml version=\"1.0\"?><CaretExtension><LabelTable>"
    "<Label Key=\"0\" Red=\"0\"><![CDATA[???]]></Label>\n"
    "<Label Key=\"5\" Red=\"1\" Alpha=\"1\"><![CDATA[liver <left>]]></Label>\n"
    "<Label Red=\"1\" Key=\"70000\">A &amp; B</Label>"
    "<Label Key=\"x\">none</Label><Label Key=\"6\">cut off";
  std::string bytes = UprightFile();
  const auto withExtension = [&](std::int32_t size, const std::string& text)
  {
    std::string extended = NiftiWith(bytes, 348, char(1));
    std::string prefix(8, '\0');
    prefix = NiftiWith(prefix, 0, size);
    extended += prefix + text;
    return NiftiWith(extended, 108, static_cast<float>(extended.size()));
  };
  const std::map<int, std::string> expected{ { 5, "liver <left>" }, { 70000, "A & B" } };
  const auto size = static_cast<std::int32_t>(xml.size() + 8);
  EXPECT_EQ(ReadNifti(withExtension(size, xml)).LabelNames, expected);
  // Sizes that cannot be, other extensions, and none.
  for (const std::int32_t wrong : { 0, -16, 7, size + 1, std::numeric_limits<std::int32_t>::max() })
  {
    EXPECT_TRUE(ReadNifti(withExtension(wrong, xml)).LabelNames.empty()) << wrong;
  }
  EXPECT_TRUE(ReadNifti(withExtension(16, "dicom...")).LabelNames.empty());
  EXPECT_TRUE(ReadNifti(bytes).LabelNames.empty());
}
