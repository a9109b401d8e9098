#include "VolumeFileWriter.h"

#include "AtomicFile.h"
#include "BackgroundTask.h"
#include "CompletenessCheck.h"
#include "VolumeFile.h"

#include "vtkErrorCode.h"

#include "itkMetaDataObject.h"
#include "itkMetaImageIO.h"
#include "itkNiftiImageIO.h"
#include "itkNrrdImageIO.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>
#include <vector>

namespace FlipFree
{
namespace
{

itk::ImageIOBase::Pointer FormatOf(const std::string& name)
{
  if (EndsWith(name, ".nii") || EndsWith(name, ".nii.gz"))
  {
    return itk::NiftiImageIO::New().GetPointer();
  }
  if (EndsWith(name, ".nrrd"))
  {
    return itk::NrrdImageIO::New().GetPointer();
  }
  if (EndsWith(name, ".mha") || EndsWith(name, ".mhd"))
  {
    return itk::MetaImageIO::New().GetPointer();
  }
  throw ImageFileError(vtkErrorCode::UnrecognizedFileTypeError,
    "The file extension of '" + name + "' is not supported. Use .nii.gz, .nii, " +
      ".nrrd, .mha or .mhd.");
}

std::string CannotWrite(const std::string& name, const std::string& why)
{
  return "'" + name + "' cannot be written: " + why;
}

void WriteByItk(const std::string& name, const VolumeHeader& header, const void* voxels,
  const FileFields& fields, itk::ImageIOBase* io, bool compress)
{
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
  io->SetComponentType(ComponentOf(header.ScalarType));
  io->SetIORegion(whole);
  io->SetUseCompression(compress);
  io->Write(voxels);
}

/// The greatest distance between the places that two grids give to a voxel. It is reached in a
/// corner.
double MaximumShift(const ImageGeometry& a, const ImageGeometry& b)
{
  double greatest = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d index((corner & 1) * (a.Dimensions[0] - 1),
      (corner >> 1 & 1) * (a.Dimensions[1] - 1), (corner >> 2 & 1) * (a.Dimensions[2] - 1));
    greatest = std::max(greatest, (a.ToPhysical(index) - b.ToPhysical(index)).norm());
  }
  return greatest;
}

/// ITK's NIfTI reader turns NaN and infinity into zero: where the original has them, anything goes.
template <typename T>
bool SameFiniteValues(const void* a, const void* original, std::size_t count)
{
  const T* first = static_cast<const T*>(a);
  const T* second = static_cast<const T*>(original);
  return std::equal(first, first + count, second,
    [](T value, T wanted) { return value == wanted || !std::isfinite(wanted); });
}

bool SameVoxels(const void* a, const void* original, const VolumeHeader& header)
{
  const std::size_t count = header.Geometry.NumberOfVoxels();
  switch (header.ScalarType)
  {
    case VTK_FLOAT:
      return SameFiniteValues<float>(a, original, count);
    case VTK_DOUBLE:
      return SameFiniteValues<double>(a, original, count);
    default:
      return std::memcmp(a, original, header.NumberOfBytes()) == 0;
  }
}

/// ITK would not read back what it writes of such an image.
void RequireOrthogonalForNifti(const std::string& name, const ImageGeometry& geometry)
{
  const Eigen::Matrix3d product = geometry.Direction.transpose() * geometry.Direction;
  if ((EndsWith(name, ".nii") || EndsWith(name, ".nii.gz")) && !product.isIdentity(1e-4))
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      CannotWrite(name,
        "its direction matrix is not orthonormal, which NIfTI files cannot store. Use .nrrd or "
        ".mha."));
  }
}

struct Volume
{
  VolumeHeader Header;
  std::vector<char> Voxels;
};

/// ITK's writers do not tell of every failure, a full disk among them; but what they then leave
/// cannot be read.
Volume ReadBack(const std::string& written, const std::string& destination)
{
  try
  {
    Volume volume;
    const auto io = OpenVolumeFile(written);
    volume.Header = HeaderOf(io, written);
    RequireComplete(written, NeverStop);
    volume.Voxels.resize(volume.Header.NumberOfBytes());
    ReadVoxels(io, written, volume.Voxels.data());
    return volume;
  }
  catch (const ImageFileError&)
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
  if (found.Header.ScalarType != ScalarTypeOf(ComponentOf(header.ScalarType)))
  {
    refuse(std::string("its format cannot store voxels of type ") +
      vtkImageScalarTypeNameMacro(header.ScalarType) +
      ". Use another format, or convert the voxels.");
  }
  const double shift = MaximumShift(found.Header.Geometry, header.Geometry);
  if (shift > 0.01 * header.Geometry.Spacing.minCoeff())
  {
    std::ostringstream why;
    why << "its format does not hold this geometry, voxels would move by up to " << shift
        << " mm. Use .nrrd or .mha, which do.";
    refuse(why.str());
  }
  if (found.Header.Geometry.Dimensions != header.Geometry.Dimensions ||
    !SameVoxels(found.Voxels.data(), voxels, header))
  {
    refuse("what was read back is not what was written. Check the disk.");
  }
}

void WriteAndCheck(const std::string& written, const std::string& destination,
  const VolumeHeader& header, const void* voxels, const FileFields& fields, bool compress)
{
  try
  {
    WriteByItk(written, header, voxels, fields, FormatOf(destination), compress);
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
  FormatOf(name); // refuses an unknown ending before anything is done
  RequireOrthogonalForNifti(name, header.Geometry);
  ComponentOf(header.ScalarType);

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
