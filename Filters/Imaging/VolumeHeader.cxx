#include "VolumeHeader.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkType.h"

#include <type_traits>

namespace FlipFree
{
namespace
{

struct TypePair
{
  int ScalarType;
  VoxelType Type;
};

/// The first pair of a type is the one that it is read as.
constexpr TypePair TypePairs[] = { { VTK_SIGNED_CHAR, VoxelType::Int8 },
  { VTK_UNSIGNED_CHAR, VoxelType::UInt8 }, { VTK_SHORT, VoxelType::Int16 },
  { VTK_UNSIGNED_SHORT, VoxelType::UInt16 }, { VTK_INT, VoxelType::Int32 },
  { VTK_UNSIGNED_INT, VoxelType::UInt32 }, { VTK_TYPE_INT64, VoxelType::Int64 },
  { VTK_TYPE_UINT64, VoxelType::UInt64 }, { VTK_LONG, VoxelType::Int64 },
  { VTK_UNSIGNED_LONG, VoxelType::UInt64 }, { VTK_LONG_LONG, VoxelType::Int64 },
  { VTK_UNSIGNED_LONG_LONG, VoxelType::UInt64 }, { VTK_ID_TYPE, VoxelType::Int64 },
  { VTK_CHAR, std::is_signed<char>::value ? VoxelType::Int8 : VoxelType::UInt8 },
  { VTK_FLOAT, VoxelType::Float32 }, { VTK_DOUBLE, VoxelType::Float64 } };

} // namespace

std::size_t VolumeHeader::NumberOfBytes() const
{
  return this->Geometry.NumberOfVoxels() *
    static_cast<std::size_t>(vtkDataArray::GetDataTypeSize(this->ScalarType));
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
  const TypePair* pair = TypePairs;
  while (pair->Type != type)
  {
    ++pair;
  }
  return pair->ScalarType;
}

VoxelType VoxelTypeOf(int scalarType)
{
  for (const TypePair& pair : TypePairs)
  {
    if (pair.ScalarType == scalarType)
    {
      return pair.Type;
    }
  }
  throw ImageFileError(vtkErrorCode::FileFormatError,
    std::string("Voxels of type ") + vtkImageScalarTypeNameMacro(scalarType) +
      " cannot be written. Convert them to an integer type of up to 64 bits, to float or to "
      "double.");
}

} // namespace FlipFree
