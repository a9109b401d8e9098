#include "VolumeHeader.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkType.h"

#include <climits>
#include <sstream>
#include <type_traits>

namespace FlipFree
{
namespace
{

using Component = itk::ImageIOBase::IOComponentEnum;

struct TypePair
{
  int ScalarType;
  Component ItkComponent;
};

/// The first pair of a component is the type that it is read as: integers of 64 bits have several.
constexpr TypePair TypePairs[] = { { VTK_SIGNED_CHAR, Component::CHAR },
  { VTK_UNSIGNED_CHAR, Component::UCHAR }, { VTK_SHORT, Component::SHORT },
  { VTK_UNSIGNED_SHORT, Component::USHORT }, { VTK_INT, Component::INT },
  { VTK_UNSIGNED_INT, Component::UINT }, { VTK_TYPE_INT64, Component::LONGLONG },
  { VTK_TYPE_UINT64, Component::ULONGLONG }, { VTK_TYPE_INT64, Component::LONG },
  { VTK_TYPE_UINT64, Component::ULONG }, { VTK_LONG, Component::LONG },
  { VTK_UNSIGNED_LONG, Component::ULONG }, { VTK_LONG_LONG, Component::LONGLONG },
  { VTK_UNSIGNED_LONG_LONG, Component::ULONGLONG }, { VTK_ID_TYPE, Component::LONGLONG },
  { VTK_CHAR, std::is_signed<char>::value ? Component::CHAR : Component::UCHAR },
  { VTK_FLOAT, Component::FLOAT }, { VTK_DOUBLE, Component::DOUBLE } };

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
          " voxels. Its header is damaged. Download or copy the file again.");
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
        " components per voxel, but only one is supported. Extract one component, or convert "
        "colors to gray.");
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
  header.ScalarType = ScalarTypeOf(io->GetComponentType());
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

int ScalarTypeOf(Component component)
{
  for (const TypePair& pair : TypePairs)
  {
    if (pair.ItkComponent == component)
    {
      return pair.ScalarType;
    }
  }
  throw ImageFileError(vtkErrorCode::FileFormatError,
    "The voxels are of a type that VTK does not support. Convert them to an integer type of up to "
    "64 bits, to float or to double.");
}

unsigned long ErrorCodeOf(FileProblem::Kind kind)
{
  switch (kind)
  {
    case FileProblem::Kind::Missing:
      return vtkErrorCode::FileNotFoundError;
    case FileProblem::Kind::Unrecognized:
      return vtkErrorCode::UnrecognizedFileTypeError;
    case FileProblem::Kind::Incomplete:
      return vtkErrorCode::PrematureEndOfFileError;
    case FileProblem::Kind::Unusable:
      break;
  }
  return vtkErrorCode::FileFormatError;
}

int ScalarTypeOf(VoxelType type)
{
  constexpr int types[] = { VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
    VTK_INT, VTK_UNSIGNED_INT, VTK_TYPE_INT64, VTK_TYPE_UINT64, VTK_FLOAT, VTK_DOUBLE };
  return types[static_cast<int>(type)];
}

itk::ImageIOBase::IOComponentEnum ComponentOf(int scalarType)
{
  for (const TypePair& pair : TypePairs)
  {
    if (pair.ScalarType == scalarType)
    {
      return pair.ItkComponent;
    }
  }
  throw ImageFileError(vtkErrorCode::FileFormatError,
    std::string("Voxels of type ") + vtkImageScalarTypeNameMacro(scalarType) +
      " cannot be written. Convert them to an integer type of up to 64 bits, to float or to "
      "double.");
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
      "The voxels of '" + name + "' cannot be read: the file is truncated or damaged. " +
        "Download or copy it again. (ITK: " + exception.GetDescription() + ")");
  }
}

} // namespace FlipFree
