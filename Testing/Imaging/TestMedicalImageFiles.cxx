// vtkMedicalImageWriter and vtkMedicalImageReader on single files.
#include "vtkMedicalImageReader.h"
#include "vtkMedicalImageWriter.h"

#include "ExampleImages.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "itk_zlib.h"

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace
{

const std::string Endings[] = { ".nii", ".nii.gz", ".nrrd", ".mha", ".mhd" };

int Write(vtkImageData* image, const std::string& name, bool compress = true)
{
  vtkNew<vtkMedicalImageWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->SetUseCompression(compress);
  return writer->Write();
}

vtkSmartPointer<vtkImageData> Read(const std::string& name)
{
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::NoError);
  vtkSmartPointer<vtkImageData> image = reader->GetOutput();
  return image;
}

void ExpectRefusal(const std::string& name, const std::vector<std::string>& words)
{
  SCOPED_TRACE(name);
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  ExampleImages::ExpectRefusal(reader, words, [&reader]() { reader->Update(); });
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_NE(reader->GetErrorCode(), vtkErrorCode::NoError);
}

void ExpectWriteRefusal(vtkImageData* image, const std::string& name,
  const std::vector<std::string>& words)
{
  SCOPED_TRACE(name);
  vtkNew<vtkMedicalImageWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  ExampleImages::ExpectRefusal(writer, words, [&writer]() { EXPECT_EQ(writer->Write(), 0); });
}

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

TEST(TestMedicalImageFiles, NotANumberIsWrittenAndNiftiReadsItAsZero)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_FLOAT, ExampleImages::Directions()[0].Matrix);
  image->SetScalarComponentFromFloat(3, 2, 1, 0, std::numeric_limits<float>::quiet_NaN());
  for (const std::string& ending : Endings)
  {
    ASSERT_EQ(Write(image, folder / ("image" + ending)), 1);
    const double back = Read(folder / ("image" + ending))->GetScalarComponentAsDouble(3, 2, 1, 0);
    if (ending.substr(0, 4) == ".nii")
    {
      EXPECT_EQ(back, 0);
    }
    else
    {
      EXPECT_TRUE(std::isnan(back)) << ending;
    }
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

/// A NRRD file with any header.
std::string Nrrd(const std::string& fields, std::size_t bytes)
{
  return "NRRD0004\ntype: unsigned char\nencoding: raw\n" + fields + "\n\n" +
    std::string(bytes, 'a');
}

TEST(TestMedicalImageFiles, WhatIsNoVolume)
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

TEST(TestMedicalImageFiles, DamagedHeaders)
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

TEST(TestMedicalImageFiles, NiftiFieldsAreJudgedOneByOne)
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
  for (const int form : { 0, 1 })
  {
    refuse(Nifti(form, 0), always);
    refuse(Nifti(0, form), always);
  }
  refuse(Nifti(1, 0), qform);
  refuse(Nifti(0, 1), sform);
  refuse(Nifti(2, 4), sform);

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

TEST(TestMedicalImageFiles, WhatNiftiDoesNotUseIsNotJudged)
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

TEST(TestMedicalImageFiles, OtherVersionsOfNiftiAreNamed)
{
  ExampleImages::Folder folder;
  std::string bytes(2000, '\0');
  const std::int32_t size = 540;
  std::memcpy(&bytes[0], &size, sizeof(size));
  ExampleImages::WriteBytes(folder / "image.nii", bytes);
  ExpectRefusal(folder / "image.nii", { "image.nii", "NIfTI-2", "NIfTI-1" });
}

TEST(TestMedicalImageFiles, NrrdFieldsAreJudgedOneByOne)
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
  refuse(good + "kinds: domain " + std::string(5000, '4'), "not NRRD to its end");
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

TEST(TestMedicalImageFiles, NrrdAsText)
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

TEST(TestMedicalImageFiles, NrrdInSeveralFiles)
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

TEST(TestMedicalImageFiles, MetaImageFieldsAreJudgedOneByOne)
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
  refuse("CompressedData", "True\nCompressedDataSize = 1000000000000", "CompressedDataSize");
  for (const std::string file : { "/dev/zero", "missing.raw", ".", "slice%s.raw 1 5 1", "LIST" })
  {
    refuse("ElementDataFile", file, "image.mha");
  }
}

TEST(TestMedicalImageFiles, ShearedGridOnlyWhereTheFormatHoldsIt)
{
  ExampleImages::Folder folder;
  const double tilt = 0.2;
  auto image =
    ExampleImages::Make(VTK_SHORT, { { 1, 0, 0, 0, 1, std::sin(tilt), 0, 0, std::cos(tilt) } });
  for (const std::string ending : { ".nrrd", ".mha" })
  {
    ASSERT_EQ(Write(image, folder / ("image" + ending)), 1);
    ExampleImages::ExpectSameGeometry(Read(folder / ("image" + ending)), image, 1e-14);
  }
  ExpectWriteRefusal(image, folder / "image.nii.gz", { "NIfTI", ".nrrd" });
  EXPECT_EQ(folder.NumberOfFiles(), 2);
}

TEST(TestMedicalImageFiles, WriterRefusesWhatItCannotWrite)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ExpectWriteRefusal(image, "", { "FileName" });
  ExpectWriteRefusal(image, folder / "image.png", { "image.png", "ending" });
  ExpectWriteRefusal(image, folder / "missing/image.nrrd", { "missing", "Create" });
  ExpectWriteRefusal(image, "/proc/image.nii.gz", { "/proc", "permissions" });
  ExampleImages::WriteBytes(folder / "file", "");
  ExpectWriteRefusal(image, folder / "file/image.nii.gz", { "file" });

  vtkNew<vtkImageData> empty;
  ExpectWriteRefusal(empty, folder / "image.nrrd", { "port 0", "empty" });
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(3, 3, 3);
  ExpectWriteRefusal(bare, folder / "image.nrrd", { "port 0", "no scalars" });
  bare->AllocateScalars(VTK_SHORT, 3);
  ExpectWriteRefusal(bare, folder / "image.nrrd", { "port 0", "3 components" });
  bare->AllocateScalars(VTK_BIT, 1);
  ExpectWriteRefusal(bare, folder / "image.nrrd", { "bit" });
  std::filesystem::create_directory(folder / "taken.nrrd");
  ExpectWriteRefusal(image, folder / "taken.nrrd", { "taken.nrrd" });
  EXPECT_EQ(folder.NumberOfFiles(), 2);
}

TEST(TestMedicalImageFiles, FolderWithoutPermission)
{
  if (geteuid() == 0)
  {
    GTEST_SKIP() << "The superuser may write everywhere.";
  }
  ExampleImages::Folder folder;
  std::filesystem::create_directory(folder / "closed");
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_read);
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ExpectWriteRefusal(image, folder / "closed/image.nii.gz", { "closed", "permissions" });
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_all);
}

TEST(TestMedicalImageFiles, FullDiskLeavesTheFormerFile)
{
  ExampleImages::Folder folder;
  const auto image = ExampleImages::Noise(40, 65536);

  // To the writer, a limit on the size of files looks like a disk that has become full.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit unlimited;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
  rlimit limited = unlimited;
  for (const rlim_t limit : { 0, 100, 50000, 120000 })
  {
    for (const std::string& ending : Endings)
    {
      for (const bool compress : { true, false })
      {
        SCOPED_TRACE(ending + " in " + std::to_string(limit));
        ExampleImages::WriteBytes(folder / ("image" + ending), "former");
        const auto files = folder.NumberOfFiles();
        vtkNew<vtkMedicalImageWriter> writer;
        ExampleImages::Errors errors(writer);
        writer->SetInputData(image);
        writer->SetFileName((folder / ("image" + ending)).c_str());
        writer->SetUseCompression(compress);
        limited.rlim_cur = limit;
        setrlimit(RLIMIT_FSIZE, &limited);
        const int written = writer->Write();
        setrlimit(RLIMIT_FSIZE, &unlimited);
        if (limit == 120000 && written) // noise, packed, may just fit
        {
          ExampleImages::ExpectSameVoxels(Read(folder / ("image" + ending)), image);
          continue;
        }
        EXPECT_EQ(errors.Count(), 1);
        EXPECT_NE(errors.Message().find("full"), std::string::npos) << errors.Message();
        EXPECT_EQ(ExampleImages::ReadBytes(folder / ("image" + ending)), "former");
        EXPECT_EQ(folder.NumberOfFiles(), files);
      }
    }
  }
}

void AbortSoon(vtkObject* caller, unsigned long, void*, void*)
{
  vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
}

TEST(TestMedicalImageFiles, AbortReadingAndWriting)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[0].Matrix);
  ASSERT_EQ(Write(image, folder / "image.nii.gz"), 1);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(AbortSoon);

  vtkNew<vtkMedicalImageReader> reader;
  ExampleImages::Errors errors(reader);
  reader->SetFileName((folder / "image.nii.gz").c_str());
  reader->AddObserver(vtkCommand::ProgressEvent, abort);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors.Count(), 0);

  vtkNew<vtkMedicalImageWriter> writer;
  ExampleImages::Errors writerErrors(writer);
  writer->SetInputData(image);
  writer->SetFileName((folder / "copy.nii.gz").c_str());
  writer->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_EQ(writerErrors.Count(), 0);
  EXPECT_EQ(folder.NumberOfFiles(), 1);
}

} // namespace
