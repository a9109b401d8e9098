// vtkMedicalImageWriter and vtkMedicalImageReader on single files.
#include "ImageFiles.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "itk_zlib.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

namespace
{

using ImageFiles::Endings;
using ImageFiles::ExpectRefusal;
using ImageFiles::ExpectWriteRefusal;
using ImageFiles::Read;
using ImageFiles::Write;

using Combination = std::tuple<std::string, ExampleImages::NamedDirection>;

class TestRoundTrip : public testing::TestWithParam<Combination>
{
};

TEST_P(TestRoundTrip, KeepsGeometryAndVoxels)
{
  const std::string ending = std::get<0>(GetParam());
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, std::get<1>(GetParam()).Matrix);
  ASSERT_EQ(Write(image, folder / ("image" + ending)), 1);
  auto back = Read(folder / ("image" + ending));

  // NIfTI holds its geometry in single precision.
  const double tolerance = ending.substr(0, 4) == ".nii" ? 1e-6 : 1e-14;
  ExampleImages::ExpectSameGeometry(back, image, tolerance);
  ExampleImages::ExpectSameVoxels(back, image);
  EXPECT_EQ(back->GetScalarType(), VTK_SHORT);
  const auto place = ExampleImages::FindMark(image);
  const auto placeBack = ExampleImages::FindMark(back);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(placeBack[i], place[i], 1000 * tolerance);
  }
  // Nothing but the file, or the file and its voxels.
  EXPECT_EQ(folder.NumberOfFiles(), ending == ".mhd" ? 2 : 1);
}

TEST_P(TestRoundTrip, InformationComesWithoutVoxels)
{
  const std::string name = "image" + std::get<0>(GetParam());
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_UNSIGNED_SHORT, std::get<1>(GetParam()).Matrix);
  ASSERT_EQ(Write(image, folder / name), 1);

  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName((folder / name).c_str());
  reader->UpdateInformation();
  vtkInformation* information = reader->GetOutputInformation(0);
  const int* extent = information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  const double* spacing = information->Get(vtkDataObject::SPACING());
  const double* origin = information->Get(vtkDataObject::ORIGIN());
  const double* direction = information->Get(vtkDataObject::DIRECTION());
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(extent[i], image->GetExtent()[i]);
  }
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(spacing[i], image->GetSpacing()[i], 1e-6);
    EXPECT_NEAR(origin[i], image->GetOrigin()[i], 1e-3);
  }
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(direction[i], image->GetDirectionMatrix()->GetData()[i], 1e-6);
  }
  EXPECT_EQ(vtkImageData::GetScalarType(information), VTK_UNSIGNED_SHORT);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, TestRoundTrip,
  testing::Combine(testing::ValuesIn(Endings), testing::ValuesIn(ExampleImages::Directions())),
  [](const auto& parameter)
  {
    std::string name = std::get<0>(parameter.param).substr(1) + std::get<1>(parameter.param).Name;
    name.erase(std::remove(name.begin(), name.end(), '.'), name.end());
    return name;
  });

TEST(TestMedicalImageFiles, EveryScalarTypeInEveryFormat)
{
  ExampleImages::Folder folder;
  for (const int type : { VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
         VTK_INT, VTK_UNSIGNED_INT, VTK_TYPE_INT64, VTK_TYPE_UINT64, VTK_FLOAT, VTK_DOUBLE })
  {
    for (const std::string& ending : Endings)
    {
      SCOPED_TRACE(std::string(vtkImageScalarTypeNameMacro(type)) + " " + ending);
      auto image = ExampleImages::Make(type, ExampleImages::Directions()[4].Matrix);
      // The ends of the type's range show a type that is too narrow or has the wrong sign.
      vtkDataArray* scalars = image->GetPointData()->GetScalars();
      scalars->SetComponent(0, 0, scalars->GetDataTypeMin());
      ASSERT_EQ(Write(image, folder / ("image" + ending)), 1);
      auto back = Read(folder / ("image" + ending));
      EXPECT_EQ(back->GetScalarType(), type);
      ExampleImages::ExpectSameVoxels(back, image);
    }
  }
}

TEST(TestMedicalImageFiles, NotANumberStaysSo)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_FLOAT, ExampleImages::Directions()[0].Matrix);
  image->SetScalarComponentFromFloat(3, 2, 1, 0, std::numeric_limits<float>::quiet_NaN());
  for (const std::string& ending : Endings)
  {
    ASSERT_EQ(Write(image, folder / ("image" + ending)), 1);
    EXPECT_TRUE(
      std::isnan(Read(folder / ("image" + ending))->GetScalarComponentAsDouble(3, 2, 1, 0)))
      << ending;
  }
}

TEST(TestMedicalImageFiles, UncompressedIsLarger)
{
  ExampleImages::Folder folder;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(30, 30, 30);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  image->GetPointData()->GetScalars()->Fill(7);
  for (const std::string ending : { ".nrrd", ".mha" })
  {
    ASSERT_EQ(Write(image, folder / ("packed" + ending)), 1);
    ASSERT_EQ(Write(image, folder / ("plain" + ending), false), 1);
    EXPECT_LT(std::filesystem::file_size(folder / ("packed" + ending)), 2000);
    EXPECT_GT(std::filesystem::file_size(folder / ("plain" + ending)), 27000);
    ExampleImages::ExpectSameVoxels(Read(folder / ("plain" + ending)), image);
  }
}

TEST(TestMedicalImageFiles, ExtentThatDoesNotBeginAtZeroKeepsItsPlace)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[4].Matrix);
  const auto place = ExampleImages::FindMark(image);
  double origin[3];
  image->TransformContinuousIndexToPhysicalPoint(-3, 2, -10, origin);
  image->SetExtent(3, 9, -2, 1, 10, 14);
  image->SetOrigin(origin);
  ASSERT_EQ(Write(image, folder / "image.nrrd"), 1);
  const auto placeBack = ExampleImages::FindMark(Read(folder / "image.nrrd"));
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(placeBack[i], place[i], 1e-10);
  }
}

TEST(TestMedicalImageFiles, NiftiIsRightAnteriorSuperior)
{
  // By the bytes of the header, not by any reader: LPS (x, y, z) is RAS (-x, -y, z).
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[4].Matrix);
  ASSERT_EQ(Write(image, folder / "image.nii"), 1);
  const std::string bytes = ExampleImages::ReadBytes(folder / "image.nii");
  float sform[3][4];
  std::memcpy(sform, bytes.data() + 280, sizeof(sform));
  const auto place = ExampleImages::FindMark(image);
  const double signs[3] = { -1, -1, 1 };
  for (int row = 0; row < 3; ++row)
  {
    double value = sform[row][3];
    for (int axis = 0; axis < 3; ++axis)
    {
      value += sform[row][axis] * ExampleImages::MarkedVoxel[axis];
    }
    EXPECT_NEAR(signs[row] * value, place[row], 1e-3);
  }
}

TEST(TestMedicalImageFiles, RescaledNiftiIsReadInItsOwnUnits)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ASSERT_EQ(Write(image, folder / "image.nii"), 1);
  std::string bytes = ExampleImages::ReadBytes(folder / "image.nii");
  const float slopeAndIntercept[2] = { 0.5F, -1024 };
  std::memcpy(&bytes[112], slopeAndIntercept, sizeof(slopeAndIntercept));
  ExampleImages::WriteBytes(folder / "image.nii", bytes);
  auto back = Read(folder / "image.nii");
  EXPECT_EQ(back->GetScalarType(), VTK_FLOAT);
  EXPECT_EQ(back->GetScalarComponentAsDouble(ExampleImages::MarkedVoxel[0],
              ExampleImages::MarkedVoxel[1], ExampleImages::MarkedVoxel[2], 0),
    ExampleImages::Mark / 2 - 1024);
}

TEST(TestMedicalImageFiles, NiftiPairWithOneTimePoint)
{
  // A header with four axes, the last of length one, and its voxels in a file beside it.
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[5].Matrix);
  ASSERT_EQ(Write(image, folder / "image.nii"), 1);
  const std::string bytes = ExampleImages::ReadBytes(folder / "image.nii");
  std::string header = bytes.substr(0, 348);
  const std::int16_t dimensions[5] = { 4, 7, 4, 5, 1 };
  std::memcpy(&header[40], dimensions, sizeof(dimensions));
  const float offset = 0;
  std::memcpy(&header[108], &offset, sizeof(offset));
  header.replace(344, 3, "ni1");
  ExampleImages::WriteBytes(folder / "pair.hdr", header);
  ExampleImages::WriteBytes(folder / "pair.img", bytes.substr(352));
  auto back = Read(folder / "pair.hdr");
  ExampleImages::ExpectSameGeometry(back, image, 1e-6);
  ExampleImages::ExpectSameVoxels(back, image);

  ExampleImages::WriteBytes(folder / "pair.img", bytes.substr(352, 100));
  ExpectRefusal(folder / "pair.hdr", { "pair.img", "fewer voxels" });
  std::filesystem::remove(folder / "pair.img");
  ExpectRefusal(folder / "pair.hdr", { "pair" });
}

TEST(TestMedicalImageFiles, ReadingAgainAfterAnErrorAndAfterAChange)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ASSERT_EQ(Write(image, folder / "image.nrrd"), 1);
  vtkNew<vtkMedicalImageReader> reader;
  ExampleImages::Errors errors(reader);
  reader->SetFileName((folder / "image.nrrd").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 140);
  reader->SetFileName((folder / "missing.nrrd").c_str());
  reader->Update();
  EXPECT_EQ(errors.Count(), 1);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::FileNotFoundError);
  reader->SetFileName((folder / "image.nrrd").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 140);
  EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::NoError);
}

TEST(TestMedicalImageFiles, MissingAndUnknownFiles)
{
  ExampleImages::Folder folder;
  ExpectRefusal("", { "FileName" });
  ExpectRefusal(folder / "missing.nii.gz", { "missing.nii.gz", "does not exist" });
  ExampleImages::WriteBytes(folder / "notes.txt", std::string(5000, 'x'));
  ExpectRefusal(folder / "notes.txt", { "notes.txt", "unknown", ".nii.gz" });
  for (const std::string& ending : Endings)
  {
    ExampleImages::WriteBytes(folder / ("empty" + ending), "");
    ExpectRefusal(folder / ("empty" + ending), { "empty" + ending });
    ExampleImages::WriteBytes(folder / ("notes" + ending), std::string(5000, 'x'));
    ExpectRefusal(folder / ("notes" + ending), { "notes" + ending });
  }
  ExpectRefusal(folder.Name(), { folder.Name(), "no DICOM image" }); // full of other files
}

TEST(TestMedicalImageFiles, TruncatedAtAnyPlace)
{
  ExampleImages::Folder folder;
  const auto image = ExampleImages::Noise(20, 4000);
  for (const std::string& ending : Endings)
  {
    for (const bool compress : { true, false })
    {
      ASSERT_EQ(Write(image, folder / ("image" + ending), compress), 1);
      // Of a .mhd it is the voxels' file that is cut.
      std::string cut = folder / ("image" + ending);
      if (ending == ".mhd")
      {
        cut = folder / (compress ? "image.zraw" : "image.raw");
      }
      const std::string bytes = ExampleImages::ReadBytes(cut);
      for (const double part : { 0.0, 0.001, 0.01, 0.02, 0.05, 0.3, 0.7, 0.95, 0.999, 1.0 })
      {
        const auto size = std::min(bytes.size() - 1, // the last byte at least
          static_cast<std::size_t>(part * static_cast<double>(bytes.size())));
        SCOPED_TRACE(cut + " cut to " + std::to_string(size));
        ExampleImages::WriteBytes(cut, bytes.substr(0, size));
        ExpectRefusal(folder / ("image" + ending), { "image" + ending });
      }
      std::filesystem::remove(cut);
    }
  }
}

TEST(TestMedicalImageFiles, DamagedGzipStream)
{
  ExampleImages::Folder folder;
  const auto image = ExampleImages::Noise(40, 4000);
  ASSERT_EQ(Write(image, folder / "image.nii.gz"), 1);
  std::string bytes = ExampleImages::ReadBytes(folder / "image.nii.gz");
  bytes[bytes.size() / 2] ^= 1; // noise hardly compresses: the stream stays one, the sum does not
  ExampleImages::WriteBytes(folder / "image.nii.gz", bytes);
  ExpectRefusal(folder / "image.nii.gz", { "image.nii.gz", "checksum" });
}

TEST(TestMedicalImageFiles, GzipStreamOfSeveralMembers)
{
  ExampleImages::Folder folder;
  const auto image = ExampleImages::Noise(40, 4000);
  ASSERT_EQ(Write(image, folder / "image.nii"), 1);
  const std::string bytes = ExampleImages::ReadBytes(folder / "image.nii");
  for (const std::size_t begin : { std::size_t(0), bytes.size() / 3 })
  {
    const std::string part = bytes.substr(begin, begin ? std::string::npos : bytes.size() / 3);
    const gzFile file = gzopen((folder / "image.nii.gz").c_str(), begin ? "ab" : "wb");
    gzwrite(file, part.data(), static_cast<unsigned int>(part.size()));
    gzclose(file);
  }
  ExampleImages::ExpectSameVoxels(Read(folder / "image.nii.gz"), image);
  const std::string packed = ExampleImages::ReadBytes(folder / "image.nii.gz");
  ExampleImages::WriteBytes(folder / "image.nii.gz", packed.substr(0, packed.size() - 5000));
  ExpectRefusal(folder / "image.nii.gz", { "image.nii.gz", "breaks off" });
}

TEST(TestMedicalImageFiles, LinesBeforeACompressedStreamAreNoPartOfIt)
{
  ExampleImages::Folder folder;
  const auto image = ExampleImages::Noise(8, 4000);
  ASSERT_EQ(Write(image, folder / "image.nrrd"), 1);
  std::string bytes = ExampleImages::ReadBytes(folder / "image.nrrd");
  ASSERT_NE(bytes.find("encoding: gzip"), std::string::npos);
  bytes.insert(bytes.find("\n\n") + 2, "one\ntwo\n");
  bytes.insert(bytes.find("\n\n") + 1, "line skip: 2\n");
  ExampleImages::WriteBytes(folder / "image.nrrd", bytes);
  ExampleImages::ExpectSameVoxels(Read(folder / "image.nrrd"), image);
}

TEST(TestMedicalImageFiles, ShearedGridInEveryFormat)
{
  ExampleImages::Folder folder;
  const double tilt = 0.2;
  auto image =
    ExampleImages::Make(VTK_SHORT, { { 1, 0, 0, 0, 1, std::sin(tilt), 0, 0, std::cos(tilt) } });
  for (const std::string& ending : Endings)
  {
    const double tolerance = ending.substr(0, 4) == ".nii" ? 1e-6 : 1e-14;
    ASSERT_EQ(Write(image, folder / ("image" + ending)), 1);
    ExampleImages::ExpectSameGeometry(Read(folder / ("image" + ending)), image, tolerance);
  }
}

TEST(TestMedicalImageFiles, WhatAHeaderDoesNotSayIsAWarning)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ASSERT_EQ(Write(image, folder / "image.nii"), 1);
  std::string bytes = ExampleImages::ReadBytes(folder / "image.nii");
  std::memset(&bytes[252], 0, 4); // neither qform nor sform
  ExampleImages::WriteBytes(folder / "image.nii", bytes);
  vtkNew<vtkMedicalImageReader> reader;
  ExampleImages::Errors errors(reader);
  reader->SetFileName((folder / "image.nii").c_str());
  reader->Update();
  EXPECT_NE(errors.Warning().find("does not say where its voxels are"), std::string::npos)
    << errors.Warning();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 140);
}

TEST(TestMedicalImageFiles, EndingsInCapitalsAndVoxelsBehindAHeader)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[4].Matrix);
  ASSERT_EQ(Write(image, folder / "image.mha"), 1);
  std::filesystem::rename(folder / "image.mha", folder / "IMAGE.MHA");
  ExampleImages::ExpectSameVoxels(Read(folder / "IMAGE.MHA"), image);

  // A compressed file need not say how many bytes it has.
  std::string bytes = ExampleImages::ReadBytes(folder / "IMAGE.MHA");
  const std::size_t begin = bytes.find("CompressedDataSize");
  bytes.erase(begin, bytes.find('\n', begin) + 1 - begin);
  ExampleImages::WriteBytes(folder / "IMAGE.MHA", bytes);
  ExampleImages::ExpectSameVoxels(Read(folder / "IMAGE.MHA"), image);

  // Nor does a NIfTI file whose voxels follow its header.
  ASSERT_EQ(Write(image, folder / "image.nii"), 1);
  bytes = ExampleImages::ReadBytes(folder / "image.nii");
  std::memset(&bytes[108], 0, 4); // vox_offset
  ExampleImages::WriteBytes(folder / "image.nii", bytes);
  ExampleImages::ExpectSameVoxels(Read(folder / "image.nii"), image);

  // A header whose voxels are the last bytes of the file.
  ASSERT_EQ(Write(image, folder / "image.mhd", false), 1);
  bytes = ExampleImages::ReadBytes(folder / "image.mhd");
  bytes.insert(bytes.find("ElementDataFile"), "HeaderSize = -1\n");
  ExampleImages::WriteBytes(folder / "image.mhd", bytes);
  const std::string voxels = ExampleImages::ReadBytes(folder / "image.raw");
  ExampleImages::WriteBytes(folder / "image.raw", "preface" + voxels);
  ExampleImages::ExpectSameVoxels(Read(folder / "image.mhd"), image);
}

} // namespace
