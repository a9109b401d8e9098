#include "VolumeHeader.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"

#include <climits>
#include <sstream>

namespace FlipFree
{
namespace
{

using Component = itk::ImageIOBase::IOComponentEnum;

int ScalarTypeOf(Component component, const std::string& name)
{
  switch (component)
  {
    case Component::CHAR:
      return VTK_SIGNED_CHAR;
    case Component::UCHAR:
      return VTK_UNSIGNED_CHAR;
    case Component::SHORT:
      return VTK_SHORT;
    case Component::USHORT:
      return VTK_UNSIGNED_SHORT;
    case Component::INT:
      return VTK_INT;
    case Component::UINT:
      return VTK_UNSIGNED_INT;
    case Component::LONG:
      return VTK_LONG;
    case Component::ULONG:
      return VTK_UNSIGNED_LONG;
    case Component::LONGLONG:
      return VTK_LONG_LONG;
    case Component::ULONGLONG:
      return VTK_UNSIGNED_LONG_LONG;
    case Component::FLOAT:
      return VTK_FLOAT;
    case Component::DOUBLE:
      return VTK_DOUBLE;
    default:
      throw ImageFileError(vtkErrorCode::FileFormatError,
        "The voxels of '" + name + "' are of a type that VTK does not have. Convert them to an " +
          "integer type of up to 64 bits, to float or to double.");
  }
}

std::string DimensionsText(const itk::ImageIOBase* io)
{
  std::ostringstream text;
  for (unsigned int axis = 0; axis < io->GetNumberOfDimensions(); ++axis)
  {
    text << (axis ? " x " : "") << io->GetDimensions(axis);
  }
  return text.str();
}

void RequireOneVolume(const itk::ImageIOBase* io, const std::string& name)
{
  const unsigned int dimension = io->GetNumberOfDimensions();
  if (dimension < 3)
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "'" + name + "' is an image of " + std::to_string(dimension) + " dimensions (" +
        DimensionsText(io) + "), not a volume. Give a volume, or the folder of the DICOM series " +
        "that the slice belongs to.");
  }
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    const auto size = io->GetDimensions(axis);
    if (size < 1 || size > INT_MAX)
    {
      throw ImageFileError(vtkErrorCode::FileFormatError,
        "'" + name + "' claims to have " + DimensionsText(io) +
          " voxels. Its header is damaged: " + "get the file anew.");
    }
    // A fourth axis of one time point is only a way of writing a volume.
    if (axis >= 3 && size > 1)
    {
      throw ImageFileError(vtkErrorCode::FileFormatError,
        "'" + name + "' has " + std::to_string(dimension) + " dimensions (" + DimensionsText(io) +
          "). Extract one volume of the series into a file of its own.");
    }
  }
  if (io->GetNumberOfComponents() != 1)
  {
    throw ImageFileError(vtkErrorCode::FileFormatError,
      "'" + name + "' has " + std::to_string(io->GetNumberOfComponents()) +
        " components per voxel, where one is wanted. Extract one component, or convert colours " +
        "to grey.");
  }
}

} // namespace

std::size_t VolumeHeader::ScalarSize() const
{
  return static_cast<std::size_t>(vtkDataArray::GetDataTypeSize(this->ScalarType));
}

std::size_t VolumeHeader::NumberOfBytes() const
{
  return this->Geometry.NumberOfVoxels() * this->ScalarSize();
}

VolumeHeader HeaderOf(const itk::ImageIOBase* io, const std::string& name)
{
  RequireOneVolume(io, name);
  VolumeHeader header;
  header.ScalarType = ScalarTypeOf(io->GetComponentType(), name);
  ImageGeometry& geometry = header.Geometry;
  for (int axis = 0; axis < 3; ++axis)
  {
    geometry.Dimensions[axis] = static_cast<int>(io->GetDimensions(axis));
    geometry.Origin[axis] = io->GetOrigin(axis);
    geometry.Spacing[axis] = io->GetSpacing(axis);
    const std::vector<double> direction = io->GetDirection(axis);
    geometry.Direction.col(axis) =
      Eigen::Map<const Eigen::Vector3d>(direction.data()).array() + 0.0; // no minus zero
    if (geometry.Spacing[axis] < 0) // as ITK does: the axis runs the other way
    {
      geometry.Spacing[axis] *= -1;
      geometry.Direction.col(axis) *= -1;
    }
  }
  if (!geometry.Origin.allFinite() || !geometry.Spacing.allFinite() ||
    !geometry.Direction.allFinite() || geometry.Spacing.minCoeff() <= 0 ||
    std::abs(geometry.Direction.determinant()) < 1e-6)
  {
    std::ostringstream message;
    message << "'" << name << "' has no usable geometry: origin (" << geometry.Origin.transpose()
            << "), spacing (" << geometry.Spacing.transpose() << "), determinant of the direction "
            << "matrix " << geometry.Direction.determinant()
            << ". Spacings must be positive and the directions independent: mend its header.";
    throw ImageFileError(vtkErrorCode::FileFormatError, message.str());
  }
  return header;
}

void ReadVoxels(itk::ImageIOBase* io, const std::string& name, void* voxels)
{
  itk::ImageIORegion whole(io->GetNumberOfDimensions());
  for (unsigned int axis = 0; axis < io->GetNumberOfDimensions(); ++axis)
  {
    whole.SetSize(axis, io->GetDimensions(axis));
  }
  io->SetIORegion(whole);
  try
  {
    io->Read(voxels);
  }
  catch (const itk::ExceptionObject& exception)
  {
    throw ImageFileError(vtkErrorCode::PrematureEndOfFileError,
      "The voxels of '" + name + "' cannot be read: the file is truncated or damaged. Get it " +
        "anew. (ITK: " + exception.GetDescription() + ")");
  }
}

} // namespace FlipFree
