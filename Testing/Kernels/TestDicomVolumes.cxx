// Which files of a folder make up which volumes, where these lie, and what is left out.
#include "Exchange/DicomChoice.h"
#include "Exchange/DicomReading.h"
#include "Exchange/DicomVolumes.h"
#include "Exchange/FileProblem.h"

#include "ExampleDicom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace
{

using namespace FlipFree;

const std::string Plain = "1.2.840.10008.1.2.1";

/// Files in memory.
class ExampleFolder
{
public:
  void Add(const std::string& name, const std::string& bytes)
  {
    this->Names.push_back(name);
    this->Bytes.push_back(bytes);
  }

  /// A slice with pixels of one value, at this height.
  void AddSlice(const std::string& name, double z, ExampleDicom::Options options = {},
    int value = 0)
  {
    options.Instance += name;
    std::ostringstream position;
    position << "10\\20\\" << z;
    options.Position = options.Position.empty() ? "" : position.str();
    options.Pixels = ExampleDicom::Shorts(
      std::vector<int>(static_cast<std::size_t>(options.Columns * options.Rows), value));
    this->Add(name, ExampleDicom::FileOf(ExampleDicom::Slice(options)));
  }

  /// Slices of 3 mm, from the top.
  void AddSeries(const std::string& prefix, int count, const ExampleDicom::Options& options = {},
    int value = 0)
  {
    for (int slice = 0; slice < count; ++slice)
    {
      const int place = count - 1 - slice;
      this->AddSlice(prefix + std::to_string(slice) + ".dcm", 3. * place, options,
        value + 100 * place);
    }
  }

  void Remove(const std::string& name)
  {
    const auto found = std::find(this->Names.begin(), this->Names.end(), name);
    ASSERT_NE(found, this->Names.end());
    this->Bytes.erase(this->Bytes.begin() + (found - this->Names.begin()));
    this->Names.erase(found);
  }

  DicomFolder Read() const
  {
    std::vector<DicomFile> files;
    for (std::size_t index = 0; index < this->Names.size(); ++index)
    {
      std::istringstream stream(this->Bytes[index]);
      files.push_back({ "folder/" + this->Names[index],
        this->Bytes[index].empty() ? "it is empty" : "", ReadDicomDataSet(stream) });
    }
    return FindDicomVolumes("folder", std::move(files),
      [this](const DicomFile& file, std::size_t frame)
      {
        ++this->Reads;
        const auto index = std::find(this->Names.begin(), this->Names.end(), file.Name.substr(7)) -
          this->Names.begin();
        std::istringstream stream(this->Bytes[static_cast<std::size_t>(index)]);
        return ReadCodedFrame(stream, file.Data, frame);
      });
  }

  std::vector<std::string> Names;
  std::vector<std::string> Bytes;
  mutable int Reads = 0; // of pixels
};

std::string WhyRefused(const DicomFolder& folder, const std::string& wanted = "")
{
  try
  {
    ChooseDicomVolume(folder, wanted);
  }
  catch (const FileProblem& problem)
  {
    return problem.what();
  }
  return {};
}

void ExpectRefusal(const DicomFolder& folder, const std::vector<std::string>& words,
  const std::string& wanted = "")
{
  const std::string message = WhyRefused(folder, wanted);
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
  }
}

void ExpectWords(const std::string& text, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
  }
}

TEST(DicomVolumes, SlicesByTheirPositions)
{
  ExampleFolder folder;
  folder.AddSeries("a", 5);
  const DicomFolder found = folder.Read();
  const DicomVolume& volume = ChooseDicomVolume(found, "");
  EXPECT_EQ(volume.Identifier(), ExampleDicom::Options().Series);
  EXPECT_EQ(volume.SeriesNumber, "3");
  EXPECT_EQ(volume.Description, "Example");
  EXPECT_EQ(volume.Modality, "CT");
  EXPECT_EQ(volume.Warning + WarningOfLeftOut(found, volume), "");
  EXPECT_EQ(volume.Geometry.Dimensions, (std::array<int, 3>{ 4, 3, 5 }));
  EXPECT_EQ(volume.Geometry.Origin, Eigen::Vector3d(10, 20, 0));
  EXPECT_EQ(volume.Geometry.Spacing, Eigen::Vector3d(1, 2, 3)); // columns, rows, slices
  EXPECT_EQ(volume.Geometry.Direction, Eigen::Matrix3d::Identity());
  EXPECT_EQ(found.Files[volume.Frames.front().File].Name, "folder/a4.dcm");
  EXPECT_EQ(volume.Type, VoxelType::Int16);
}

TEST(DicomVolumes, MissingSlicesWhereverTheyAre)
{
  for (const int missing : { 1, 5, 18, 28 })
  {
    ExampleFolder folder;
    folder.AddSeries("a", 30);
    folder.Remove("a" + std::to_string(missing) + ".dcm");
    ExpectRefusal(folder.Read(),
      { "1 slice is missing", "'a" + std::to_string(missing + 1) + ".dcm'",
        "'a" + std::to_string(missing - 1) + ".dcm'", "6 mm apart instead of 3 mm" });
  }
}

TEST(DicomVolumes, AMissingSliceOfFew)
{
  ExampleFolder folder;
  folder.AddSeries("a", 4);
  folder.Remove("a2.dcm");
  ExpectRefusal(folder.Read(), { "1 slice is missing", "6 mm apart instead of 3 mm" });
}

TEST(DicomVolumes, UnevenSlicesAreNotMissingOnes)
{
  ExampleFolder folder;
  double z = 0;
  for (int slice = 0; slice < 20; ++slice)
  {
    folder.AddSlice("a" + std::to_string(slice), z);
    z += slice < 10 ? 3 : 5;
  }
  ExpectRefusal(folder.Read(), { "unevenly spaced", "3 to 5 mm" });
  ExampleFolder coarser; // every second one from the middle on
  for (int slice = 0; slice < 20; ++slice)
  {
    coarser.AddSlice("a" + std::to_string(slice), 3 * (slice < 12 ? slice : 2 * slice - 11));
  }
  ExpectRefusal(coarser.Read(), { "unevenly spaced", "3 to 6 mm" });
  ExampleFolder little;
  for (int slice = 0; slice < 20; ++slice)
  {
    little.AddSlice("a" + std::to_string(slice), 3 * slice + (slice == 7 ? 0.5 : 0));
  }
  ExpectWords(ChooseDicomVolume(little.Read(), "").Warning, { "unevenly", "0.5 mm", "a7" });
}

TEST(DicomVolumes, ATiltedGantryLeansTheThirdAxis)
{
  ExampleFolder folder;
  for (int slice = 0; slice < 6; ++slice)
  {
    ExampleDicom::Options options;
    options.Instance += std::to_string(slice);
    options.Position = "0\\" + std::to_string(slice) + "\\" + std::to_string(3 * slice);
    options.Pixels = std::string(24, '\0');
    folder.Add("a" + std::to_string(slice), ExampleDicom::FileOf(ExampleDicom::Slice(options)));
  }
  const DicomFolder found = folder.Read();
  const ImageGeometry& grid = ChooseDicomVolume(found, "").Geometry;
  EXPECT_NEAR((grid.ToPhysical({ 0, 0, 5 }) - Eigen::Vector3d(0, 5, 15)).norm(), 0, 1e-9);
  EXPECT_NEAR(grid.Spacing[2], std::sqrt(10.), 1e-12);
}

TEST(DicomVolumes, EnhancedFramesByTheirPlaces)
{
  // Out of order, tilted, a rescale for each.
  ExampleDicom::Options options;
  options.Pixels = std::string(24 * 4, '\0');
  const std::vector<ExampleDicom::Frame> frames{ { R"(0\2\6)", "1", 0, "1.5", "1" },
    { R"(0\0\0)", "1", 0, "2", "2" }, { R"(0\3\9)", "1", 0, "0.5", "3" },
    { R"(0\1\3)", "1", 0, "1", "4" } };
  ExampleFolder folder;
  folder.Add("e.dcm", ExampleDicom::FileOf(ExampleDicom::Enhanced(options, frames)));
  const DicomFolder found = folder.Read();
  const DicomVolume& volume = ChooseDicomVolume(found, "");
  std::vector<std::size_t> order;
  std::vector<double> intercepts;
  for (const DicomFrame& frame : volume.Frames)
  {
    order.push_back(frame.Number);
    intercepts.push_back(frame.Rescale.Intercept);
  }
  EXPECT_EQ(order, (std::vector<std::size_t>{ 1, 3, 0, 2 }));
  EXPECT_EQ(intercepts, (std::vector<double>{ 2, 4, 1, 3 }));
  EXPECT_EQ(volume.Type, VoxelType::Float32);
  EXPECT_NEAR((volume.Geometry.ToPhysical({ 0, 0, 3 }) - Eigen::Vector3d(0, 3, 9)).norm(), 0, 1e-9);

  auto gap = frames;
  gap[2].Position = R"(0\4\12)";
  ExampleFolder with;
  with.Add("e.dcm", ExampleDicom::FileOf(ExampleDicom::Enhanced(options, gap)));
  ExpectRefusal(with.Read(), { "1 slice is missing", "frame 1 of 'e.dcm'", "frame 3 of 'e.dcm'" });

  auto twice = frames;
  twice[2].Position = twice[0].Position;
  ExampleFolder same;
  same.Add("e.dcm", ExampleDicom::FileOf(ExampleDicom::Enhanced(options, twice)));
  ExpectRefusal(same.Read(), { "at the same place", "Export each volume as a series of its own" });
}

TEST(DicomVolumes, SeveralVolumesAreChosenByNumber)
{
  ExampleDicom::Options options;
  options.Pixels = std::string(24 * 6, '\0');
  // Times, mixed; then stacks, one behind the other with a gap between them; then times of stacks.
  std::vector<ExampleDicom::Frame> times;
  std::vector<ExampleDicom::Frame> stacks;
  for (int frame = 0; frame < 6; ++frame)
  {
    times.push_back({ R"(0\0\)" + std::to_string(frame / 2 * 3), "1", 2 - frame % 2, "", "" });
    stacks.push_back({ R"(0\0\)" + std::to_string(frame < 3 ? 3 * frame : 100 + 3 * frame),
      frame < 3 ? "A" : "B", 0, "", "" });
  }
  for (const auto& frames : { times, stacks })
  {
    ExampleFolder folder;
    folder.Add("e.dcm", ExampleDicom::FileOf(ExampleDicom::Enhanced(options, frames)));
    const DicomFolder found = folder.Read();
    ASSERT_EQ(found.Volumes.size(), 2U);
    const std::string uid = options.Series;
    ExpectRefusal(found, { "2 volumes", uid + "#1", uid + "#2", "3 slices" });
    ExpectRefusal(found, { "2 volumes" }, uid);
    ExpectRefusal(found, { uid + "#3", "holds no series" }, uid + "#3");
    ExpectRefusal(found, { "holds no series '#1'" }, "#1");
    for (const std::string number : { "#1", "#2" })
    {
      const DicomVolume& volume = ChooseDicomVolume(found, uid + number);
      EXPECT_EQ(volume.Identifier(), uid + number);
      EXPECT_EQ(volume.Geometry.Spacing[2], 3);
      ExpectWords(WarningOfLeftOut(found, volume), { "3 slices belong to other volumes" });
    }
  }
  ExampleFolder folder;
  folder.Add("e.dcm", ExampleDicom::FileOf(ExampleDicom::Enhanced(options, times)));
  const DicomFolder found = folder.Read();
  EXPECT_EQ(ChooseDicomVolume(found, options.Series + "#1").Frames.front().Number, 1U);
}

TEST(DicomVolumes, TwoAcquisitionsAtOnePlace)
{
  ExampleFolder folder;
  ExampleDicom::Options options;
  options.Acquisition = 1;
  folder.AddSeries("a", 8, options, 5);
  options.Acquisition = 10;
  folder.AddSeries("b", 8, options, 5); // as a copy would be, but another acquisition
  const DicomFolder found = folder.Read();
  ASSERT_EQ(found.Volumes.size(), 2U);
  const DicomVolume& first = ChooseDicomVolume(found, options.Series + "#1");
  EXPECT_EQ(found.Files[first.Frames.front().File].Name, "folder/a7.dcm");

  // Nothing tells these apart.
  ExampleFolder mixed;
  mixed.AddSeries("a", 8, {}, 5);
  mixed.AddSeries("b", 8, {}, 6);
  const DicomFolder same = mixed.Read();
  ASSERT_EQ(same.Volumes.size(), 1U);
  ExpectRefusal(same, { "at the same place", "'a7.dcm'", "'b7.dcm'" });
}

TEST(DicomVolumes, TwoEnhancedFilesAtOnePlace)
{
  ExampleDicom::Options options;
  options.Pixels = std::string(24 * 3, '\0');
  ExampleFolder folder;
  const std::vector<ExampleDicom::Frame> frames{ { R"(0\0\0)" }, { R"(0\0\3)" }, { R"(0\0\6)" } };
  folder.Add("e1.dcm", ExampleDicom::FileOf(ExampleDicom::Enhanced(options, frames)));
  options.Pixels = std::string(24 * 3, '\1');
  options.Instance += "2";
  folder.Add("e2.dcm", ExampleDicom::FileOf(ExampleDicom::Enhanced(options, frames)));
  ExpectRefusal(folder.Read(), { options.Series + "#1", options.Series + "#2" });
}

TEST(DicomVolumes, TheSameSliceTwice)
{
  ExampleFolder folder;
  folder.AddSeries("a", 6);
  folder.Add("a2 (copy).dcm", folder.Bytes[2]); // the same instance
  folder.AddSlice("again.dcm", 9, {}, 300);     // sent again as another
  const DicomFolder found = folder.Read();
  const DicomVolume& volume = ChooseDicomVolume(found, "");
  EXPECT_EQ(volume.Frames.size(), 6U);
  ExpectWords(WarningOfLeftOut(found, volume), { "2 files are left out", "the same slice again" });
  // The same name, but not the same pixels.
  std::string other = folder.Bytes[2];
  other.back() = '\x7F';
  folder.Add("a2 (edited).dcm", other);
  ExpectRefusal(folder.Read(), { "at the same place", "a2 (edited).dcm" });
}

TEST(DicomVolumes, ManySlicesAtOnePlaceAreEachReadAFewTimes)
{
  ExampleFolder folder;
  constexpr int count = 60;
  for (int slice = 0; slice < count; ++slice)
  {
    folder.AddSlice("a" + std::to_string(slice), 3, {}, slice);
    folder.AddSlice("b" + std::to_string(slice), 6, {}, 0);
  }
  const DicomFolder found = folder.Read();
  ASSERT_EQ(found.Volumes.size(), 1U);
  EXPECT_EQ(found.Volumes.front().Frames.size(), count + 1U);
  EXPECT_EQ(found.LeftOut.size(), count - 1U);
  EXPECT_LE(folder.Reads, 6 * 2 * count);
}

TEST(DicomVolumes, WhatIsNoSliceIsLeftOutAndCounted)
{
  ExampleFolder folder;
  folder.AddSeries("a", 8);
  ExampleDicom::Options scout;
  scout.Orientation = R"(1\0\0\0\0\-1)";
  scout.Rows = 5;
  folder.AddSlice("scout.dcm", 0, scout);
  ExampleDicom::Options screen;
  screen.Position = "";
  screen.Columns = 9;
  folder.AddSlice("screen.dcm", 0, screen);
  ExampleDicom::Options colors;
  colors.Samples = 3;
  colors.Colors = "RGB";
  folder.AddSlice("colors.dcm", 0, colors);
  ExampleDicom::DataSet report;
  report.Add(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.88.11").Add(0x0020000E, "UI", "7.7");
  folder.Add("report.dcm", ExampleDicom::FileOf(report));
  ExampleDicom::DataSet map;
  map.Add(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.30").Add(0x0020000E, "UI", "7.8");
  map.Add(0x7FE00008, "OW", std::string(48, '\0'));
  folder.Add("map.dcm", ExampleDicom::FileOf(map));
  ExampleDicom::Options other;
  other.Series = "9.9";
  folder.AddSlice("half.dcm", 0, other);
  folder.Bytes.back().resize(folder.Bytes.back().size() - 10);
  folder.Add("page.dcm", "<html>not found</html>");
  folder.Add("notes.txt", "notes");
  folder.Add("empty.txt", "");
  const DicomFolder found = folder.Read();
  const DicomVolume& volume = ChooseDicomVolume(found, "");
  EXPECT_EQ(volume.Frames.size(), 8U);
  EXPECT_EQ(volume.Identifier(), ExampleDicom::Options().Series);
  ExpectWords(WarningOfLeftOut(found, volume),
    { "8 files are left out", "2 damaged", "'half.dcm'", "1 not DICOM ('page.dcm')",
      "2 without gray values", "1 in colors ('colors.dcm')", "1 without a place", "1 a scout" });
}

TEST(DicomVolumes, ASliceOfAnotherGridIsNamedWhereOneIsMissing)
{
  const auto read = [](const std::function<void(ExampleDicom::Options&)>& change, int count)
  {
    ExampleFolder folder;
    folder.AddSeries("a", 12);
    for (int slice = 4; slice < 4 + count; ++slice)
    {
      ExampleDicom::Options other;
      change(other);
      folder.Remove("a" + std::to_string(11 - slice) + ".dcm");
      folder.AddSlice("b" + std::to_string(slice) + ".dcm", 3. * slice, other);
    }
    return folder.Read();
  };
  const auto resize = [](ExampleDicom::Options& other) { other.Columns = 7; };
  const auto space = [](ExampleDicom::Options& other) { other.Spacing = R"(2\1.5)"; };
  const auto turn = [](ExampleDicom::Options& other)
  { other.Orientation = R"(0.8\0.6\0\-0.6\0.8\0)"; };
  for (const int count : { 1, 2 })
  {
    const std::string missing = count == 1 ? "1 slice is missing" : "2 slices are missing";
    ExpectRefusal(read(resize, count),
      { missing, "A missing slice may be 'b4.dcm', which has 7 x 3 pixels, not 4 x 3" });
    ExpectRefusal(read(space, count),
      { missing, "'b4.dcm', which has pixels of 1.5 x 2 mm, not 1 x 2 mm" });
    ExpectRefusal(read(turn, count),
      { missing, "'b4.dcm', which has axes that are turned by 36.8" });
  }
  // A scout is none.
  const DicomFolder found = read(
    [](ExampleDicom::Options& other)
    {
      other.Columns = 7;
      other.ImageType = R"(ORIGINAL\PRIMARY\LOCALIZER)";
    },
    1);
  EXPECT_EQ(WhyRefused(found).find("may be"), std::string::npos) << WhyRefused(found);
}

TEST(DicomVolumes, FewSlicesOfAnotherGridAreLeftOutAndSaidHow)
{
  ExampleFolder folder;
  folder.AddSeries("a", 12);
  ExampleDicom::Options other;
  other.Rows = 5;
  folder.AddSlice("b.dcm", 40, other);
  const DicomFolder one = folder.Read();
  ExpectWords(WarningOfLeftOut(one, ChooseDicomVolume(one, "")),
    { "1 file is left out", "'b.dcm' has 4 x 5 pixels, not 4 x 3" });
  folder.AddSlice("c.dcm", 43, other);
  const DicomFolder two = folder.Read();
  ExpectWords(WarningOfLeftOut(two, ChooseDicomVolume(two, "")),
    { "2 slices belong to other volumes", "#2 (4 x 5 pixels, not 4 x 3)" });
}

TEST(DicomVolumes, ADirectoryIsNoSliceHoweverDamaged)
{
  ExampleDicom::DataSet directory;
  directory.Add(0x00080016, "UI", "1.2.840.10008.1.3.10");
  directory.Add(0x00041130, "CS", "EXAMPLE");
  const std::string whole = ExampleDicom::FileOf(directory);
  for (std::size_t size = 0; size <= whole.size(); ++size)
  {
    ExampleFolder folder;
    folder.AddSeries("a", 4);
    folder.Add("DICOMDIR", whole.substr(0, size));
    EXPECT_EQ(WhyRefused(folder.Read()), "") << size;
  }
}

TEST(DicomVolumes, ADamagedFileOfTheSeriesIsAnError)
{
  ExampleFolder folder;
  folder.AddSeries("a", 8);
  folder.Bytes[3].resize(folder.Bytes[3].size() - 10);
  ExpectRefusal(folder.Read(), { "a3.dcm", "ends within its pixels", "again" });
  // It does not make another series of as many slices the greatest.
  ExampleFolder two = folder;
  ExampleDicom::Options other;
  other.Series += ".2";
  two.AddSeries("b", 8, other);
  ExpectRefusal(two.Read(), { "a3.dcm", "ends within its pixels" });
  folder.Bytes[3].resize(200); // so short that its series is not known
  ExpectRefusal(folder.Read(), { "a3.dcm", "may be a slice" });
  folder.Bytes[3].clear();
  ExpectRefusal(folder.Read(), { "a3.dcm", "empty" });
}

TEST(DicomVolumes, AHalfCopyOfASliceIsLeftOut)
{
  ExampleFolder folder;
  folder.AddSeries("a", 8);
  const std::string half = folder.Bytes[3].substr(0, folder.Bytes[3].size() - 10);
  ExampleFolder copied = folder;
  copied.Add("a3.dcm.part", half);
  const DicomFolder found = copied.Read();
  const DicomVolume& volume = ChooseDicomVolume(found, "");
  EXPECT_EQ(volume.Frames.size(), 8U);
  ExpectWords(WarningOfLeftOut(found, volume), { "1 file is left out", "the same slice again" });
  // Of no slice that is there, or of no one in particular.
  folder.Bytes[3] = half;
  ExpectRefusal(folder.Read(), { "a3.dcm", "ends within its pixels" });
  ExampleFolder twice = copied;
  twice.Add("copy.dcm", twice.Bytes[3]);
  ExpectRefusal(twice.Read(), { "a3.dcm.part", "ends within its pixels" });
}

TEST(DicomVolumes, ASliceCutOffAnywhereIsMissed)
{
  ExampleFolder folder;
  folder.AddSeries("a", 4);
  const std::string whole = folder.Bytes[0];
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    folder.Bytes[0] = whole.substr(0, size);
    if (size > 0 && size < 132)
    {
      continue; // no mark yet: another file
    }
    SCOPED_TRACE(size);
    ExpectRefusal(folder.Read(), { "a0.dcm" });
  }
}

TEST(DicomVolumes, BitDepthsAreWidened)
{
  ExampleFolder folder;
  ExampleDicom::Options options;
  options.IsSigned = 0;
  options.Intercept = "-1024";
  for (int slice = 0; slice < 6; ++slice)
  {
    options.Stored = slice % 2 ? 16 : 12;
    folder.AddSlice("a" + std::to_string(slice), 3 * slice, options);
  }
  EXPECT_EQ(ChooseDicomVolume(folder.Read(), "").Type, VoxelType::Int32);
}

TEST(DicomVolumes, NoNumberIsInvented)
{
  const auto refused = [](const std::function<void(ExampleDicom::Options&)>& change,
                         const std::vector<std::string>& words, int only = -1)
  {
    ExampleFolder folder;
    for (int slice = 0; slice < 6; ++slice)
    {
      ExampleDicom::Options options;
      if (only < 0 || only == slice)
      {
        change(options);
      }
      folder.AddSlice("a" + std::to_string(slice), 3 * slice, options);
    }
    ExpectRefusal(folder.Read(), words);
  };
  using Options = ExampleDicom::Options;
  for (const std::string spacing : { "", " ", "0\\0", "0,5\\0,5", "1", "-1\\1", "1\\nan" })
  {
    refused([&](Options& options) { options.Spacing = spacing; }, { "PixelSpacing", "export" });
  }
  refused([](Options& options) { options.Spacing = ""; }, { "'folder/a3' has no PixelSpacing" }, 3);
  refused([](Options& options) { options.Position = ""; }, { "ImagePositionPatient" });
  refused([](Options& options) { options.Orientation = ""; }, { "ImageOrientationPatient" });
  refused([](Options& options) { options.Orientation = R"(1\0\0\1\0\0)"; }, { "right angle" });
  refused([](Options& options) { options.Slope = ""; }, { "RescaleIntercept but no RescaleSlope" });
  refused([](Options& options) { options.Slope = "1,5"; }, { "1,5" });
  refused([](Options& options) { options.Slope = "0"; }, { "RescaleSlope '0'" });
  ExampleFolder stored;
  ExampleDicom::Options without;
  without.Slope = without.Intercept = "";
  stored.AddSeries("a", 4, without);
  ExpectWords(ChooseDicomVolume(stored.Read(), "").Warning, { "Hounsfield" });
  refused([](Options& options) { options.Slope = options.Intercept = ""; },
    { "'a2' has no RescaleSlope" }, 2);
}

TEST(DicomVolumes, FramesThatOneNumberPlaces)
{
  const auto folderOf = [](std::uint32_t tag, const std::string& value)
  {
    ExampleDicom::Options options;
    options.Frames = "3";
    options.Class = "1.2.840.10008.5.1.4.1.1.481.2";
    options.Pixels = std::string(72, '\0');
    ExampleDicom::DataSet data;
    data.Add(0x00080016, "UI", options.Class).Add(tag, "DS", value);
    data.AddBytes(ExampleDicom::Slice(options).Bytes);
    ExampleFolder folder;
    folder.Add("dose.dcm", ExampleDicom::FileOf(data));
    return folder.Read();
  };
  const DicomFolder dose = folderOf(0x3004000C, R"(0\4\8)");
  EXPECT_EQ(ChooseDicomVolume(dose, "").Geometry.Spacing[2], 4);
  // Against the normal: the last frame is the first slice.
  const DicomFolder negative = folderOf(0x00180088, "-2.5");
  const DicomVolume& volume = ChooseDicomVolume(negative, "");
  EXPECT_EQ(volume.Geometry.Spacing[2], 2.5);
  EXPECT_EQ(volume.Frames.front().Number, 2U);
  ExpectRefusal(folderOf(0x00180050, "3"), { "where its 3 frames lie" });
}

/// A tag as a value.
std::string TagBytes(std::uint32_t tag)
{
  return ExampleDicom::Shorts({ static_cast<int>(tag >> 16), static_cast<int>(tag & 0xFFFF) });
}

TEST(DicomVolumes, FramesOfOtherThingsThanSlicesAreNoTallVolume)
{
  const auto folderOf = [](const std::string& pointer, const std::vector<int>& slices)
  {
    ExampleDicom::Options options;
    options.Frames = "4";
    options.Class = "1.2.840.10008.5.1.4.1.1.20"; // nuclear medicine
    options.Pixels = std::string(96, '\0');
    ExampleDicom::DataSet data;
    data.Add(0x00080016, "UI", options.Class).Add(0x00180088, "DS", "3");
    if (!pointer.empty())
    {
      data.Add(0x00280009, "AT", pointer);
    }
    if (!slices.empty())
    {
      data.Add(0x00540080, "US", ExampleDicom::Shorts(slices));
    }
    data.AddBytes(ExampleDicom::Slice(options).Bytes);
    ExampleFolder folder;
    folder.Add("nm.dcm", ExampleDicom::FileOf(data));
    return folder.Read();
  };
  const std::string slice = TagBytes(0x00540080);
  for (const DicomFolder& sound :
    { folderOf("", {}), folderOf(slice, {}), folderOf(slice, { 1, 2, 3, 4 }) })
  {
    EXPECT_EQ(ChooseDicomVolume(sound, "").Geometry.Spacing[2], 3);
  }
  const DicomFolder mixed = folderOf(slice, { 2, 1, 4, 3 });
  EXPECT_EQ(ChooseDicomVolume(mixed, "").Frames.front().Number, 1U);
  // Times of the heart, then slices; times alone; the same slices twice.
  const std::string times = TagBytes(0x00540070);
  ExpectRefusal(folderOf(times + slice, { 1, 2, 1, 2 }), { "FrameIncrementPointer", "4 frames" });
  ExpectRefusal(folderOf(TagBytes(0x00540100), {}), { "FrameIncrementPointer" });
  EXPECT_NE(WhyRefused(folderOf(slice, { 1, 2, 1, 2 })), "");
  ExpectRefusal(folderOf(slice, { 1, 2 }), { "where its 4 frames lie" });
}

TEST(DicomVolumes, WhatPixelsMeanIsSaidOrWarnedOf)
{
  const auto folderOf = [](const std::function<void(std::string&)>& change)
  {
    ExampleFolder folder;
    folder.AddSeries("a", 4);
    for (std::string& bytes : folder.Bytes)
    {
      change(bytes);
    }
    return folder.Read();
  };
  const auto element = [](std::uint32_t tag)
  { return TagBytes(tag) + "US" + ExampleDicom::Shorts({ 2 }); };
  const auto without = [&](std::uint32_t tag)
  {
    return folderOf(
      [&](std::string& bytes) { bytes.erase(bytes.find(element(tag)), element(tag).size() + 2); });
  };
  const DicomFolder unsaid = without(0x00280103);
  EXPECT_EQ(ChooseDicomVolume(unsaid, "").Type, VoxelType::UInt16);
  ExpectWords(ChooseDicomVolume(unsaid, "").Warning,
    { "no PixelRepresentation", "taken as unsigned", "'a3.dcm'" });
  ExpectWords(ChooseDicomVolume(without(0x00280101), "").Warning, { "BitsStored", "all 16 bits" });
  ExpectRefusal(folderOf([&](std::string& bytes)
                  { bytes[bytes.find(element(0x00280103)) + element(0x00280103).size()] = 7; }),
    { "PixelRepresentation '7'", "neither 0 (unsigned) nor 1 (signed)", "Export" });
}

TEST(DicomVolumes, ATableOfGrayValuesIsNoRescale)
{
  const auto folderOf = [](const std::string& slope, bool isDelimited)
  {
    ExampleFolder folder;
    for (int slice = 0; slice < 4; ++slice)
    {
      ExampleDicom::Options options;
      options.Slope = slope;
      options.Intercept = slope.empty() ? "" : "0";
      options.Instance += std::to_string(slice);
      options.Position = "0\\0\\" + std::to_string(3 * slice);
      options.Pixels = std::string(24, '\0');
      ExampleDicom::DataSet table;
      table.Add(0x00283002, "US", ExampleDicom::Shorts({ 4, 0, 16 }));
      ExampleDicom::DataSet data;
      data.Add(0x00080016, "UI", options.Class);
      data.AddSequence(0x00283000, { table }, isDelimited);
      data.AddBytes(ExampleDicom::Slice(options).Bytes);
      folder.Add("a" + std::to_string(slice), ExampleDicom::FileOf(data));
    }
    return folder.Read();
  };
  for (const bool isDelimited : { false, true })
  {
    ExpectRefusal(folderOf("", isDelimited), { "ModalityLUTSequence", "RescaleSlope", "Export" });
    EXPECT_EQ(WhyRefused(folderOf("1", isDelimited)), "");
  }
}

TEST(DicomVolumes, RoundedAxesAreOfLengthOne)
{
  ExampleFolder folder;
  ExampleDicom::Options options;
  options.Orientation = R"(1.005\0\0\0\0.71\0.71)";
  for (int slice = 0; slice < 4; ++slice)
  {
    options.Instance += std::to_string(slice);
    const std::string place = std::to_string(2 * slice);
    options.Position = "0\\-" + place + "\\" + place;
    options.Pixels = std::string(24, '\0');
    folder.Add("a" + std::to_string(slice), ExampleDicom::FileOf(ExampleDicom::Slice(options)));
  }
  const DicomFolder found = folder.Read();
  const DicomVolume& volume = ChooseDicomVolume(found, "");
  for (const int axis : { 0, 1, 2 })
  {
    EXPECT_NEAR(volume.Geometry.Direction.col(axis).norm(), 1, 1e-12);
  }
  EXPECT_NEAR(volume.Frames.front().Axes.col(0).norm(), 1, 1e-12);
}

/// The files of a folder in memory, read as those of the disk are.
DicomAccess AccessInMemory(const ExampleFolder& folder)
{
  DicomAccess access;
  access.Open = [&folder](const std::string& name)
  {
    const auto found = std::find(folder.Names.begin(), folder.Names.end(), name);
    return std::make_unique<std::istringstream>(
      folder.Bytes[static_cast<std::size_t>(found - folder.Names.begin())]);
  };
  return access;
}

/// Reads the voxels of the volume that is meant; why they are refused, or nothing.
template <typename T>
std::string WhyVoxelsAreRefused(const ExampleFolder& folder, const DicomAccess& access,
  std::vector<T>& voxels)
{
  const auto goOn = [](double) { return true; };
  const DicomFolder found = ReadDicomFolder("folder", folder.Names, access, goOn);
  const DicomVolume& volume = ChooseDicomVolume(found, "");
  EXPECT_EQ(SizeOf(volume.Type), sizeof(T));
  try
  {
    ReadDicomVoxels(found, volume, access, voxels.data(), goOn);
  }
  catch (const FileProblem& problem)
  {
    return problem.what();
  }
  return {};
}

TEST(DicomVolumes, DeflatedFilesAreBoundedInMemory)
{
  // Packed as it is, for the test.
  ExampleFolder folder;
  folder.AddSeries("a", 4);
  for (std::string& bytes : folder.Bytes)
  {
    const std::size_t start = bytes.find(std::string("\x08\0\x08\0CS", 6));
    bytes = ExampleDicom::FileOf(ExampleDicom::DataSet().AddBytes(bytes.substr(start)),
      "1.2.840.10008.1.2.1.99");
  }
  const auto goOn = [](double) { return true; };
  DicomAccess access = AccessInMemory(folder);
  std::size_t greatest = 0;
  access.Inflate = [&greatest](const std::string& packed, std::size_t most)
  {
    greatest = most;
    return packed;
  };
  const DicomFolder found = ReadDicomFolder("folder", folder.Names, access, goOn);
  EXPECT_EQ(ChooseDicomVolume(found, "").Frames.size(), 4U);
  EXPECT_EQ(greatest, std::size_t(1) << 30);
  access.Inflate = [](const std::string&, std::size_t) -> std::string { throw std::bad_alloc(); };
  ExpectRefusal(ReadDicomFolder("folder", folder.Names, access, goOn), { "not enough memory" });
}

TEST(DicomVolumes, TheSearchForTheSameSliceCanBeStopped)
{
  ExampleFolder folder;
  folder.AddSeries("a", 4);
  folder.Add("copy.dcm", folder.Bytes[2]);
  const DicomAccess access = AccessInMemory(folder);
  const auto stop = [](double fraction) { return fraction < 1; };
  EXPECT_TRUE(ReadDicomFolder("folder", folder.Names, access, stop).Name.empty());
}

TEST(DicomVolumes, CompressedPixelsOfMoreBitsThanTheFileSays)
{
  // Lossless JPEG up to its scan: 16 bits, of which the file stores 12.
  const std::string stream("\xFF\xD8\xFF\xC4\x00\x04\x00\x00\xFF\xC3\x00\x0B\x10\x00\x03\x00"
                           "\x04\x01\x01\x11\x00\xFF\xDA\x00\x08\x01\x01\x00\x01\x00\x00",
    31);
  ExampleFolder folder;
  for (int slice = 0; slice < 2; ++slice)
  {
    ExampleDicom::Options options;
    options.IsSigned = 0;
    options.Stored = 12;
    options.Instance += std::to_string(slice);
    options.Position = "0\\0\\" + std::to_string(3 * slice);
    options.Fragments = { "", stream + " " };
    folder.Add("a" + std::to_string(slice),
      ExampleDicom::FileOf(ExampleDicom::Slice(options), "1.2.840.10008.1.2.4.70"));
  }
  DicomAccess access = AccessInMemory(folder);
  int value = 4095;
  access.Decode = [&value](const std::string&)
  { return ExampleDicom::Shorts(std::vector<int>(12, value)); };
  std::vector<std::uint16_t> voxels(24);
  EXPECT_EQ(WhyVoxelsAreRefused(folder, access, voxels), "");
  EXPECT_EQ(voxels, std::vector<std::uint16_t>(24, 4095));
  value = 5000;
  ExpectWords(WhyVoxelsAreRefused(folder, access, voxels),
    { "'a0'", "12 of its BitsStored", "Export" });
}

TEST(DicomVolumes, PixelsThatAreNotWhereHighBitSays)
{
  // At the top, as older editions of the standard allow; and at the bottom in spite of HighBit.
  for (const int factor : { 16, 1 })
  {
    ExampleFolder folder;
    for (int slice = 0; slice < 2; ++slice)
    {
      ExampleDicom::Options options;
      options.Stored = 12;
      options.HighBit = 15;
      options.Instance += std::to_string(slice);
      options.Position = "0\\0\\" + std::to_string(3 * slice);
      options.Pixels = ExampleDicom::Shorts(std::vector<int>(12, factor * (100 + slice)));
      folder.Add("a" + std::to_string(slice), ExampleDicom::FileOf(ExampleDicom::Slice(options)));
    }
    std::vector<std::int16_t> voxels(24);
    const std::string refusal = WhyVoxelsAreRefused(folder, AccessInMemory(folder), voxels);
    if (factor > 1)
    {
      EXPECT_EQ(refusal, "");
      EXPECT_EQ(voxels.front(), 100);
      EXPECT_EQ(voxels.back(), 101);
    }
    else
    {
      ExpectWords(refusal, { "'a0'", "HighBit is 15", "BitsStored - 1 (11)", "Export" });
    }
  }
}

TEST(DicomVolumes, TheGreatestSeriesUnlessToldOtherwise)
{
  ExampleFolder folder;
  ExampleDicom::Options options;
  options.Series = "1.1";
  folder.AddSeries("a", 4, options);
  options.Series = "2.2";
  folder.AddSeries("b", 6, options);
  options.Series = "3.3";
  options.Samples = 3;
  options.Colors = "RGB";
  folder.AddSeries("c", 9, options);
  const DicomFolder found = folder.Read();
  ASSERT_EQ(found.Volumes.size(), 3U);
  EXPECT_EQ(ChooseDicomVolume(found, "").Identifier(), "2.2");
  EXPECT_EQ(ChooseDicomVolume(found, "1.1").Identifier(), "1.1");
  ExpectRefusal(found, { "holds colors", "RGB" }, "3.3");
  ExpectRefusal(found, { "no series '4.4'", "1.1 (4 slices", "2.2 (6 slices" }, "4.4");
  // A dose, or pictures from nowhere, are not meant, however many they are.
  options = {};
  options.Series = "4.5";
  options.Modality = "RTDOSE";
  folder.AddSeries("d", 12, options);
  options.Series = "5.5";
  options.Modality = "OT";
  options.Position = "";
  folder.AddSeries("e", 12, options);
  EXPECT_EQ(ChooseDicomVolume(folder.Read(), "").Identifier(), "2.2");
  ExampleFolder single;
  single.AddSeries("a", 1);
  ExpectRefusal(single.Read(), { "single slice" });
  ExpectRefusal(ExampleFolder().Read(), { "folder", "no DICOM image" });
}

} // namespace
