/**
 * What a user knows about an organ at one location: a point that lies inside, outside, or on its
 * boundary, or a further sphere within it. A list of them is a set: its order means nothing.
 */
#ifndef FlipFreePointConstraint_h
#define FlipFreePointConstraint_h

#include "Image/SeedRegion.h"

#include <optional>
#include <string>
#include <vector>

namespace FlipFree
{

/// The values of the array `Constraint`.
enum class ConstraintKind : unsigned char
{
  Outside = 0,
  Inside = 1,
  Boundary = 2,
  Seed = 3
};

/// What files and options call a kind: outside, inside, boundary or seed.
const char* NameOf(ConstraintKind kind);

/// All of them in words.
constexpr const char* KindsInWords = "outside, inside, boundary or seed";

/// The kind of that name; none where there is no such kind.
std::optional<ConstraintKind> KindNamed(const std::string& name);

/// When outside points become obstacles. A surface that grows around an obstacle is held back
/// beyond it, too: it ends better if it may pass the point, is pulled back before the last level,
/// and finds the boundary around the point in that level. That may fail where other points stand in
/// the way; from the start does not.
enum class OutsidePoints
{
  FromTheStart,
  InTheLastLevel,
  AroundThem ///< as before; the surface may even begin around them
};

struct PointConstraint
{
  ConstraintKind Kind = ConstraintKind::Inside;
  Eigen::Vector3d Point = Eigen::Vector3d::Zero(); ///< millimeters
  double Radius = 0;                               ///< millimeters; of a seed
  /// In messages, where kind and place are not how the user knows it. Two that differ in it alone
  /// are the same.
  std::string Name = {};

  friend bool operator==(const PointConstraint& a, const PointConstraint& b)
  {
    return a.Kind == b.Kind && a.Point == b.Point && a.Radius == b.Radius;
  }
};

using ConstraintList = std::vector<PointConstraint>;

/// In one order for the same set, each once; of the same ones, the first of the list.
ConstraintList SortedConstraints(ConstraintList constraints);

/// Makes the largest sphere the seed, of equal ones that of the least coordinates, and the other
/// ones constraints.
void TakeLargestSeed(SeedSphere& seed, ConstraintList& constraints);

/// "the inside point (1, 2, 3) mm", or its name, for messages.
std::string NameOf(const PointConstraint& constraint);

/// Throws Error, naming the constraint, where one lies outside the image, named by `name`, has a
/// coordinate or a radius that is not finite, or a radius below a voxel, or contradicts another: an
/// outside point in a further seed, or two kinds at one place.
void RequireConstraints(const ImageGeometry& geometry, const ConstraintList& constraints,
  const std::string& name);

/// Likewise, and where an outside or a boundary point lies deep in the seed, which is the largest
/// sphere in the label map named by `filled`, unless that is empty.
void RequireConstraints(const ImageGeometry& geometry, const SeedSphere& seed,
  const ConstraintList& constraints, const std::string& name, const std::string& filled);

} // namespace FlipFree

#endif
