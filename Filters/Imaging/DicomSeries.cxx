#include "DicomSeries.h"

#include "DicomCheck.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkSmartPointer.h"

#include "itkGDCMImageIO.h"

#include "gdcmTrace.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

namespace FlipFree
{
namespace
{

/// GDCM's messages go to the terminal, past VTK's; within a scope that holds one of these they are
/// off. What they are about is reported here, where it matters.
class GdcmMessagesOff
{
public:
  GdcmMessagesOff()
  {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
  }
  ~GdcmMessagesOff()
  {
    gdcm::Trace::SetWarning(this->Warnings);
    gdcm::Trace::SetError(this->Errors);
  }
  GdcmMessagesOff(const GdcmMessagesOff&) = delete;
  void operator=(const GdcmMessagesOff&) = delete;

private:
  bool Warnings = gdcm::Trace::GetWarningFlag();
  bool Errors = gdcm::Trace::GetErrorFlag();
};

itk::GDCMImageIO::Pointer OpenDicomFile(const std::string& name)
{
  try
  {
    auto io = itk::GDCMImageIO::New();
    io->SetFileName(name);
    io->ReadImageInformation();
    return io;
  }
  catch (const itk::ExceptionObject& exception)
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "The DICOM file '" + name + "' cannot be read: it is truncated, damaged or not an image. " +
        "Download or copy the series again, or remove the file. (ITK: " +
        exception.GetDescription() + ")");
  }
}

std::string TagOf(itk::GDCMImageIO* io, const std::string& tag)
{
  std::string value;
  io->GetValueFromTag(tag, value);
  const std::size_t end = value.find_last_not_of(std::string(" \0", 2));
  return value.substr(0, end == std::string::npos ? 0 : end + 1);
}

bool IsFloatingPoint(int scalarType)
{
  return scalarType == VTK_FLOAT || scalarType == VTK_DOUBLE;
}

/// Orders the slices along the normal of the first one, in the sense that makes the axes
/// right-handed, as ITK does.
void SortByPosition(std::vector<DicomSlice>& slices)
{
  const Eigen::Vector3d normal = slices.front().Header.Geometry.Direction.col(2);
  std::stable_sort(slices.begin(), slices.end(),
    [&normal](const DicomSlice& a, const DicomSlice& b)
    { return normal.dot(a.Header.Geometry.Origin) < normal.dot(b.Header.Geometry.Origin); });
}

void RequireSameGrid(const DicomSlice& first, const DicomSlice& slice)
{
  const ImageGeometry& a = first.Header.Geometry;
  const ImageGeometry& b = slice.Header.Geometry;
  const bool same = a.Dimensions == b.Dimensions && b.Dimensions[2] == 1 &&
    (a.Spacing - b.Spacing).head<2>().norm() < 1e-3 * a.Spacing[0] &&
    (a.Direction - b.Direction).leftCols<2>().norm() < 1e-3;
  if (!same)
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "'" + slice.File + "' and '" + first.File + "' are of one series but differ in size, pixel " +
        "spacing or orientation, or hold several slices each, so the series is not a "
        "volume. Move such files out of the folder.");
  }
}

/// How the slices fit an even stack: nothing, a warning, or an error.
std::string CheckSpacing(const DicomSeries& series, const ImageGeometry& stack)
{
  double worstStray = 0;
  std::size_t worst = 0;
  for (std::size_t slice = 0; slice < series.Slices.size(); ++slice)
  {
    const Eigen::Vector3d expected = stack.ToPhysical(Eigen::Vector3d(0, 0, slice));
    const double stray = (series.Slices[slice].Header.Geometry.Origin - expected).norm();
    if (stray > worstStray)
    {
      worstStray = stray;
      worst = slice;
    }
  }
  const double relative = worstStray / stack.Spacing[2];
  if (relative < 0.01)
  {
    return {};
  }
  std::ostringstream message;
  message << "The slices of series " << series.UID << " are not evenly spaced: '"
          << series.Slices[worst].File << "' lies " << worstStray << " mm from its place in an "
          << "even stack of spacing " << stack.Spacing[2] << " mm. ";
  if (relative > 0.5)
  {
    message << "Slices are missing, or several volumes share the series. Complete it, or move the "
            << "files of one volume into a folder of their own.";
    throw ImageFileError(vtkErrorCode::FileFormatError, message.str());
  }
  message << "It is read as if it were even.";
  return message.str();
}

/// Slices may come in different types, since each has a rescale slope of its own; floating-point
/// voxels can hold all of them.
void ReadConverted(itk::ImageIOBase* io, const std::string& name, int type, int wantedType,
  void* voxels)
{
  if (!IsFloatingPoint(wantedType))
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "'" + name + "' has voxels of another type than the first slice of its series. Convert the " +
        "series to one file, for instance NIfTI, with voxels of type float.");
  }
  const auto count = static_cast<vtkIdType>(io->GetImageSizeInPixels());
  auto slice = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  slice->SetNumberOfValues(count);
  ReadVoxels(io, name, slice->GetVoidPointer(0));
  auto wanted = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(wantedType));
  wanted->SetVoidArray(voxels, count, 1);
  wanted->CopyComponent(0, slice, 0);
}

std::vector<std::string> DicomFilesIn(const std::string& folder)
{
  std::vector<std::string> files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
  {
    std::error_code ignored;
    if (entry.is_regular_file(ignored) && HasDicomMark(entry.path().string()) &&
      IsCompleteDicomImage(entry.path().string()))
    {
      files.push_back(entry.path().string());
    }
  }
  if (failure)
  {
    throw ImageFileError(vtkErrorCode::CannotOpenFileError,
      "The folder '" + folder + "' cannot be searched: " + failure.message() +
        ". Check its permissions.");
  }
  if (files.empty())
  {
    throw ImageFileError(vtkErrorCode::FileNotFoundError,
      "The folder '" + folder + "' holds no DICOM image. Give the folder that directly holds the " +
        "files of the series; of a volume in another format, the file itself.");
  }
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

std::vector<DicomSeries> ListDicomSeries(const std::string& folder, const Monitor& monitor)
{
  const GdcmMessagesOff quiet;
  const std::vector<std::string> files = DicomFilesIn(folder);
  std::map<std::string, DicomSeries> byUID;
  for (std::size_t index = 0; index < files.size(); ++index)
  {
    if (!monitor(static_cast<double>(index) / static_cast<double>(files.size())))
    {
      return {};
    }
    const std::string& name = files[index];
    const auto io = OpenDicomFile(name);
    DicomSeries& series = byUID[TagOf(io, "0020|000e")];
    if (series.Slices.empty())
    {
      series.UID = TagOf(io, "0020|000e");
      series.Description = TagOf(io, "0008|103e");
    }
    series.Slices.push_back({ name, {} });
    try
    {
      series.Slices.back().Header = HeaderOf(io, name);
    }
    catch (const ImageFileError& error)
    {
      series.Problem = error.what();
    }
  }

  std::vector<DicomSeries> list;
  for (auto& entry : byUID)
  {
    SortByPosition(entry.second.Slices);
    list.push_back(std::move(entry.second));
  }
  std::stable_sort(list.begin(), list.end(),
    [](const DicomSeries& a, const DicomSeries& b) { return a.Slices.size() > b.Slices.size(); });
  return list;
}

VolumeHeader HeaderOfSeries(const DicomSeries& series, std::string& warning)
{
  if (!series.Problem.empty())
  {
    throw ImageFileError(vtkErrorCode::FileFormatError, series.Problem);
  }
  VolumeHeader header = series.Slices.front().Header;
  const std::size_t count = series.Slices.size();
  if (count == 1)
  {
    return header;
  }
  for (const DicomSlice& slice : series.Slices)
  {
    RequireSameGrid(series.Slices.front(), slice);
    if (IsFloatingPoint(slice.Header.ScalarType))
    {
      header.ScalarType = slice.Header.ScalarType;
    }
  }

  ImageGeometry& stack = header.Geometry;
  const Eigen::Vector3d along = series.Slices.back().Header.Geometry.Origin - stack.Origin;
  if (along.dot(stack.Direction.col(2)) <= 0)
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "The " + std::to_string(count) + " images of series " + series.UID + " are all in the " +
        "same place: their positions are missing, or they show one slice at several times. "
        "Choose another series by its UID.");
  }
  stack.Dimensions[2] = static_cast<int>(count);
  stack.Spacing[2] = along.norm() / static_cast<double>(count - 1);
  // A tilted gantry shears the stack. The third axis then leans, so that every voxel stays where it
  // was measured. Below a hundredth of a pixel it is rounding, and the axes stay orthogonal.
  const Eigen::Vector3d lean = along - along.norm() * stack.Direction.col(2);
  if (lean.norm() > 0.01 * stack.Spacing.head<2>().minCoeff())
  {
    stack.Direction.col(2) = along.normalized();
  }
  warning = CheckSpacing(series, stack);
  return header;
}

void ReadSeriesVoxels(const DicomSeries& series, const VolumeHeader& header, void* voxels,
  const Monitor& monitor)
{
  const GdcmMessagesOff quiet;
  const std::size_t count = series.Slices.size();
  const std::size_t stride = header.NumberOfBytes() / count;
  for (std::size_t index = 0; index < count; ++index)
  {
    if (!monitor(static_cast<double>(index) / static_cast<double>(count)))
    {
      return;
    }
    const DicomSlice& slice = series.Slices[index];
    void* target = static_cast<char*>(voxels) + index * stride;
    const auto io = OpenDicomFile(slice.File);
    const VolumeHeader now = HeaderOf(io, slice.File);
    if (now.NumberOfBytes() != slice.Header.NumberOfBytes())
    {
      throw ImageFileError(vtkErrorCode::FileFormatError,
        "'" + slice.File + "' has changed since its header was read. Call Modified() and update " +
          "again.");
    }
    if (now.ScalarType == header.ScalarType)
    {
      ReadVoxels(io, slice.File, target);
    }
    else
    {
      ReadConverted(io, slice.File, now.ScalarType, header.ScalarType, target);
    }
  }
}

} // namespace FlipFree
