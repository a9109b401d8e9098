// vtkMedicalImageReader on folders of DICOM files, which the tests write themselves.
#include "vtkMedicalImageReader.h"

#include "ItkVtkBridge.h"

#include "ExampleDicom.h"
#include "ExampleImages.h"

#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include "itkGDCMImageIO.h"
#include "itkImageSeriesWriter.h"
#include "itkMetaDataObject.h"

#include "gdcmTrace.h"

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace
{

using Volume = itk::Image<short, 3>;
using Slice = itk::Image<short, 2>;

const std::string UID = "1.2.826.0.1.3680043.2.1143.77";

std::string Text(const std::vector<double>& values)
{
  std::ostringstream text;
  text << std::setprecision(15);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    text << (i ? "\\" : "") << values[i];
  }
  return text.str();
}

struct SeriesOptions
{
  std::string Series = UID + ".1";
  std::string Description = "Example";
  std::string Prefix = "a";
  bool IsCompressed = false;
  itk::GDCMImageIO::CompressionEnum Compression = itk::GDCMImageIO::CompressionEnum::JPEG;
  /// Moves slices; the second is the number of the slice.
  std::function<itk::Point<double, 3>(itk::Point<double, 3>, int)> Move =
    [](itk::Point<double, 3> point, int) { return point; };
};

/// Writes one file per slice by itk::ImageSeriesWriter and GDCM; the names are in no order.
void WriteSeries(vtkImageData* image, const ExampleImages::Folder& folder,
  const SeriesOptions& options = {})
{
  const Volume::Pointer volume = FlipFree::ShareWithItk<short>(image);
  const auto size = volume->GetLargestPossibleRegion().GetSize();
  const auto& direction = volume->GetDirection();

  std::vector<itk::MetaDataDictionary> dictionaries(size[2]);
  std::vector<itk::MetaDataDictionary*> pointers;
  std::vector<std::string> names;
  for (unsigned int k = 0; k < size[2]; ++k)
  {
    const Volume::IndexType first = { { 0, 0, static_cast<itk::IndexValueType>(k) } };
    const auto origin =
      options.Move(volume->TransformIndexToPhysicalPoint<double>(first), static_cast<int>(k));
    const auto set = [&](const std::string& tag, const std::string& value)
    { itk::EncapsulateMetaData<std::string>(dictionaries[k], tag, value); };
    set("0008|0016", "1.2.840.10008.5.1.4.1.1.2"); // CT image
    set("0008|0060", "CT");
    set("0008|103e", options.Description);
    set("0020|000d", UID);
    set("0020|000e", options.Series);
    set("0008|0018", options.Series + "." + std::to_string(k + 1));
    set("0020|0013", std::to_string(k + 1));
    set("0020|0032", Text({ origin[0], origin[1], origin[2] }));
    set("0020|0037",
      Text({ direction[0][0], direction[1][0], direction[2][0], direction[0][1], direction[1][1],
        direction[2][1] }));
    set("0028|1052", "0");
    set("0028|1053", "1");
    pointers.push_back(&dictionaries[k]);
    // 3 is prime to the numbers of slices used here: each name once.
    names.push_back(folder / (options.Prefix + std::to_string((3 * k + 2) % size[2]) + ".dcm"));
  }

  gdcm::Trace::WarningOff(); // of what it writes itself
  auto io = itk::GDCMImageIO::New();
  io->SetKeepOriginalUID(true);
  auto writer = itk::ImageSeriesWriter<Volume, Slice>::New();
  writer->SetInput(volume);
  writer->SetImageIO(io);
  writer->SetFileNames(names);
  writer->SetMetaDataDictionaryArray(&pointers);
  io->SetCompressionType(options.Compression);
  writer->SetUseCompression(options.IsCompressed);
  writer->Update();
  gdcm::Trace::WarningOn();
}

void ExpectRefusal(vtkMedicalImageReader* reader, const std::vector<std::string>& words)
{
  ExampleImages::ExpectRefusal(reader, words, [reader]() { reader->Update(); });
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

vtkSmartPointer<vtkMedicalImageReader> ReaderOf(const ExampleImages::Folder& folder)
{
  auto reader = vtkSmartPointer<vtkMedicalImageReader>::New();
  reader->SetFileName(folder.Name().c_str());
  return reader;
}

vtkSmartPointer<vtkImageData> ObliqueImage()
{
  return ExampleImages::Make(VTK_SHORT, ExampleImages::Directions()[4].Matrix);
}

class TestDicomDirections : public testing::TestWithParam<ExampleImages::NamedDirection>
{
};

TEST_P(TestDicomDirections, EveryVoxelIsWhereItWas)
{
  ExampleImages::Folder folder;
  auto image = ExampleImages::Make(VTK_SHORT, GetParam().Matrix);
  WriteSeries(image, folder);
  auto reader = ReaderOf(folder);
  reader->Update();
  vtkImageData* back = reader->GetOutput();
  ASSERT_EQ(back->GetNumberOfPoints(), image->GetNumberOfPoints());
  EXPECT_EQ(back->GetScalarType(), VTK_SHORT);
  // Slices are stacked right-handed, so that a left-handed image comes back with its third axis
  // reversed; what must not change is the place of each gray value.
  double point[3];
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    image->GetPoint(i, point);
    const vtkIdType there = back->FindPoint(point);
    ASSERT_GE(there, 0);
    double pointThere[3];
    back->GetPoint(there, pointThere);
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_NEAR(pointThere[axis], point[axis], 1e-6);
    }
    ASSERT_EQ(back->GetPointData()->GetScalars()->GetComponent(there, 0),
      image->GetPointData()->GetScalars()->GetComponent(i, 0));
  }
  if (back->GetDirectionMatrix()->Determinant() * image->GetDirectionMatrix()->Determinant() > 0)
  {
    ExampleImages::ExpectSameGeometry(back, image, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, TestDicomDirections,
  testing::ValuesIn(ExampleImages::Directions()),
  [](const auto& parameter) { return std::string(parameter.param.Name); });

TEST(TestDicomSeries, TheSeriesWithMostSlicesUnlessToldOtherwise)
{
  ExampleImages::Folder folder;
  auto longer = ObliqueImage();
  auto shorter = vtkSmartPointer<vtkImageData>::New();
  shorter->SetDimensions(6, 3, 4);
  shorter->AllocateScalars(VTK_SHORT, 1);
  shorter->GetPointData()->GetScalars()->Fill(-1000);
  SeriesOptions options;
  WriteSeries(longer, folder, options);
  options.Prefix = "b";
  options.Series = UID + ".2";
  options.Description = "Shorter";
  WriteSeries(shorter, folder, options);
  ExampleImages::WriteBytes(folder / "notes.txt", std::string(300, 'n'));

  auto reader = ReaderOf(folder);
  reader->UpdateInformation();
  ASSERT_EQ(reader->GetNumberOfSeries(), 2);
  EXPECT_EQ(reader->GetSeriesUID(0), UID + ".1");
  EXPECT_EQ(reader->GetSeriesUID(1), UID + ".2");
  EXPECT_EQ(reader->GetSeriesDescription(0), "Example");
  EXPECT_EQ(reader->GetSeriesDescription(1), "Shorter");
  EXPECT_EQ(reader->GetSeriesNumberOfSlices(0), 5);
  EXPECT_EQ(reader->GetSeriesNumberOfSlices(1), 4);
  EXPECT_EQ(reader->GetSeriesUID(2), "");
  EXPECT_EQ(reader->GetSeriesModality(0), "CT");
  double spacing[3];
  reader->GetSeriesSpacing(0, spacing);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(spacing[axis], longer->GetSpacing()[axis], 1e-9);
  }
  EXPECT_EQ(reader->GetChosenSeriesUID(), UID + ".1");
  reader->Update();
  ExampleImages::ExpectSameVoxels(reader->GetOutput(), longer);
  auto* told = vtkStringArray::SafeDownCast(
    reader->GetOutput()->GetFieldData()->GetAbstractArray("SeriesUID"));
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->GetValue(0), UID + ".1");

  reader->SetSeriesUID((UID + ".2").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetChosenSeriesUID(), UID + ".2");
  ExampleImages::ExpectSameVoxels(reader->GetOutput(), shorter);

  reader->SetSeriesUID("1.2.3");
  ExpectRefusal(reader, { "1.2.3", UID + ".1", UID + ".2" });
}

TEST(TestDicomSeries, TiltedGantryShearsTheGrid)
{
  ExampleImages::Folder folder;
  auto image = ObliqueImage();
  SeriesOptions options;
  const double tilt = 0.6; // mm per slice, along the second axis
  options.Move = [&](itk::Point<double, 3> point, int slice)
  {
    for (unsigned int i = 0; i < 3; ++i)
    {
      point[i] += tilt * slice * image->GetDirectionMatrix()->GetElement(static_cast<int>(i), 1);
    }
    return point;
  };
  WriteSeries(image, folder, options);
  auto reader = ReaderOf(folder);
  ExampleImages::Errors errors(reader);
  reader->Update();
  EXPECT_EQ(errors.Warning(), "");
  vtkImageData* back = reader->GetOutput();
  double expected[3];
  image->TransformContinuousIndexToPhysicalPoint(5, 1 + tilt * 2 / image->GetSpacing()[1], 2,
    expected);
  const auto place = ExampleImages::FindMark(back);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(place[i], expected[i], 1e-6);
  }
}

TEST(TestDicomSeries, UnevenStackWarnsAndMissingSliceIsRefused)
{
  auto image = ObliqueImage();
  const auto write =
    [&](const ExampleImages::Folder& folder, const std::function<double(int)>& shift)
  {
    SeriesOptions options; // slices shifted along their normal
    options.Move = [&](itk::Point<double, 3> point, int slice)
    {
      for (int i = 0; i < 3; ++i)
      {
        point[static_cast<unsigned int>(i)] +=
          shift(slice) * image->GetDirectionMatrix()->GetElement(i, 2);
      }
      return point;
    };
    WriteSeries(image, folder, options);
  };
  ExampleImages::Folder uneven;
  write(uneven, [](int slice) { return slice == 3 ? 0.5 : 0; });
  auto reader = ReaderOf(uneven);
  ExampleImages::Errors errors(reader);
  reader->Update();
  EXPECT_EQ(errors.Count(), 0);
  EXPECT_NE(errors.Warning().find("0.5 mm"), std::string::npos) << errors.Warning();
  ExampleImages::ExpectSameVoxels(reader->GetOutput(), image);

  ExampleImages::Folder gap;
  write(gap, [](int slice) { return slice > 3 ? 3 * 3.5 : 0; });
  ExpectRefusal(ReaderOf(gap), { "missing", UID + ".1" });

  ExampleImages::Folder same; // one place at five times
  write(same, [](int slice) { return -3.5 * slice; });
  ExpectRefusal(ReaderOf(same), { "the same place", UID + ".1" });
}

TEST(TestDicomSeries, VolumesOfOneSeriesAreListedAndChosen)
{
  ExampleImages::Folder folder;
  auto image = ObliqueImage();
  WriteSeries(image, folder);
  auto other = vtkSmartPointer<vtkImageData>::New();
  other->SetDimensions(6, 3, 2);
  other->AllocateScalars(VTK_SHORT, 1);
  other->GetPointData()->GetScalars()->Fill(7);
  SeriesOptions options;
  options.Prefix = "b";
  WriteSeries(other, folder, options);
  auto reader = ReaderOf(folder);
  ExpectRefusal(reader, { "2 volumes", UID + ".1#1", UID + ".1#2" });
  ASSERT_TRUE(reader->FindSeries());
  ASSERT_EQ(reader->GetNumberOfSeries(), 2);
  EXPECT_EQ(reader->GetSeriesUID(1), UID + ".1#2");
  EXPECT_EQ(reader->GetChosenSeriesUID(), nullptr);
  reader->SetSeriesUID((UID + ".1#1").c_str());
  reader->Update();
  ExampleImages::ExpectSameVoxels(reader->GetOutput(), image);
  auto* told = vtkStringArray::SafeDownCast(
    reader->GetOutput()->GetFieldData()->GetAbstractArray("SeriesUID"));
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->GetValue(0), UID + ".1#1");
}

TEST(TestDicomSeries, OneWarningSaysWhatIsLeftOut)
{
  ExampleImages::Folder folder;
  auto image = ObliqueImage();
  WriteSeries(image, folder);
  const std::string bytes = ExampleImages::ReadBytes(folder / "a3.dcm");
  ExampleImages::WriteBytes(folder / "a3 (copy).dcm", bytes);
  ExampleImages::WriteBytes(folder / "page.dcm", "<html>");
  ExampleImages::WriteBytes(folder / "._a3.dcm", std::string("\0\5\x16\7", 4));
  std::filesystem::create_directory(folder / "nested");
  auto reader = ReaderOf(folder);
  ExampleImages::Errors errors(reader);
  reader->Update();
  EXPECT_EQ(errors.Count(), 0);
  for (const std::string word : { "2 files are left out", "the same slice again", "not DICOM" })
  {
    EXPECT_NE(errors.Warning().find(word), std::string::npos) << errors.Warning();
  }
  ExampleImages::ExpectSameVoxels(reader->GetOutput(), image);
}

TEST(TestDicomSeries, CompressedSlices)
{
  // Not as small as the others: GDCM's encoder of JPEG 2000 fails at those.
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(64, 48, 4);
  image->AllocateScalars(VTK_SHORT, 1);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    image->GetPointData()->GetScalars()->SetComponent(voxel, 0,
      static_cast<double>(voxel * 37 % 2000 - 1000));
  }
  for (const auto compression :
    { itk::GDCMImageIO::CompressionEnum::JPEG, itk::GDCMImageIO::CompressionEnum::JPEG2000 })
  {
    ExampleImages::Folder folder;
    SeriesOptions options;
    options.IsCompressed = true;
    options.Compression = compression;
    WriteSeries(image, folder, options);
    auto reader = ReaderOf(folder);
    reader->Update();
    ExampleImages::ExpectSameVoxels(reader->GetOutput(), image);
    // Cut off within the last slice's pixels, or damaged there.
    const std::string bytes = ExampleImages::ReadBytes(folder / "a3.dcm");
    ExampleImages::WriteBytes(folder / "a3.dcm", bytes.substr(0, bytes.size() - 20));
    ExpectRefusal(ReaderOf(folder), { "a3.dcm" });
    std::string damaged = bytes;
    const std::size_t item = bytes.rfind(std::string("\xFE\xFF\x00\xE0", 4));
    std::fill(damaged.begin() + static_cast<std::ptrdiff_t>(item) + 8, damaged.end() - 8, '\0');
    ExampleImages::WriteBytes(folder / "a3.dcm", damaged);
    ExpectRefusal(ReaderOf(folder), { "a3.dcm", "damaged" });
  }
}

TEST(TestDicomSeries, AnUnreadableSliceIsAnError)
{
  ExampleImages::Folder folder;
  WriteSeries(ObliqueImage(), folder);
  std::filesystem::remove(folder / "a4.dcm");
  std::filesystem::create_symlink("nowhere.dcm", folder / "a4.dcm");
  ExpectRefusal(ReaderOf(folder), { "a4.dcm", "cannot be opened", "may be a slice" });
}

TEST(TestDicomSeries, FolderWithoutImages)
{
  ExampleImages::Folder folder;
  ExpectRefusal(ReaderOf(folder), { folder.Name(), "no DICOM image" });
  ExampleImages::WriteBytes(folder / "notes.txt", std::string(3000, 'n'));
  ExpectRefusal(ReaderOf(folder), { folder.Name(), "no DICOM image" });
}

TEST(TestDicomSeries, ASingleFileAsksForItsFolder)
{
  ExampleImages::Folder folder;
  WriteSeries(ObliqueImage(), folder);
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName((folder / "a0.dcm").c_str());
  ExpectRefusal(reader, { "a0.dcm", "folder" });
}

TEST(TestDicomSeries, AFileOfSeveralFramesIsAVolume)
{
  ExampleImages::Folder folder;
  std::vector<ExampleDicom::Frame> frames;
  std::vector<int> values;
  for (int slice = 0; slice < 5; ++slice)
  {
    frames.push_back({ "10\\20\\" + std::to_string(3 * slice) });
    values.insert(values.end(), 12, 100 * slice);
  }
  ExampleDicom::Options options;
  options.Pixels = ExampleDicom::Shorts(values);
  ExampleImages::WriteBytes(folder / "enhanced.dcm",
    ExampleDicom::FileOf(ExampleDicom::Enhanced(options, frames)));
  WriteSeries(ObliqueImage(), folder); // of which nothing is said
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName((folder / "enhanced.dcm").c_str());
  ExampleImages::Errors errors(reader);
  reader->Update();
  EXPECT_EQ(errors.Count(), 0);
  EXPECT_EQ(errors.Warning(), "");
  int size[3];
  reader->GetOutput()->GetDimensions(size);
  EXPECT_EQ(size[2], 5);
  EXPECT_EQ(reader->GetOutput()->GetScalarComponentAsDouble(0, 0, 4, 0), 400);
  EXPECT_EQ(std::string(reader->GetChosenSeriesUID()), options.Series);
  ASSERT_TRUE(reader->FindSeries());
  EXPECT_EQ(reader->GetNumberOfSeries(), 1);
  reader->SetSeriesUID("9.9");
  ExpectRefusal(reader, { "The file", "enhanced.dcm", "holds no series '9.9'" });
}

TEST(TestDicomSeries, FoldersBesideADirectoryAreSearched)
{
  ExampleImages::Folder folder;
  auto image = ObliqueImage();
  std::filesystem::create_directories(folder / "IMAGES/S1");
  SeriesOptions options;
  options.Prefix = "IMAGES/S1/a";
  WriteSeries(image, folder, options);
  ExpectRefusal(ReaderOf(folder), { "no DICOM image" });
  for (const char* name : { "DICOMDIR", "dicomdir" })
  {
    ExampleImages::WriteBytes(folder / name, "damaged");
    auto reader = ReaderOf(folder);
    ExampleImages::Errors errors(reader);
    reader->Update();
    EXPECT_EQ(errors.Warning(), "");
    ExampleImages::ExpectSameVoxels(reader->GetOutput(), image);
    std::filesystem::remove(folder / name);
  }
}

TEST(TestDicomSeries, TruncatedAtAnyPlace)
{
  ExampleImages::Folder folder;
  WriteSeries(ObliqueImage(), folder);
  const std::string bytes = ExampleImages::ReadBytes(folder / "a3.dcm");
  for (std::size_t size = 132; size < bytes.size(); ++size)
  {
    SCOPED_TRACE(size);
    ExampleImages::WriteBytes(folder / "a3.dcm", bytes.substr(0, size));
    auto reader = ReaderOf(folder);
    ExpectRefusal(reader, { "a3.dcm" });
  }
}

TEST(TestDicomSeries, DamagedSoThatGdcmWouldStopTheProgram)
{
  ExampleImages::Folder folder;
  WriteSeries(ObliqueImage(), folder);
  const std::string bytes = ExampleImages::ReadBytes(folder / "a3.dcm");
  // The type of an element of the first group: no such type.
  const std::size_t type = bytes.find("UI");
  std::string damaged = bytes;
  damaged[type + 1] = 'J';
  ExampleImages::WriteBytes(folder / "a3.dcm", damaged);
  ExpectRefusal(ReaderOf(folder), { "a3.dcm", "no known type" });
  // Fewer pixels than rows and columns say.
  damaged = bytes.substr(0, bytes.size() - 10);
  const std::size_t pixels = bytes.rfind(std::string("\xE0\x7F\x10\x00", 4));
  ASSERT_NE(pixels, std::string::npos);
  for (std::size_t length = pixels + 4; length < pixels + 12; ++length)
  {
    if (damaged[length] == 56) // 7 x 4 voxels of two bytes
    {
      damaged[length] = 46;
    }
  }
  ExampleImages::WriteBytes(folder / "a3.dcm", damaged);
  ExpectRefusal(ReaderOf(folder), { "a3.dcm", "fewer pixels" });
  // The end of an item that has not begun, and that has a length.
  const std::string item("\xFE\xFF\x0D\xE0\x02\x00\x00\x00\x00\x00", 10);
  damaged = bytes;
  ExampleImages::WriteBytes(folder / "a3.dcm", damaged.insert(pixels, item));
  ExpectRefusal(ReaderOf(folder), { "a3.dcm", "outside of a sequence" });
  // Behind the pixels, nothing matters.
  ExampleImages::WriteBytes(folder / "a3.dcm", bytes + item);
  auto reader = ReaderOf(folder);
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::NoError);
}

TEST(TestDicomSeries, ReportsAndContoursArePassedOver)
{
  ExampleImages::Folder folder;
  WriteSeries(ObliqueImage(), folder);
  const std::string structures = "1.2.840.10008.5.1.4.1.1.481.3";
  // A structure set: another class of object, and no pixels.
  std::string other(128, '\0');
  const auto element = [&other](int number, const std::string& type, std::string value)
  {
    value.resize(value.size() + value.size() % 2, '\0');
    other += std::string("\2\0", 2) + static_cast<char>(number) + '\0' + type +
      static_cast<char>(value.size()) + '\0' + value;
  };
  other += "DICM";
  element(0x02, "UI", structures);
  element(0x10, "UI", "1.2.840.10008.1.2.1");
  ExampleImages::WriteBytes(folder / "structures.dcm", other);
  auto reader = ReaderOf(folder);
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(reader->GetNumberOfSeries(), 1);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 140);
}

} // namespace
