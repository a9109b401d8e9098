#include "VolumeFile.h"

#include "BackgroundTask.h"
#include "CompletenessCheck.h"
#include "DicomLibraries.h"
#include "VoxelStorage.h"

#include "vtkErrorCode.h"

#include "itkMetaImageIO.h"
#include "itkNiftiImageIO.h"
#include "itkNrrdImageIO.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

namespace FlipFree
{
namespace
{

bool HasKnownEnding(const std::string& name)
{
  const char* const known[] = { ".nii", ".nii.gz", ".hdr", ".img", ".img.gz", ".nrrd", ".nhdr",
    ".mha", ".mhd" };
  return std::any_of(std::begin(known), std::end(known),
    [&name](const char* ending) { return EndsWith(name, ending); });
}

ImageFileError WhyNotReadable(const std::string& name)
{
  if (HasDicomMark(name))
  {
    return { vtkErrorCode::UnrecognizedFileTypeError,
      "'" + name + "' is a single DICOM file. Give the folder of its series instead." };
  }
  if (HasKnownEnding(name))
  {
    return { vtkErrorCode::FileFormatError,
      "'" + name +
        "' does not begin as its file extension requires: the file is empty, truncated, " +
        "damaged, or in another format. Download or copy it again, or correct the extension." };
  }
  return { vtkErrorCode::UnrecognizedFileTypeError,
    "The format of '" + name + "' is unknown. Known are NIfTI (.nii, .nii.gz), NRRD (.nrrd, " +
      ".nhdr), MetaImage (.mha, .mhd) and folders of DICOM files." };
}

} // namespace

bool EndsWith(const std::string& name, const std::string& ending)
{
  return name.size() >= ending.size() &&
    std::equal(ending.rbegin(), ending.rend(), name.rbegin(),
      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

itk::ImageIOBase::Pointer OpenVolumeFile(const std::string& name)
{
  std::error_code ignored;
  const auto status = std::filesystem::status(name, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    throw ImageFileError(vtkErrorCode::CannotOpenFileError,
      "'" + name + "' is not a regular file. Give a file, or the folder of a DICOM series.");
  }
  if (!std::ifstream(name))
  {
    throw ImageFileError(vtkErrorCode::FileNotFoundError,
      "'" + name + "' does not exist or cannot be read. Check its name and permissions.");
  }
  if (StorageOf(name).Files.empty())
  {
    throw WhyNotReadable(name);
  }
  try
  {
    const itk::ImageIOBase::Pointer candidates[] = { itk::NiftiImageIO::New().GetPointer(),
      itk::NrrdImageIO::New().GetPointer(), itk::MetaImageIO::New().GetPointer() };
    for (const itk::ImageIOBase::Pointer& io : candidates)
    {
      if (io->CanReadFile(name.c_str()))
      {
        io->SetFileName(name);
        io->ReadImageInformation();
        return io;
      }
    }
  }
  catch (const itk::ExceptionObject& exception)
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "The header of '" + name + "' cannot be understood. Repair or convert the file. (ITK: " +
        exception.GetDescription() + ")");
  }
  throw WhyNotReadable(name);
}

void ReadVolumeFile(const itk::ImageIOBase::Pointer& io, const std::string& name,
  const vtkSmartPointer<vtkDataArray>& scalars, const Monitor& monitor)
{
  double fraction = 0;
  bool goOn = true;
  const auto check = [&]()
  {
    RequireComplete(name,
      [&](double checked)
      {
        fraction = checked;
        return goOn = monitor(checked);
      });
  };
  // ITK's MetaImage library loops forever on some damaged streams. The others are checked in
  // this thread while they are read, so that the check costs no time of its own.
  const bool mayNotEnd = dynamic_cast<itk::MetaImageIO*>(io.GetPointer()) != nullptr;
  if (mayNotEnd)
  {
    check();
  }
  if (!goOn)
  {
    return;
  }
  BackgroundTask read([io, name, scalars]() { ReadVoxels(io, name, scalars->GetVoidPointer(0)); });
  const auto wait = [&]() { return read.Wait([&]() { return monitor(fraction); }); };
  try
  {
    if (!mayNotEnd)
    {
      check();
    }
  }
  catch (const ImageFileError&)
  {
    // ITK prints what it has to say about it while the caller still keeps it quiet.
    try
    {
      wait();
    }
    catch (const ImageFileError&) // the check knows better
    {
    }
    throw;
  }
  if (goOn)
  {
    wait();
  }
}

} // namespace FlipFree
