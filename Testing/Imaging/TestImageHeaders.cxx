// Headers of every format, field by field: what a file says of itself is judged before its voxels
// are read.
#include "ImageFiles.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

namespace
{

using ImageFiles::ExpectRefusal;
using ImageFiles::Read;
using ImageFiles::Write;

/// A NRRD file with any header.
std::string Nrrd(const std::string& fields, std::size_t bytes)
{
  return "NRRD0004\ntype: unsigned char\nencoding: raw\n" + fields + "\n\n" +
    std::string(bytes, 'a');
}

TEST(TestImageHeaders, WhatIsNoVolume)
{
  ExampleImages::Folder folder;
  const auto refuse =
    [&](const std::string& fields, std::size_t bytes, const std::vector<std::string>& words)
  {
    ExampleImages::WriteBytes(folder / "image.nrrd", Nrrd(fields, bytes));
    ExpectRefusal(folder / "image.nrrd", words);
  };
  refuse("dimension: 2\nsizes: 4 5", 20, { "2 dimensions", "4 x 5" });
  refuse("dimension: 4\nsizes: 4 5 6 7\nkinds: domain domain domain domain", 840,
    { "4 dimensions", "4 x 5 x 6 x 7", "Extract" });
  refuse("dimension: 4\nsizes: 3 4 5 6\nkinds: vector domain domain domain", 360,
    { "3 components", "Extract" });
  refuse("dimension: 4\nsizes: 3 4 5 6\nkinds: RGB-color domain domain domain", 360,
    { "3 components", "gray" });
  refuse("dimension: 3\nsizes: 4 5 6\nspace: left-posterior-superior\nspace directions: (1,0,0) "
         "(1,0,0) (0,0,1)\nspace origin: (0,0,0)",
    120, { "image.nrrd", "determinant" });
}

TEST(TestImageHeaders, DamagedHeaders)
{
  ExampleImages::Folder folder;
  // No blank line ends the header; ITK's reader would stop the program at the voxels.
  std::string bytes = Nrrd("dimension: 3\nsizes: 4 5 6", 120);
  bytes.replace(bytes.find("\n\n"), 2, "\n" + std::string(400, '\1'));
  ExampleImages::WriteBytes(folder / "image.nrrd", bytes);
  ExpectRefusal(folder / "image.nrrd", { "image.nrrd", "damaged" });

  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ASSERT_EQ(Write(image, folder / "image.mhd"), 1);
  const std::string header = ExampleImages::ReadBytes(folder / "image.mhd");
  const auto replaced = [&header](const std::string& what, const std::string& by)
  {
    std::string result = header;
    result.replace(result.find(what), what.size(), by);
    return result;
  };
  for (const std::string voxels : { "missing.zraw", ".", "" })
  {
    ExampleImages::WriteBytes(folder / "image.mhd", replaced("image.zraw", voxels));
    ExpectRefusal(folder / "image.mhd", { "image.mhd" });
  }
  ExampleImages::WriteBytes(folder / "image.mhd", replaced("7 4 5", "7 4 50"));
  ExpectRefusal(folder / "image.mhd", { "image.mhd", "voxels" });
  ExampleImages::WriteBytes(folder / "image.mhd", replaced("7 4 5", "70000 70000 70000"));
  ExpectRefusal(folder / "image.mhd", { "image.mhd" });

  ASSERT_EQ(Write(image, folder / "image.nii"), 1);
  bytes = ExampleImages::ReadBytes(folder / "image.nii");
  const std::int16_t sizes[3] = { 32000, 32000, 32000 }; // 60 TB
  std::memcpy(&bytes[42], sizes, sizeof(sizes));
  ExampleImages::WriteBytes(folder / "image.nii", bytes);
  ExpectRefusal(folder / "image.nii", { "image.nii", "fewer voxels" });
}

/// The bytes of a NIfTI file with the qform, the sform or none.
std::string Nifti(int qform, int sform)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[4].Matrix);
  EXPECT_EQ(Write(image, folder / "image.nii"), 1);
  std::string bytes = ExampleImages::ReadBytes(folder / "image.nii");
  const std::int16_t codes[2] = { static_cast<std::int16_t>(qform),
    static_cast<std::int16_t>(sform) };
  std::memcpy(&bytes[252], codes, sizeof(codes));
  return bytes;
}

TEST(TestImageHeaders, NiftiFieldsAreJudgedOneByOne)
{
  // ITK's library aborts on some of them and goes on for ever on others.
  ExampleImages::Folder folder;
  struct Field
  {
    int Offset;
    std::string Name;
    bool MayBeLarge = false;
  };
  std::vector<Field> always{ { 108, "vox_offset" } };
  for (int axis = 1; axis <= 3; ++axis)
  {
    always.push_back({ 76 + 4 * axis, "pixdim[" + std::to_string(axis) + "]" });
  }
  const std::vector<Field> qform{ { 76, "pixdim[0]", true }, { 256, "quatern_b" },
    { 264, "quatern_d" }, { 268, "qoffset_x" }, { 276, "qoffset_z" } };
  const std::vector<Field> sform{ { 280, "srow_x[0]" }, { 284, "srow_x[1]" }, { 296, "srow_y[0]" },
    { 308, "srow_y[3]" }, { 312, "srow_z[0]" }, { 324, "srow_z[3]" } };
  const auto refuse = [&](const std::string& good, const std::vector<Field>& fields)
  {
    for (const Field& field : fields)
    {
      for (const float value :
        { std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(), 3e38F })
      {
        if (field.MayBeLarge && value > 0)
        {
          continue;
        }
        std::string bytes = good;
        std::memcpy(&bytes[static_cast<std::size_t>(field.Offset)], &value, sizeof(value));
        ExampleImages::WriteBytes(folder / "image.nii", bytes);
        ExpectRefusal(folder / "image.nii", { "image.nii", field.Name, "Repair" });
      }
    }
  };
  refuse(Nifti(0, 0), always);
  refuse(Nifti(1, 0), always);
  refuse(Nifti(0, 1), { always.front() }); // the sform says how large voxels are
  refuse(Nifti(1, 0), qform);
  refuse(Nifti(0, 1), sform);

  const auto refuseNumber = [&](std::size_t offset, std::int16_t value, const std::string& name)
  {
    std::string bytes = Nifti(1, 1);
    std::memcpy(&bytes[offset], &value, sizeof(value));
    ExampleImages::WriteBytes(folder / "image.nii", bytes);
    ExpectRefusal(folder / "image.nii", { "image.nii", name, "Repair" });
  };
  refuseNumber(40, 0, "dim[0]");
  refuseNumber(40, 8, "dim[0]");
  refuseNumber(42, -7, "dim[1]");
  refuseNumber(46, 0, "dim[3]");
  refuseNumber(70, 1, "datatype"); // single bits
  refuseNumber(70, 77, "datatype");
}

TEST(TestImageHeaders, NiftiOrientationMustBeCertain)
{
  // Other readers mirror the image, or take another orientation, without a word.
  ExampleImages::Folder folder;
  const auto refuse = [&](const std::string& bytes, const std::vector<std::string>& words)
  {
    ExampleImages::WriteBytes(folder / "image.nii", bytes);
    ExpectRefusal(folder / "image.nii", words);
  };
  for (int axis = 1; axis <= 3; ++axis)
  {
    for (const auto& [qform, sform] : { std::pair(0, 0), std::pair(1, 0) })
    {
      std::string bytes = Nifti(qform, sform);
      const float spacing = -2;
      std::memcpy(&bytes[static_cast<std::size_t>(76 + 4 * axis)], &spacing, sizeof(spacing));
      refuse(bytes, { "image.nii", "pixdim[" + std::to_string(axis) + "] is negative", "Repair" });
    }
  }
  const std::string rows[] = { "srow_x", "srow_y", "srow_z" };
  for (std::size_t row = 0; row < 3; ++row)
  {
    std::string bytes = Nifti(0, 1);
    const float zeros[3] = {};
    std::memcpy(&bytes[280 + 16 * row], zeros, sizeof(zeros));
    refuse(bytes, { "image.nii", rows[row] + " holds zeros", "Repair" });
  }
}

TEST(TestImageHeaders, WhatNiftiDoesNotUseIsNotJudged)
{
  ExampleImages::Folder folder;
  const float wild = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [qform, sform, offset] : std::vector<std::array<int, 3>>{ { 1, 1, 92 },
         { 0, 1, 76 }, { 0, 1, 256 }, { 1, 0, 280 }, { 0, 0, 280 } })
  {
    std::string bytes = Nifti(qform, sform);
    std::memcpy(&bytes[static_cast<std::size_t>(offset)], &wild, sizeof(wild));
    ExampleImages::WriteBytes(folder / "image.nii", bytes);
    EXPECT_EQ(Read(folder / "image.nii")->GetNumberOfPoints(), 140) << offset;
  }
}

TEST(TestImageHeaders, NrrdFieldsAreJudgedOneByOne)
{
  ExampleImages::Folder folder;
  const auto write = [&](const std::string& fields)
  { ExampleImages::WriteBytes(folder / "image.nrrd", Nrrd(fields, 120)); };
  const std::string good = "dimension: 3\nsizes: 4 5 6\n";
  const std::string space = good + "space: left-posterior-superior\n";
  const auto refuse = [&](const std::string& fields, const std::string& word)
  {
    write(fields);
    ExpectRefusal(folder / "image.nrrd", { "image.nrrd", word });
  };
  refuse("sizes: 4 5 6", "dimension is missing");
  refuse("dimension: 1e9\nsizes: 4 5 6", "dimension is 1e+09");
  refuse("dimension: 3\nsizes: 4 5", "sizes holds 2 numbers");
  refuse("dimension: 3\nsizes: 4 5 -6", "sizes holds -6");
  refuse("dimension: 3\nsizes: 4 5 six", "'six'");
  refuse("dimension: 3\nsizes: 2000000000 2000000000 2000000000", "fewer voxels");
  refuse(good + "spacings: 1 1 inf", "spacings is inf");
  refuse(good + "spacings: 1 0 1", "spacings is 0");
  refuse(good + "dimension: 3", "dimension stands there twice");
  refuse(space + "space directions: (1,0,0) (0,nan,0) (0,0,1)", "space directions is nan");
  refuse(space + "space directions: (1,0,0) (0,1,0)", "space directions");
  refuse(space + "space directions: 1,0,0", "parentheses");
  refuse(space + "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,3e200)",
    "space origin");
  refuse(good + "kinds: domain " + std::string(5000, '4'), "kinds");
  refuse(good + "line skip: 1", "fewer voxels");
  refuse(good + "byte skip: -2", "byte skip is -2");
  refuse(good + "byte skip: 1", "fewer voxels");
  write(good + "# " + std::string(5000, '4') + "\nnotes:=" + std::string(5000, '4'));
  EXPECT_EQ(Read(folder / "image.nrrd")->GetNumberOfPoints(), 120);
  write(good + "byte skip: -1");
  EXPECT_EQ(Read(folder / "image.nrrd")->GetNumberOfPoints(), 120);
  for (const std::string file : { "/dev/zero", "missing.raw", ".", "slice%s.raw 1 6 1",
         "slice%n%d.raw 1 6 1", "slice%d.raw 1 6 0", "slice%d.raw 1 6 1", "LIST" })
  {
    refuse(good + "data file: " + file, "image.nrrd");
  }
  std::string text = Nrrd(good, 0);
  text.replace(text.find("raw"), 3, "lzma");
  ExampleImages::WriteBytes(folder / "image.nrrd", text);
  ExpectRefusal(folder / "image.nrrd", { "encoding" });
}

TEST(TestImageHeaders, NrrdAsText)
{
  // ITK's library copies words into a buffer of fixed size.
  ExampleImages::Folder folder;
  std::string header = Nrrd("dimension: 3\nsizes: 4 5 6", 0);
  header.replace(header.find("raw"), 3, "ascii");
  std::string numbers;
  for (int voxel = 0; voxel < 120; ++voxel)
  {
    numbers += std::to_string(voxel) + (voxel % 7 ? " " : "\n");
  }
  ExampleImages::WriteBytes(folder / "image.nrrd", header + numbers);
  EXPECT_EQ(Read(folder / "image.nrrd")->GetScalarComponentAsDouble(3, 4, 5, 0), 119);
  ExampleImages::WriteBytes(folder / "image.nrrd", header + std::string(20000, '7'));
  ExpectRefusal(folder / "image.nrrd", { "image.nrrd", "encoding is text" });
  ExampleImages::WriteBytes(folder / "image.nrrd", header + numbers.substr(0, 200));
  ExpectRefusal(folder / "image.nrrd", { "image.nrrd", "fewer voxels" });
}

TEST(TestImageHeaders, NrrdInSeveralFiles)
{
  ExampleImages::Folder folder;
  std::string list;
  for (int slice = 1; slice <= 6; ++slice)
  {
    const std::string file = "slice0" + std::to_string(slice) + ".raw";
    ExampleImages::WriteBytes(folder / file, std::string(20, static_cast<char>('a' + slice)));
    list += "\n" + file;
  }
  for (const std::string& place : { "LIST" + list, std::string("slice%02d.raw 1 6 1") })
  {
    const std::string header = Nrrd("dimension: 3\nsizes: 4 5 6\ndata file: " + place, 0);
    ExampleImages::WriteBytes(folder / "image.nhdr", header.substr(0, header.size() - 1));
    auto image = Read(folder / "image.nhdr");
    ASSERT_EQ(image->GetNumberOfPoints(), 120) << place;
    EXPECT_EQ(image->GetScalarComponentAsDouble(3, 4, 5, 0), 'g');
  }
}

TEST(TestImageHeaders, MetaImageFieldsAreJudgedOneByOne)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[4].Matrix);
  ASSERT_EQ(Write(image, folder / "good.mha", false), 1);
  const std::string good = ExampleImages::ReadBytes(folder / "good.mha");
  const auto refuse =
    [&](const std::string& field, const std::string& value, const std::string& word)
  {
    SCOPED_TRACE(field + " = " + value);
    std::string bytes = good;
    const std::size_t begin = bytes.find(field + " = ");
    ASSERT_NE(begin, std::string::npos);
    bytes.replace(begin, bytes.find('\n', begin) - begin, field + " = " + value);
    ExampleImages::WriteBytes(folder / "image.mha", bytes);
    ExpectRefusal(folder / "image.mha", { "image.mha", word });
  };
  refuse("NDims", "100000", "NDims is 100000");
  refuse("NDims", "0", "NDims is 0");
  refuse("NDims", "2", "DimSize holds 3 numbers");
  refuse("DimSize", "7 4 -5", "DimSize holds -5");
  refuse("DimSize", "2000000000 2000000000 2000000000", "fewer voxels");
  refuse("ElementSpacing", "1 nan 1", "ElementSpacing is nan");
  refuse("ElementSpacing", "1 0 1", "ElementSpacing is 0");
  refuse("Offset", "0 0 1e200", "Offset is 1e+200");
  refuse("Offset", "0 0", "Offset holds 2 numbers");
  refuse("TransformMatrix", "1 0 0 0 inf 0 0 0 1", "TransformMatrix is inf");
  refuse("ElementType", "MET_STRING", "ElementType");
  refuse("ElementType", "MET_SHORT\nHeaderSize = -2", "HeaderSize is -2");
  refuse("ElementType", "MET_SHORT\nElementNumberOfChannels = 1000000", "ElementNumberOfChannels");
  refuse("ElementType", "MET_SHORT\n" + std::string(5000, 'x') + " = 1", "a line");
  refuse("ElementType", "MET_SHORT\nNDims = 3", "NDims stands there twice");
  refuse("CompressedData", "True\nCompressedDataSize = 1000000000000", "breaks off");
  for (const std::string file : { "/dev/zero", "missing.raw", ".", "slice%s.raw 1 5 1", "LIST" })
  {
    refuse("ElementDataFile", file, "image.mha");
  }
}

} // namespace
