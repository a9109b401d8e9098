#include "Exchange/NiftiHeader.h"

#include "Exchange/HeaderField.h"
#include "Exchange/NiftiFields.h"
#include "Exchange/NiftiLabelTable.h"
#include "Exchange/NiftiOrientation.h"
#include "MessageText.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>

namespace FlipFree
{
namespace
{

/// nifti1.h's codes of types.
struct NiftiType
{
  int Code;
  VoxelType Type;
};

constexpr NiftiType NiftiTypes[] = { { 2, VoxelType::UInt8 }, { 4, VoxelType::Int16 },
  { 8, VoxelType::Int32 }, { 16, VoxelType::Float32 }, { 64, VoxelType::Float64 },
  { 256, VoxelType::Int8 }, { 512, VoxelType::UInt16 }, { 768, VoxelType::UInt32 },
  { 1024, VoxelType::Int64 }, { 1280, VoxelType::UInt64 } };

VoxelType TypeOfCode(const std::string& name, int code)
{
  for (const NiftiType& known : NiftiTypes)
  {
    if (known.Code == code)
    {
      return known.Type;
    }
  }
  constexpr int complex = 32;
  constexpr int colors = 128;
  constexpr int colorsWithOpacity = 2304;
  if (code == complex || code == colors || code == colorsWithOpacity)
  {
    RefuseComponents(name, code == complex ? 2 : (code == colors ? 3 : 4));
  }
  RefuseField(name, "datatype",
    "is " + std::to_string(code) +
      ", which stands for none of the types that are read: integers of 8 to 64 bits, float and "
      "double");
}

std::array<int, 3> NiftiSize(const std::string& name, const NiftiFields& fields)
{
  const double dimension = fields.Dimension(0);
  if (!(dimension >= 1) || dimension > 7)
  {
    RefuseField(name, "dim[0]", "is " + TextOf(dimension) + ", not a dimension from 1 to 7");
  }
  std::vector<double> sizes;
  for (int axis = 1; axis <= static_cast<int>(dimension); ++axis)
  {
    const double size = fields.Dimension(axis);
    if (size < 0 || (size == 0 && axis <= 3) || size > INT_MAX)
    {
      RefuseField(name, "dim[" + std::to_string(axis) + "]",
        "is " + TextOf(size) + ", but must be positive");
    }
    sizes.push_back(std::max(1., size)); // a trailing axis of length zero is one of length one
  }
  return VolumeSize(name, sizes);
}

/// The first byte of the voxels in their file.
std::uint64_t NiftiOffset(const std::string& name, const NiftiFields& fields)
{
  const double offset = fields.VoxelOffset();
  if (!(offset >= 0) || offset > static_cast<double>(LLONG_MAX))
  {
    RefuseField(name, "vox_offset", "is not a place in the file");
  }
  // Behind the header stand four bytes that say whether there is more to it.
  const double least = fields.IsPair() ? 0 : static_cast<double>(fields.GetVersion()) + 4;
  return static_cast<std::uint64_t>(std::max(least, offset));
}

/// A slope of zero means none. So does what is no number, of which programs make use. Analyze has
/// no scale, but SPM puts one in the same place.
void ReadScale(const std::string& name, const NiftiFields& fields, VolumeFileHeader& header)
{
  const double slope = fields.Slope();
  if (slope == 0 || !std::isfinite(slope))
  {
    return;
  }
  if (fields.IsAnalyze())
  {
    if (slope != 1)
    {
      header.Warnings.push_back("'" + name + "' has the scale " + TextOf(slope) +
        ", as SPM writes it, which is not part of the Analyze format. It was not applied.");
    }
    return;
  }
  if (!std::isfinite(fields.Intercept()))
  {
    RefuseField(name, "scl_inter", "is " + TextOf(fields.Intercept()) + ", not a finite number");
  }
  header.Slope = slope;
  header.Intercept = fields.Intercept();
}

/// The other file of a pair, whose ending is in the same case.
std::string VoxelsOfPair(const std::string& name)
{
  const std::string file = name.substr(name.find_last_of("/\\") + 1);
  for (const std::string ending : { ".hdr.gz", ".hdr" })
  {
    if (HasEnding(file, ending))
    {
      const bool isUpper = file.back() < 'a';
      return file.substr(0, file.size() - ending.size()) + (isUpper ? ".IMG" : ".img");
    }
  }
  return file.substr(0, file.rfind('.')) + ".img";
}

template <typename T>
void Put(std::string& bytes, std::size_t offset, T value)
{
  std::memcpy(&bytes[offset], &value, sizeof(T));
}

void PutReals(std::string& bytes, std::size_t offset, const Eigen::VectorXd& values)
{
  for (Eigen::Index index = 0; index < values.size(); ++index)
  {
    Put(bytes, offset + 4 * static_cast<std::size_t>(index), static_cast<float>(values[index]));
  }
}

} // namespace

bool IsNifti(const std::string& start)
{
  return NiftiFields(start).GetVersion() != NiftiFields::Version::None;
}

VolumeFileHeader ReadNiftiHeader(const std::string& name, const std::string& start)
{
  const NiftiFields fields(start);
  if (!fields.IsWhole())
  {
    RefuseField(name, "it",
      "ends after fewer than " + std::to_string(static_cast<int>(fields.GetVersion())) + " bytes");
  }
  VolumeFileHeader header;
  header.Name = name;
  const std::array<int, 3> size = NiftiSize(name, fields);
  header.Storage.Type = TypeOfCode(name, fields.DataType());
  header.Storage.IsBigEndian = fields.IsBigEndian();
  header.Geometry = NiftiGrid(name, fields, size, header.Warnings);
  ReadScale(name, fields, header);
  header.Storage.Offset = NiftiOffset(name, fields);
  header.Storage.MayBePacked = true;
  if (fields.IsPair())
  {
    header.Storage.Files = { VoxelsOfPair(name) };
  }
  else
  {
    header.LabelNames = NiftiLabelNames(start, static_cast<std::size_t>(fields.GetVersion()),
      header.Storage.Offset, fields.IsBigEndian());
  }
  return header;
}

std::string NiftiHeaderOf(const std::string& name, const ImageGeometry& grid, VoxelType type)
{
  constexpr std::size_t size = 352;
  std::string bytes(size, '\0');
  Put<std::int32_t>(bytes, 0, 348);
  Put<std::int16_t>(bytes, 40, 3);
  for (std::size_t axis = 0; axis < 7; ++axis)
  {
    const int count = axis < 3 ? grid.Dimensions[axis] : 1;
    if (count > SHRT_MAX)
    {
      throw FileProblem(FileProblem::Kind::Unusable,
        "'" + name +
          "' cannot be written: NIfTI files have at most 32767 voxels along an axis, and "
          "the image has " +
          std::to_string(count) + ". Use .nrrd or .mha.");
    }
    Put(bytes, 42 + 2 * axis, static_cast<std::int16_t>(count));
  }
  const auto* const known = std::find_if(std::begin(NiftiTypes), std::end(NiftiTypes),
    [type](const NiftiType& candidate) { return candidate.Type == type; });
  Put(bytes, 70, static_cast<std::int16_t>(known->Code));
  Put(bytes, 72, static_cast<std::int16_t>(8 * SizeOf(type)));
  PutReals(bytes, 80, grid.Spacing);
  Put(bytes, 108, static_cast<float>(size));
  Put(bytes, 112, 1.F);
  constexpr char millimeters = 2;
  bytes[123] = millimeters;

  Eigen::Matrix3d axes = MirroredAxes.asDiagonal() * grid.Direction;
  const Eigen::Vector3d origin = MirroredAxes.cwiseProduct(grid.Origin);
  const double handedness = axes.determinant() < 0 ? -1 : 1;
  Put(bytes, 76, static_cast<float>(handedness));
  axes.col(2) *= handedness;
  const Eigen::Vector3d quaternion = QuaternionOf(axes);
  ImageGeometry turned = grid;
  turned.Direction = MirroredAxes.asDiagonal() * RotationOf(quaternion);
  turned.Direction.col(2) *= handedness;
  constexpr double same = 0.01; // of a voxel
  if (GreatestShift(turned, grid) < same * grid.Spacing.minCoeff())
  {
    Put<std::int16_t>(bytes, 252, 1); // the scanner's coordinates
    PutReals(bytes, 256, quaternion);
    PutReals(bytes, 268, origin);
  }
  Put<std::int16_t>(bytes, 254, 1);
  for (int row = 0; row < 3; ++row)
  {
    Eigen::Vector4d entries;
    entries << MirroredAxes[row] * (grid.Direction.row(row).transpose().cwiseProduct(grid.Spacing)),
      origin[row];
    PutReals(bytes, 280 + 16 * static_cast<std::size_t>(row), entries);
  }
  bytes.replace(344, 3, "n+1");
  return bytes;
}

} // namespace FlipFree
