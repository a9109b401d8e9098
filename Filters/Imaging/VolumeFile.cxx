#include "VolumeFile.h"

#include "BackgroundTask.h"
#include "CompletenessCheck.h"
#include "DicomCheck.h"

#include "vtkErrorCode.h"

#include "itkMetaImageIO.h"
#include "itkNiftiImageIO.h"
#include "itkNrrdImageIO.h"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace FlipFree
{
namespace
{

bool HasKnownEnding(const std::string& name)
{
  const char* const known[] = { ".nii", ".nii.gz", ".nia", ".hdr", ".img", ".img.gz", ".nrrd",
    ".nhdr", ".mha", ".mhd" };
  return std::any_of(std::begin(known), std::end(known),
    [&name](const char* ending) { return EndsWith(name, ending); });
}

/// ITK's NRRD reader overruns a buffer when it reports some lines that it cannot parse, so that
/// only headers that look like one reach it: lines of text with a colon, comments, and a blank line
/// last.
bool IsSafeNrrdHeader(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  std::string line;
  std::getline(file, line);
  if (line.compare(0, 4, "NRRD") != 0)
  {
    return true; // not NRRD, so not ITK's NRRD reader
  }
  while (std::getline(file, line) && !line.empty() && line != "\r")
  {
    const bool isText = std::none_of(line.begin(), line.end(),
      [](char letter)
      { return static_cast<unsigned char>(letter) < ' ' && !std::isspace(letter); });
    if (!isText || (line[0] != '#' && line.find(':') > 200))
    {
      return false;
    }
  }
  return true;
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
      "'" + name + "' does not begin as the format of its ending does: the file is empty, " +
        "truncated, damaged, or of another format. Get it anew, or give it its own ending." };
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
  if (!std::ifstream(name))
  {
    throw ImageFileError(vtkErrorCode::FileNotFoundError,
      "'" + name + "' does not exist or may not be read. Check its name and permissions.");
  }
  if (!IsSafeNrrdHeader(name))
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "The header of '" + name + "' is not NRRD to its end: the file is damaged. Get it anew.");
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
  BackgroundTask read([io, name, scalars]() { ReadVoxels(io, name, scalars->GetVoidPointer(0)); });
  double fraction = 0;
  bool goOn = true;
  // Meanwhile, in this thread: the check costs no time of its own.
  RequireComplete(io, name,
    [&](double checked)
    {
      fraction = checked;
      return goOn = monitor(checked);
    });
  if (goOn)
  {
    read.Wait([&]() { return monitor(fraction); });
  }
}

} // namespace FlipFree
