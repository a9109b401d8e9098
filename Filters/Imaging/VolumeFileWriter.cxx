#include "VolumeFileWriter.h"

#include "AtomicFile.h"
#include "BackgroundTask.h"
#include "VolumeFile.h"

#include "Exchange/NiftiHeader.h"
#include "Exchange/NiftiOrientation.h"

#include "vtkErrorCode.h"

#include "itkMetaDataObject.h"
#include "itkMetaImageIO.h"
#include "itkNrrdImageIO.h"
#include "itk_zlib.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <vector>

namespace FlipFree
{
namespace
{

bool IsNiftiName(const std::string& name)
{
  return HasEnding(name, ".nii") || HasEnding(name, ".nii.gz");
}

void RequireKnownEnding(const std::string& name)
{
  const char* const endings[] = { ".nrrd", ".mha", ".mhd" };
  if (!IsNiftiName(name) &&
    std::none_of(std::begin(endings), std::end(endings),
      [&name](const char* ending) { return HasEnding(name, ending); }))
  {
    throw ImageFileError(vtkErrorCode::UnrecognizedFileTypeError,
      "The file extension of '" + name + "' is not supported. Use .nii.gz, .nii, " +
        ".nrrd, .mha or .mhd.");
  }
}

std::string CannotWrite(const std::string& name, const std::string& why)
{
  return "'" + name + "' cannot be written: " + why;
}

itk::ImageIOBase::IOComponentEnum ComponentOf(VoxelType type)
{
  using Component = itk::ImageIOBase::IOComponentEnum;
  constexpr Component components[] = { Component::CHAR, Component::UCHAR, Component::SHORT,
    Component::USHORT, Component::INT, Component::UINT, Component::LONGLONG, Component::ULONGLONG,
    Component::FLOAT, Component::DOUBLE };
  return components[static_cast<int>(type)];
}

void WriteByItk(const std::string& name, const VolumeHeader& header, const void* voxels,
  const FileFields& fields, bool compress)
{
  const itk::ImageIOBase::Pointer io = HasEnding(name, ".nrrd")
    ? itk::ImageIOBase::Pointer(itk::NrrdImageIO::New().GetPointer())
    : itk::ImageIOBase::Pointer(itk::MetaImageIO::New().GetPointer());
  const ImageGeometry& geometry = header.Geometry;
  itk::ImageIORegion whole(3);
  io->SetFileName(name);
  io->SetNumberOfDimensions(3);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d direction = geometry.Direction.col(axis);
    io->SetDimensions(axis, geometry.Dimensions[axis]);
    io->SetSpacing(axis, geometry.Spacing[axis]);
    io->SetOrigin(axis, geometry.Origin[axis]);
    io->SetDirection(axis, std::vector<double>(direction.data(), direction.data() + 3));
    whole.SetSize(axis, geometry.Dimensions[axis]);
  }
  for (const auto& [key, value] : fields)
  {
    itk::EncapsulateMetaData<std::string>(io->GetMetaDataDictionary(), key, value);
  }
  io->SetPixelType(itk::IOPixelEnum::SCALAR);
  io->SetNumberOfComponents(1);
  io->SetComponentType(ComponentOf(VoxelTypeOf(header.ScalarType)));
  io->SetIORegion(whole);
  io->SetUseCompression(compress);
  io->Write(voxels);
}

/// By zlib, or plainly; false where the disk does not take it all.
bool WriteBytes(const std::string& name, const std::string& header, const char* voxels,
  std::size_t size)
{
  if (!HasEnding(name, ".gz"))
  {
    std::ofstream file(name, std::ios::binary);
    file.write(header.data(), static_cast<std::streamsize>(header.size()));
    file.write(voxels, static_cast<std::streamsize>(size));
    file.close();
    return file.good();
  }
  const gzFile file = gzopen(name.c_str(), "wb");
  if (!file)
  {
    return false;
  }
  bool isWhole = gzwrite(file, header.data(), static_cast<unsigned int>(header.size())) > 0;
  constexpr std::size_t atATime = std::size_t(1) << 28;
  for (std::size_t done = 0; isWhole && done < size; done += atATime)
  {
    isWhole =
      gzwrite(file, voxels + done, static_cast<unsigned int>(std::min(atATime, size - done))) > 0;
  }
  return gzclose(file) == Z_OK && isWhole;
}

struct Volume
{
  VolumeFileHeader Header;
  std::vector<char> Voxels;
};

/// Writers do not tell of every failure, a full disk among them; but what they then leave cannot be
/// read.
Volume ReadBack(const std::string& written, const std::string& destination)
{
  try
  {
    Volume volume;
    volume.Header = OpenVolumeFile(written);
    volume.Voxels.resize(volume.Header.NumberOfStoredBytes());
    ReadVolumeFile(volume.Header, 0, volume.Voxels.data(), NeverStop);
    return volume;
  }
  catch (const FileProblem&)
  {
    throw ImageFileError(vtkErrorCode::OutOfDiskSpaceError,
      CannotWrite(destination,
        "it is incomplete. The disk is full, or a file size limit has been reached: "
        "free some space, or write elsewhere."));
  }
}

void RequireSame(const Volume& found, const std::string& destination, const VolumeHeader& header,
  const void* voxels)
{
  const auto refuse = [&destination](const std::string& why)
  { throw ImageFileError(vtkErrorCode::FileFormatError, CannotWrite(destination, why)); };
  if (found.Header.ValueType() != VoxelTypeOf(header.ScalarType))
  {
    refuse(std::string("its format cannot store voxels of type ") +
      vtkImageScalarTypeNameMacro(header.ScalarType) +
      ". Use another format, or convert the voxels.");
  }
  const double shift = GreatestShift(found.Header.Geometry, header.Geometry);
  if (shift > 0.01 * header.Geometry.Spacing.minCoeff())
  {
    std::ostringstream why;
    why << "its format does not hold this geometry, voxels would move by up to " << shift
        << " mm. Use .nrrd or .mha, which do.";
    refuse(why.str());
  }
  if (found.Header.Geometry.Dimensions != header.Geometry.Dimensions ||
    std::memcmp(found.Voxels.data(), voxels, header.NumberOfBytes()) != 0)
  {
    refuse("what was read back is not what was written. Check the disk.");
  }
}

void WriteAndCheck(const std::string& written, const std::string& destination,
  const VolumeHeader& header, const void* voxels, const FileFields& fields, bool compress)
{
  try
  {
    if (IsNiftiName(destination))
    {
      WriteBytes(written,
        NiftiHeaderOf(destination, header.Geometry, VoxelTypeOf(header.ScalarType)),
        static_cast<const char*>(voxels), header.NumberOfBytes());
    }
    else
    {
      WriteByItk(written, header, voxels, fields, compress);
    }
  }
  catch (const itk::ExceptionObject& exception)
  {
    throw ImageFileError(vtkErrorCode::OutOfDiskSpaceError,
      CannotWrite(destination,
        std::string("the disk is full, or the format cannot store this image. Free some space, "
                    "or use another format. (ITK: ") +
          exception.GetDescription() + ")"));
  }
  RequireSame(ReadBack(written, destination), destination, header, voxels);
}

} // namespace

bool WriteVolumeFile(const std::string& name, const VolumeHeader& header,
  const vtkSmartPointer<vtkDataArray>& scalars, const FileFields& fields, bool compress,
  const Monitor& monitor)
{
  // Before anything is done.
  RequireKnownEnding(name);
  const VoxelType type = VoxelTypeOf(header.ScalarType);
  if (IsNiftiName(name))
  {
    NiftiHeaderOf(name, header.Geometry, type);
  }

  try
  {
    const auto file = std::make_shared<AtomicFile>(name);
    // The task shares the voxels and the temporary folder for as long as it needs them.
    BackgroundTask write(
      [=]()
      {
        WriteAndCheck(file->TemporaryName(), name, header, scalars->GetVoidPointer(0), fields,
          compress);
        file->Flush();
      });
    if (!write.Wait([&monitor]() { return monitor(0); }))
    {
      file->Discard(); // now, not when the task ends
      return false;
    }
    file->Publish();
    return true;
  }
  catch (const FileError& error)
  {
    throw ImageFileError(vtkErrorCode::CannotOpenFileError, error.what());
  }
}

} // namespace FlipFree
