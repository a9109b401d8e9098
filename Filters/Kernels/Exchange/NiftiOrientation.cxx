#include "Exchange/NiftiOrientation.h"

#include "Exchange/HeaderField.h"
#include "MessageText.h"

#include <cmath>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

/// Columns: steps of the voxels' axes, and the first voxel; in RAS.
using Affine = Eigen::Matrix<double, 3, 4>;

/// Lengths in millimeters by `xyzt_units`; a file that does not say means them.
double NiftiUnit(const NiftiFields& fields)
{
  constexpr int ofSpace = 7;
  constexpr int meters = 1;
  constexpr int micrometers = 3;
  if (fields.IsAnalyze())
  {
    return 1;
  }
  switch (fields.Units() & ofSpace)
  {
    case meters:
      return 1000;
    case micrometers:
      return 1e-3;
    default:
      return 1;
  }
}

std::string NameOfEntry(int entry)
{
  const char* const rows[] = { "srow_x", "srow_y", "srow_z" };
  return rows[entry / 4] + ("[" + std::to_string(entry % 4) + "]");
}

Affine AffineOf(const NiftiFields& fields)
{
  Affine affine;
  for (int entry = 0; entry < 12; ++entry)
  {
    affine(entry / 4, entry % 4) = fields.Affine(entry);
  }
  return affine * NiftiUnit(fields);
}

/// Steps that point nowhere, or all within a plane.
bool CanBeInverted(const Affine& affine)
{
  const Eigen::Matrix3d steps = affine.leftCols<3>();
  const Eigen::Vector3d lengths = steps.colwise().norm();
  return affine.allFinite() && affine.cwiseAbs().maxCoeff() <= GreatestLength &&
    lengths.minCoeff() > LeastSpacing &&
    std::abs(steps.determinant()) > LeastDeterminant * lengths.prod();
}

/// What makes the sform unusable: the field, and what is wrong with it.
std::pair<std::string, std::string> FaultOfAffine(const NiftiFields& fields)
{
  const Affine affine = AffineOf(fields);
  for (int entry = 0; entry < 12; ++entry)
  {
    const double inMillimeters = affine(entry / 4, entry % 4);
    const std::string fault = WhyNoLength(inMillimeters);
    if (!fault.empty())
    {
      return { NameOfEntry(entry), fault };
    }
  }
  for (int row = 0; row < 3; ++row)
  {
    if (affine.row(row).head<3>().isZero())
    {
      return { NameOfEntry(4 * row).substr(0, 6),
        "holds zeros where it should say which way the voxels' axes run" };
    }
  }
  return { "the sform", "cannot be inverted: its axes lie in a plane" };
}

Eigen::Vector3d PixelSizes(const std::string& name, const NiftiFields& fields)
{
  Eigen::Vector3d sizes;
  for (int axis = 0; axis < 3; ++axis)
  {
    sizes[axis] = fields.PixelDimension(axis + 1);
    RequireSpacing(name, "pixdim[" + std::to_string(axis + 1) + "]", sizes[axis]);
  }
  return sizes * NiftiUnit(fields);
}

Affine AffineOfQuaternion(const std::string& name, const NiftiFields& fields)
{
  const char* const names[] = { "quatern_b", "quatern_c", "quatern_d", "qoffset_x", "qoffset_y",
    "qoffset_z" };
  for (int index = 0; index < 6; ++index)
  {
    RequireLength(name, names[index], fields.Quaternion(index));
  }
  const double handedness = fields.PixelDimension(0);
  if (!std::isfinite(handedness))
  {
    RefuseField(name, "pixdim[0]", "is not a finite number, where 1 or -1 is expected");
  }
  const Eigen::Vector3d parts(fields.Quaternion(0), fields.Quaternion(1), fields.Quaternion(2));
  constexpr double rounding = 0.01;
  if (parts.squaredNorm() > 1 + rounding)
  {
    RefuseField(name, "quatern_b, _c and _d",
      "are " + TextOf(parts) + ", which is longer than 1 and no rotation");
  }
  const Eigen::Vector3d sizes = PixelSizes(name, fields);
  Affine affine;
  affine.leftCols<3>() = RotationOf(parts) * sizes.asDiagonal();
  affine.col(2) *= handedness < 0 ? -1 : 1;
  affine.col(3) = NiftiUnit(fields) *
    Eigen::Vector3d(fields.Quaternion(3), fields.Quaternion(4), fields.Quaternion(5));
  return affine;
}

/// The qform that would be taken if there were no sform; none where it is of no use.
std::optional<Affine> UsableQuaternion(const std::string& name, const NiftiFields& fields)
{
  try
  {
    return fields.QuaternionCode() > 0 ? std::optional<Affine>(AffineOfQuaternion(name, fields))
                                       : std::nullopt;
  }
  catch (const FileProblem&)
  {
    return std::nullopt;
  }
}

ImageGeometry GridOfAffine(const std::string& name, const Affine& affine,
  const std::array<int, 3>& size)
{
  return GridOfSteps(name, size, MirroredAxes.asDiagonal() * affine.leftCols<3>(),
    MirroredAxes.cwiseProduct(affine.col(3)));
}

/// Not where one of them is NaN.
bool AreNear(double size, double other, double tolerance)
{
  return std::abs(size - other) < tolerance * other;
}

/// A matrix is rounded entry by entry; where the header has the voxel size beside it, that is what
/// was meant. Of a sheared grid, such as that of a tilted gantry, a size may be the distance
/// between the planes of voxels, which is less than the step from one to the next.
void TakePixelSizes(const std::string& name, const NiftiFields& fields, ImageGeometry& grid,
  std::vector<std::string>& warnings)
{
  constexpr double rounding = 1e-5;
  constexpr double other = 0.01;
  const Eigen::Vector3d distances = grid.IndexReach(1).cwiseInverse();
  Eigen::Vector3d sizes;
  bool areRounded = true;
  bool areTheSame = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    sizes[axis] = NiftiUnit(fields) * fields.PixelDimension(axis + 1);
    areRounded = areRounded && AreNear(sizes[axis], grid.Spacing[axis], rounding);
    areTheSame = areTheSame &&
      (AreNear(sizes[axis], grid.Spacing[axis], other) ||
        AreNear(sizes[axis], distances[axis], other));
  }
  if (areRounded)
  {
    grid.Spacing = sizes;
  }
  else if (!areTheSame)
  {
    warnings.push_back("'" + name + "' gives two voxel sizes: " + TextOf(grid.Spacing) +
      " mm in its sform, which was taken, and " + TextOf(sizes) +
      " mm in pixdim. Check the size of the result.");
  }
}

void WarnOfQuaternion(const std::string& name, const ImageGeometry& taken,
  const ImageGeometry& other, std::vector<std::string>& warnings)
{
  const double shift = GreatestShift(taken, other);
  constexpr double ofVoxel = 0.5;
  if (shift > ofVoxel * taken.Spacing.minCoeff())
  {
    warnings.push_back("'" + name + "' says twice where its voxels are, up to " + TextOf(shift) +
      " mm apart. The sform was taken, not the qform.");
  }
}

} // namespace

double GreatestShift(const ImageGeometry& one, const ImageGeometry& other)
{
  double greatest = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d index((corner & 1) * (one.Dimensions[0] - 1),
      (corner >> 1 & 1) * (one.Dimensions[1] - 1), (corner >> 2 & 1) * (one.Dimensions[2] - 1));
    greatest = std::max(greatest, (one.ToPhysical(index) - other.ToPhysical(index)).norm());
  }
  return greatest;
}

Eigen::Vector3d QuaternionOf(const Eigen::Matrix3d& rotation)
{
  const Eigen::Quaterniond quaternion(rotation);
  return quaternion.w() < 0 ? Eigen::Vector3d(-quaternion.vec())
                            : Eigen::Vector3d(quaternion.vec());
}

Eigen::Matrix3d RotationOf(const Eigen::Vector3d& quaternion)
{
  const double first = std::sqrt(std::max(0., 1 - quaternion.squaredNorm()));
  return Eigen::Quaterniond(first, quaternion.x(), quaternion.y(), quaternion.z())
    .normalized()
    .toRotationMatrix();
}

ImageGeometry NiftiGrid(const std::string& name, const NiftiFields& fields,
  const std::array<int, 3>& size, std::vector<std::string>& warnings)
{
  const bool hasAffine = !fields.IsAnalyze() && fields.AffineCode() > 0;
  const bool hasQuaternion = !fields.IsAnalyze() && fields.QuaternionCode() > 0;
  if (hasAffine && CanBeInverted(AffineOf(fields)))
  {
    ImageGeometry grid = GridOfAffine(name, AffineOf(fields), size);
    if (const std::optional<Affine> other = UsableQuaternion(name, fields))
    {
      WarnOfQuaternion(name, grid, GridOfAffine(name, *other, size), warnings);
    }
    TakePixelSizes(name, fields, grid, warnings);
    return grid;
  }
  if (hasAffine && !UsableQuaternion(name, fields))
  {
    const auto [field, fault] = FaultOfAffine(fields);
    RefuseField(name, field, fault);
  }
  if (hasQuaternion)
  {
    if (hasAffine)
    {
      const auto [field, fault] = FaultOfAffine(fields);
      warnings.push_back("The sform of '" + name + "' cannot be used: " + field + " " + fault +
        ". The qform was taken in its place.");
    }
    ImageGeometry grid = GridOfAffine(name, AffineOfQuaternion(name, fields), size);
    grid.Spacing = PixelSizes(name, fields); // to the last digit
    return grid;
  }
  Affine affine = Affine::Zero();
  affine.leftCols<3>() = PixelSizes(name, fields).asDiagonal();
  warnings.push_back("'" + name + "' does not say where its voxels are" +
    (fields.IsAnalyze() ? ", as an Analyze file cannot" : ", having neither a qform nor an sform") +
    ". Its axes were taken for right, anterior and superior, and its first voxel for the origin. "
    "Left and right may be exchanged.");
  return GridOfAffine(name, affine, size);
}

} // namespace FlipFree
