// What a DICOM file says, in every coding, and cut off or damaged anywhere.
#include "Exchange/DicomDataSet.h"
#include "Exchange/DicomPixels.h"

#include "ExampleDicom.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using namespace FlipFree;
using ExampleDicom::Coding;

DicomDataSet Parsed(const std::string& bytes)
{
  std::istringstream stream(bytes);
  return ReadDicomDataSet(stream);
}

std::vector<int> Counting(int first, int count)
{
  std::vector<int> values;
  for (int value = 0; value < count; ++value)
  {
    values.push_back(first + value);
  }
  return values;
}

ExampleDicom::Options SliceOptions(Coding how = Coding::Explicit)
{
  ExampleDicom::Options options;
  options.How = how;
  options.Pixels = ExampleDicom::Shorts(Counting(-5, 12), how == Coding::BigEndian);
  return options;
}

std::vector<std::int16_t> VoxelsOf(const std::string& bytes, std::size_t frame = 0)
{
  std::istringstream stream(bytes);
  const DicomDataSet data = ReadDicomDataSet(stream);
  const std::string stored = ReadStoredFrame(stream, data, frame);
  const DicomPixelFormat format = PixelFormatOf(data);
  std::vector<std::int16_t> voxels(format.NumberOfPixels());
  if (stored.size() != format.BytesPerFrame())
  {
    return {};
  }
  ToVoxels(stored.data(), format, {}, VoxelType::Int16, voxels.data());
  return voxels;
}

void ExpectTheSlice(const std::string& bytes)
{
  const DicomDataSet data = Parsed(bytes);
  EXPECT_TRUE(data.IsDicom);
  EXPECT_EQ(data.Damage, "");
  EXPECT_EQ(data.Attributes.Text(DicomTag::SeriesInstanceUID), SliceOptions().Series);
  EXPECT_EQ(data.Attributes.Text(DicomTag::Modality), "CT");
  EXPECT_EQ(data.Attributes.Numbers(DicomTag::PixelSpacing), (std::vector<double>{ 2, 1 }));
  EXPECT_EQ(data.Attributes.Integer(DicomTag::Columns, 0, 9, 0), 4);
  EXPECT_TRUE(data.HasPixels);
  const std::vector<std::int16_t> voxels = VoxelsOf(bytes);
  ASSERT_EQ(voxels.size(), 12U);
  EXPECT_EQ(voxels.front(), -5);
  EXPECT_EQ(voxels.back(), 6);
}

TEST(DicomDataSet, InEveryCodingWithAndWithoutHeader)
{
  const auto slice = [](Coding how) { return ExampleDicom::Slice(SliceOptions(how)); };
  ExpectTheSlice(ExampleDicom::FileOf(slice(Coding::Explicit)));
  ExpectTheSlice(ExampleDicom::FileOf(slice(Coding::Implicit), "1.2.840.10008.1.2"));
  ExpectTheSlice(ExampleDicom::FileOf(slice(Coding::BigEndian), "1.2.840.10008.1.2.2"));
  // Neither preamble nor group 2; group 2 alone; a preamble alone.
  for (const Coding how : { Coding::Explicit, Coding::Implicit, Coding::BigEndian })
  {
    ExpectTheSlice(slice(how).Bytes);
  }
  ExpectTheSlice(ExampleDicom::FileOf(slice(Coding::Explicit)).substr(132));
  ExpectTheSlice(std::string(128, '\0') + "DICM" + slice(Coding::Implicit).Bytes);
  // A header that lies about the coding.
  ExpectTheSlice(ExampleDicom::FileOf(slice(Coding::Explicit), "1.2.840.10008.1.2"));
}

TEST(DicomDataSet, PaddingBehindThePixels)
{
  const std::string bytes = ExampleDicom::FileOf(ExampleDicom::Slice(SliceOptions()));
  ExpectTheSlice(bytes + std::string(3, '\0'));
  ExpectTheSlice(bytes + std::string(1000, '\0'));
}

TEST(DicomDataSet, SequencesOfOthersAreNotMistaken)
{
  // A private sequence that holds another series and other rows, in all its forms.
  ExampleDicom::DataSet inner;
  inner.Add(0x0020000E, "UI", "9.9.9").AddShort(0x00280010, 77);
  for (const bool isDelimited : { false, true })
  {
    ExampleDicom::DataSet data;
    data.Add(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
    data.AddSequence(0x00081140, { inner, inner }, isDelimited);
    data.AddBytes(ExampleDicom::Slice(SliceOptions()).Bytes);
    ExpectTheSlice(ExampleDicom::FileOf(data));
  }
  // Of unknown type and length, it is coded implicitly.
  ExampleDicom::DataSet implicit(Coding::Implicit);
  implicit.Add(0x0020000E, "UI", "9.9.9");
  ExampleDicom::DataSet content(Coding::Implicit);
  content.AddSequence(0x00081140, { implicit }, true);
  ExampleDicom::DataSet data;
  data.AddHeader(0x00081140, "UN", 0xFFFFFFFF).AddBytes(content.Bytes.substr(8));
  data.AddBytes(ExampleDicom::Slice(SliceOptions()).Bytes);
  ExpectTheSlice(ExampleDicom::FileOf(data));
}

TEST(DicomDataSet, CompressedPixelsOfAnIcon)
{
  ExampleDicom::DataSet icon;
  icon.AddShort(0x00280010, 77).AddFragments({ "", "half", std::string(5000, '\x05') });
  for (const bool isDelimited : { false, true })
  {
    ExampleDicom::DataSet data;
    data.Add(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
    data.AddSequence(0x00880200, { icon }, isDelimited);
    data.AddBytes(ExampleDicom::Slice(SliceOptions()).Bytes);
    ExpectTheSlice(ExampleDicom::FileOf(data));
  }
}

TEST(DicomDataSet, NoMoreFramesThanAnyScannerMakes)
{
  ExampleDicom::DataSet data;
  data.Add(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2.1");
  data.AddSequence(0x52009230, std::vector<ExampleDicom::DataSet>(MostDicomFrames + 1));
  const DicomDataSet parsed = Parsed(ExampleDicom::FileOf(data));
  EXPECT_NE(parsed.Damage.find("more than 100000 frames"), std::string::npos) << parsed.Damage;
  EXPECT_EQ(parsed.Frames.size(), MostDicomFrames);
}

TEST(DicomDataSet, FunctionalGroupsOfEachFrame)
{
  for (const Coding how : { Coding::Explicit, Coding::Implicit, Coding::BigEndian })
  {
    for (const bool isDelimited : { false, true })
    {
      ExampleDicom::Options options = SliceOptions(how);
      options.Pixels += options.Pixels;
      const DicomDataSet data = Parsed(ExampleDicom::Enhanced(options,
        { { R"(0\0\0)", "1", 1, "", "" }, { R"(0\0\3)", "1", 2, "2", "-7" } }, isDelimited)
                                         .Bytes);
      ASSERT_EQ(data.Damage, "");
      ASSERT_EQ(data.Frames.size(), 2U);
      EXPECT_EQ(data.NumbersOf(DicomTag::ImagePositionPatient, 1),
        (std::vector<double>{ 0, 0, 3 }));
      EXPECT_EQ(data.TextOf(DicomTag::TemporalPositionIndex, 1), "2");
      EXPECT_EQ(data.NumbersOf(DicomTag::PixelSpacing, 0), (std::vector<double>{ 2, 1 }));
      EXPECT_EQ(data.TextOf(DicomTag::RescaleIntercept, 0), "0");
      EXPECT_EQ(data.TextOf(DicomTag::RescaleIntercept, 1), "-7");
    }
  }
}

TEST(DicomDataSet, CutOffAnywhere)
{
  const std::string bytes = ExampleDicom::FileOf(ExampleDicom::Slice(SliceOptions()));
  for (std::size_t size = 132; size < bytes.size(); ++size)
  {
    SCOPED_TRACE(size);
    const DicomDataSet data = Parsed(bytes.substr(0, size));
    EXPECT_TRUE(data.IsDicom);
    EXPECT_TRUE(!data.Damage.empty() || !data.HasPixels);
  }
}

TEST(DicomDataSet, NeverMoreThanTheFileHolds)
{
  std::vector<std::string> originals;
  originals.push_back(ExampleDicom::FileOf(ExampleDicom::Slice(SliceOptions())));
  for (const bool isDelimited : { false, true })
  {
    ExampleDicom::Options options = SliceOptions();
    options.Pixels += options.Pixels;
    originals.push_back(ExampleDicom::FileOf(
      ExampleDicom::Enhanced(options, { { R"(0\0\0)" }, { R"(0\0\3)" } }, isDelimited)));
  }
  std::mt19937 random(5);
  for (int attempt = 0; attempt < 3000; ++attempt)
  {
    std::string bytes = originals[static_cast<std::size_t>(attempt) % originals.size()];
    for (int change = 0; change < 4; ++change)
    {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 3 ? random() : 0xFF);
    }
    std::istringstream stream(bytes);
    const DicomDataSet data = ReadDicomDataSet(stream);
    if (data.Damage.empty() && data.HasPixels && WhyNotGray(data).empty() &&
      WhyPixelsAreIncomplete(data).empty())
    {
      EXPECT_EQ(ReadStoredFrame(stream, data, 0).size(), PixelFormatOf(data).BytesPerFrame());
    }
  }
}

TEST(DicomDataSet, NestedWithoutEnd)
{
  ExampleDicom::DataSet data;
  data.Add(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  for (int depth = 0; depth < 100000; ++depth)
  {
    data.AddHeader(0x00081140, "SQ", 0xFFFFFFFF);
    data.AddBytes(std::string("\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 8));
  }
  EXPECT_NE(Parsed(ExampleDicom::FileOf(data)).Damage.find("nested"), std::string::npos);
}

TEST(DicomDataSet, OtherFilesAreNoDicom)
{
  EXPECT_FALSE(Parsed("").IsDicom);
  EXPECT_FALSE(Parsed(std::string(300, 'n')).IsDicom);
  EXPECT_FALSE(Parsed(std::string(5000, '\0')).IsDicom);
  EXPECT_FALSE(Parsed("NRRD0004\ntype: short\n").IsDicom);
}

TEST(DicomDataSet, NumbersWithACommaAreNone)
{
  DicomAttributes attributes;
  attributes.Add(1, R"(0,5\0,5)");
  attributes.Add(2, R"( 0.5 \ 1e-1 )");
  attributes.Add(3, "nan");
  EXPECT_TRUE(attributes.Numbers(1).empty());
  EXPECT_EQ(attributes.Numbers(2), (std::vector<double>{ 0.5, 0.1 }));
  EXPECT_TRUE(attributes.Numbers(3).empty());
}

TEST(DicomDataSet, TextForPeople)
{
  DicomAttributes latin;
  latin.Add(DicomTag::SpecificCharacterSet, "ISO_IR 100");
  latin.Add(DicomTag::SeriesDescription,
    "Sch\xE4"
    "del\n");
  EXPECT_EQ(DicomTextForPeople(latin, DicomTag::SeriesDescription),
    "Sch\xC3\xA4"
    "del ");
  DicomAttributes broken;
  broken.Add(DicomTag::SpecificCharacterSet, "ISO_IR 192");
  broken.Add(DicomTag::SeriesDescription, "a\xC3");
  EXPECT_EQ(DicomTextForPeople(broken, DicomTag::SeriesDescription), "a?");
}

} // namespace
