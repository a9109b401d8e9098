// From stored pixels to gray values: bits, signs, rescale, types, run lengths.
#include "Exchange/DicomCodestream.h"
#include "Exchange/DicomPixels.h"

#include "ExampleDicom.h"

#include <gtest/gtest.h>

#include <array>

namespace
{

using namespace FlipFree;

DicomPixelFormat Format(int allocated, int stored, int high, bool isSigned, int columns = 4)
{
  DicomPixelFormat format;
  format.Columns = columns;
  format.Rows = 1;
  format.BitsAllocated = allocated;
  format.BitsStored = stored;
  format.HighBit = high;
  format.IsSigned = isSigned;
  return format;
}

TEST(DicomPixels, BitsBeyondTheStoredOnesDoNotCount)
{
  // 12 bits of 16, with something else in the others: at the bottom, and at the top.
  const std::string low = ExampleDicom::Shorts({ 0xF001, 0x0FFF, 0xA800, 0x07FF });
  const std::string high = ExampleDicom::Shorts({ 0x001F, 0xFFF3, 0x800A, 0x7FF0 });
  std::array<std::int16_t, 4> voxels{};
  for (const auto& [bytes, highBit] : { std::make_pair(low, 11), std::make_pair(high, 15) })
  {
    ToVoxels(bytes.data(), Format(16, 12, highBit, true), {}, VoxelType::Int16, voxels.data());
    EXPECT_EQ(voxels, (std::array<std::int16_t, 4>{ 1, -1, -2048, 2047 }));
    ToVoxels(bytes.data(), Format(16, 12, highBit, false), {}, VoxelType::Int16, voxels.data());
    EXPECT_EQ(voxels, (std::array<std::int16_t, 4>{ 1, 4095, 2048, 2047 }));
  }
}

TEST(DicomPixels, TheLeastTypeThatHoldsAllValues)
{
  using Rescale = std::pair<double, double>;
  const auto types = [](int stored, bool isSigned, const std::vector<Rescale>& rescales)
  {
    DicomValueRange range;
    for (const auto& [slope, intercept] : rescales)
    {
      range.Add(Format(stored > 16 ? 32 : 16, stored, stored - 1, isSigned), { slope, intercept });
    }
    return range.Type();
  };
  const auto type = [&types](int stored, bool isSigned, double slope, double intercept) {
    return types(stored, isSigned, { { slope, intercept } });
  };
  EXPECT_EQ(type(8, false, 1, 0), VoxelType::UInt8);
  EXPECT_EQ(type(12, false, 1, 0), VoxelType::UInt16);
  EXPECT_EQ(type(12, false, 1, -1024), VoxelType::Int16);
  EXPECT_EQ(type(16, true, 1, 0), VoxelType::Int16);
  EXPECT_EQ(type(16, false, 1, -1024), VoxelType::Int32);
  EXPECT_EQ(type(12, false, 0.5, 0), VoxelType::Float32);
  EXPECT_EQ(type(12, false, 1, 0.5), VoxelType::Float32);
  EXPECT_EQ(type(32, false, 1e-4, 0), VoxelType::Float64);
  EXPECT_EQ(type(32, false, 1, -1), VoxelType::Float64);
  EXPECT_EQ(types(16, false, { { 1, 0 }, { 1, -1 } }), VoxelType::Int32);
  EXPECT_EQ(types(16, true, { { 4, 0 }, { 0.5, 0 } }), VoxelType::Float32);
}

TEST(DicomPixels, RescaleIsApplied)
{
  const std::string bytes = ExampleDicom::Shorts({ 0, 1, 2, 4000 });
  std::array<float, 4> voxels{};
  ToVoxels(bytes.data(), Format(16, 12, 11, false), { 0.25, -3 }, VoxelType::Float32,
    voxels.data());
  EXPECT_EQ(voxels, (std::array<float, 4>{ -3, -2.75F, -2.5F, 997 }));
}

TEST(DicomPixels, RunLengthsOfEachFrame)
{
  // Two planes of bytes, the high ones first: a run and a copy in each. The second frame is split
  // into two fragments, so that only the table of offsets tells where it begins.
  const auto header = [](int second)
  {
    std::string bytes(64, '\0');
    bytes[0] = 2;
    bytes[4] = 64;
    bytes[8] = static_cast<char>(second);
    return bytes;
  };
  const std::string high("\xFD\x01", 2);            // 1 1 1 1
  const std::string low("\xFF\x05\x01\x06\x07", 5); // 5 5 6 7
  const std::string frame = header(66) + high + low + std::string(1, '\0');
  ExampleDicom::Options options;
  options.Columns = 4;
  options.Rows = 1;
  options.Frames = "2";
  options.IsSigned = 0;
  std::string table(8, '\0');
  table[4] = static_cast<char>(frame.size() + 8);
  options.Fragments = { table, frame, frame.substr(0, 70), frame.substr(70) };
  const std::string syntax = "1.2.840.10008.1.2.5";
  std::istringstream stream(ExampleDicom::FileOf(ExampleDicom::Slice(options), syntax));
  const DicomDataSet data = ReadDicomDataSet(stream);
  ASSERT_EQ(data.Damage, "");
  ASSERT_EQ(WhyPixelsAreIncomplete(data), "");
  ASSERT_TRUE(IsReadDirectly(data));
  for (const std::size_t number : { 0U, 1U })
  {
    EXPECT_EQ(ReadStoredFrame(stream, data, number),
      ExampleDicom::Shorts({ 0x105, 0x105, 0x106, 0x107 }));
  }
  // Cut off, it is nothing.
  options.Fragments = { "", frame.substr(0, 68), frame.substr(0, 10) };
  std::istringstream damaged(ExampleDicom::FileOf(ExampleDicom::Slice(options), syntax));
  const DicomDataSet short1 = ReadDicomDataSet(damaged);
  EXPECT_EQ(ReadStoredFrame(damaged, short1, 0), "");
  EXPECT_EQ(ReadStoredFrame(damaged, short1, 1), "");
}

/// Lossless JPEG up to its scan, whose data are `rest`.
std::string JpegOf(int columns, int rows, int bits, const std::string& rest)
{
  const auto byte = [](int number) { return static_cast<char>(number); };
  const std::string table("\xFF\xC4\x00\x04\x00\x00", 6);
  std::string frame("\xFF\xC3\x00\x0B", 4);
  frame +=
    { byte(bits), byte(rows >> 8), byte(rows), byte(columns >> 8), byte(columns), 1, 1, 0x11, 0 };
  const std::string scan("\xFF\xDA\x00\x08\x01\x01\x00\x01\x00\x00", 10);
  return "\xFF\xD8" + table + frame + scan + rest;
}

TEST(DicomPixels, AMinimalFileHasTheSamePixelsAndNothingElse)
{
  ExampleDicom::Options options;
  options.Frames = "2";
  options.Fragments = { "", JpegOf(4, 3, 16, "ab"), JpegOf(4, 3, 12, "cdef") };
  const std::string syntax = "1.2.840.10008.1.2.4.70";
  std::istringstream stream(ExampleDicom::FileOf(ExampleDicom::Slice(options), syntax));
  const DicomDataSet data = ReadDicomDataSet(stream);
  EXPECT_FALSE(IsReadDirectly(data));
  std::istringstream minimal(MinimalDicomFile(stream, data));
  const DicomDataSet clean = ReadDicomDataSet(minimal);
  EXPECT_EQ(clean.Damage, "");
  EXPECT_EQ(clean.TransferSyntax, syntax);
  EXPECT_FALSE(clean.Attributes.Has(DicomTag::SeriesInstanceUID));
  for (const std::size_t frame : { 0U, 1U })
  {
    const std::string coded = ReadCodedFrame(minimal, clean, frame);
    EXPECT_EQ(coded.substr(0, options.Fragments[frame + 1].size()), options.Fragments[frame + 1]);
  }
  // Of another size than the file says: no decoder gets to see it.
  options.Fragments[2] = JpegOf(5, 3, 16, "cdef");
  std::istringstream other(ExampleDicom::FileOf(ExampleDicom::Slice(options), syntax));
  EXPECT_EQ(MinimalDicomFile(other, ReadDicomDataSet(other)), "");
}

TEST(DicomPixels, CodestreamsOfTheFilesOwnSize)
{
  const std::string lossless = "1.2.840.10008.1.2.4.70";
  const DicomPixelFormat format = [&]
  {
    DicomPixelFormat made = Format(16, 12, 11, false);
    made.Rows = 3;
    return made;
  }();
  const std::string good = JpegOf(4, 3, 12, "data");
  EXPECT_TRUE(IsCodestreamOf(good, lossless, format));
  EXPECT_FALSE(IsCodestreamOf(good, "1.2.840.10008.1.2.4.50", format)); // another process
  for (const std::string& wrong : { JpegOf(4, 4, 12, ""), JpegOf(3, 3, 12, ""), JpegOf(4, 3, 0, ""),
         JpegOf(4, 3, 17, ""), JpegOf(4, 3, 8, ""), std::string(), std::string(100, '\0') })
  {
    EXPECT_FALSE(IsCodestreamOf(wrong, lossless, format));
  }
  for (std::size_t size = 0; size < good.size() - 4; ++size)
  {
    EXPECT_FALSE(IsCodestreamOf(good.substr(0, size), lossless, format)) << size;
  }

  const std::string jpeg2000 = "1.2.840.10008.1.2.4.90";
  std::string stream("\xFF\x4F\xFF\x51\x00\x29\x00\x00", 8);
  for (const int number : { 4, 3, 0, 0, 4, 3, 0, 0 })
  {
    stream += std::string(3, '\0') + static_cast<char>(number);
  }
  stream += std::string("\x00\x01\x0B\x01\x01", 5);
  EXPECT_TRUE(IsCodestreamOf(stream, jpeg2000, format));
  for (const std::size_t place : { 3U, 11U, 15U, 19U, 41U, 42U, 43U })
  {
    std::string wrong = stream;
    wrong[place] = static_cast<char>(wrong[place] ^ 0x15);
    EXPECT_FALSE(IsCodestreamOf(wrong, jpeg2000, format)) << place;
  }
  EXPECT_FALSE(IsCodestreamOf(stream.substr(0, 40), jpeg2000, format));
  // Signed, as the file must say, too.
  stream[42] = static_cast<char>(0x8B);
  EXPECT_FALSE(IsCodestreamOf(stream, jpeg2000, format));
  DicomPixelFormat withSign = format;
  withSign.IsSigned = true;
  EXPECT_TRUE(IsCodestreamOf(stream, jpeg2000, withSign));
}

TEST(DicomPixels, DecodedBitsBeyondTheStoredOnesAreNoticed)
{
  const auto isSound = [](std::vector<int> values, bool isSigned)
  { return HasOnlyStoredBits(ExampleDicom::Shorts(values), Format(16, 12, 11, isSigned)); };
  EXPECT_TRUE(isSound({ 0, 0x0FFF, 0x0800 }, false));
  EXPECT_FALSE(isSound({ 0, 0x1000 }, false));
  EXPECT_FALSE(isSound({ 0xFFFF }, false));
  EXPECT_TRUE(isSound({ 0x0FFF, 0xFFFF, 0xF800, 0x07FF }, true));
  EXPECT_FALSE(isSound({ 0xF7FF }, true));
  EXPECT_FALSE(isSound({ 0x7FFF }, true));
  EXPECT_TRUE(HasOnlyStoredBits(ExampleDicom::Shorts({ 0xFFFF }), Format(16, 16, 15, false)));
  const std::string wide(4, '\xFF');
  EXPECT_TRUE(HasOnlyStoredBits(wide, Format(32, 32, 31, false)));
  EXPECT_FALSE(HasOnlyStoredBits(wide, Format(32, 31, 30, false)));
}

TEST(DicomPixels, BitsBelowTheStoredOnesAreNoticed)
{
  const auto has = [](std::vector<int> values, int highBit)
  { return HasBitsBelowStoredOnes(ExampleDicom::Shorts(values), Format(16, 12, highBit, true)); };
  EXPECT_FALSE(has({ 0x0FFF, 1, 0xFFFF }, 11)); // there are none
  EXPECT_FALSE(has({ 0, 0xFFF0, 0x0010 }, 15));
  EXPECT_TRUE(has({ 0x0010, 0x0008 }, 15));
  EXPECT_TRUE(has({ 1 }, 12));
  const std::string wide(4, '\xFF');
  EXPECT_FALSE(HasBitsBelowStoredOnes(wide, Format(32, 32, 31, false)));
  EXPECT_TRUE(HasBitsBelowStoredOnes(wide, Format(32, 1, 31, false)));
}

TEST(DicomPixels, ATinyFileOfGiantRowsIsRefused)
{
  const auto why = [](const std::string& process, int side, std::size_t size)
  {
    ExampleDicom::Options options;
    options.Rows = options.Columns = side;
    options.Fragments = { "", std::string(size, '\0') };
    std::istringstream stream(
      ExampleDicom::FileOf(ExampleDicom::Slice(options), "1.2.840.10008.1.2." + process));
    return WhyPixelsAreIncomplete(ReadDicomDataSet(stream));
  };
  for (const std::string process : { "5", "4.50", "4.57", "4.70", "4.80", "4.90" })
  {
    EXPECT_NE(why(process, 65535, 1000).find("fewer pixels"), std::string::npos) << process;
  }
  // Blank slices are small, though.
  EXPECT_EQ(why("5", 512, 64 + 2 * 2 * 2048), "");
  EXPECT_NE(why("5", 512, 64 + 2 * 2 * 2048 - 2), "");
  EXPECT_EQ(why("4.50", 512, 1024), "");
  EXPECT_EQ(why("4.70", 512, 32768), "");
  EXPECT_EQ(why("4.80", 2048, 140), "");
  EXPECT_EQ(why("4.90", 2048, 140), "");
  EXPECT_EQ(why("4.90", 4096, 4096), "");
  EXPECT_NE(why("4.90", 65535, 65536), ""); // 8 GB
}

TEST(DicomPixels, WhatIsNotGrayOrNotThereIsSaid)
{
  ExampleDicom::Options options;
  options.Pixels = std::string(24, '\0');
  const auto parsed = [](const ExampleDicom::Options& wanted, const std::string& syntax)
  {
    std::istringstream stream(ExampleDicom::FileOf(ExampleDicom::Slice(wanted), syntax));
    return ReadDicomDataSet(stream);
  };
  const auto why =
    [&](const ExampleDicom::Options& wanted, const std::string& syntax = "1.2.840.10008.1.2.1")
  {
    const DicomDataSet data = parsed(wanted, syntax);
    return WhyNotGray(data) + WhyPixelsAreIncomplete(data);
  };
  EXPECT_EQ(why(options), "");
  auto changed = options;
  changed.Frames = "0";
  EXPECT_EQ(why(changed), "");
  changed.Frames = "2";
  EXPECT_NE(why(changed).find("fewer pixels"), std::string::npos);
  changed.Frames = "many";
  EXPECT_NE(why(changed).find("NumberOfFrames"), std::string::npos);
  changed = options;
  changed.Stored = 17;
  EXPECT_NE(why(changed).find("BitsStored"), std::string::npos);
  changed = options;
  changed.Samples = 3;
  changed.Colors = "RGB";
  EXPECT_NE(why(changed).find("colors"), std::string::npos);
  EXPECT_NE(why(options, "1.2.840.10008.1.2.4.100").find("transfer syntax"), std::string::npos);
  // What is there, but no number, is not replaced.
  const auto withText = [](std::uint32_t tag)
  {
    ExampleDicom::Options sound;
    sound.Pixels = std::string(24, '\0');
    ExampleDicom::DataSet data;
    data.Add(0x00080016, "UI", sound.Class).Add(tag, "LO", "many");
    data.AddBytes(ExampleDicom::Slice(sound).Bytes);
    std::istringstream stream(ExampleDicom::FileOf(data));
    return WhyPixelsAreIncomplete(ReadDicomDataSet(stream));
  };
  EXPECT_NE(withText(DicomTag::BitsStored).find("BitsStored"), std::string::npos);
  EXPECT_NE(withText(DicomTag::HighBit).find("HighBit"), std::string::npos);
  // Without HighBit, the stored bits are the lowest ones.
  EXPECT_EQ(PixelFormatOf(parsed(options, "")).HighBit, 15);
}

} // namespace
