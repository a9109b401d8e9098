#include "Image/PointConstraint.h"

#include "Error.h"
#include "Image/PointCheck.h"
#include "MessageText.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace FlipFree
{
namespace
{

// In the order of ConstraintKind.
constexpr const char* KindNames[] = { "outside", "inside", "boundary", "seed" };

// Places that are nearer than this part of the finest spacing cannot be told apart.
constexpr double SamePlace = 1e-3;

// The seed sphere is placed by hand, so only its inner part is certain.
constexpr double CertainPartOfSeed = 0.5;

auto KeyOf(const PointConstraint& constraint)
{
  const Eigen::Vector3d& at = constraint.Point;
  return std::make_tuple(constraint.Kind, at[0], at[1], at[2], constraint.Radius);
}

void RequireProper(const ImageGeometry& geometry, const PointConstraint& constraint,
  const std::string& name)
{
  RequirePoint(geometry, constraint.Point, NameOf(constraint), name);
  if (constraint.Kind == ConstraintKind::Seed &&
    !(constraint.Radius >= geometry.Spacing.minCoeff() && std::isfinite(constraint.Radius)))
  {
    throw Error(ErrorCode::OutOfRange,
      NameOf(constraint) + " has a radius of " + TextOf(constraint.Radius) +
        " mm, where at least a voxel of " + name + " (" + TextOf(geometry.Spacing.minCoeff()) +
        " mm) is needed; raise it");
  }
}

void RequireApart(const PointConstraint& point, const SeedSphere& seed, const std::string& which,
  const std::string& remedy)
{
  if ((point.Point - seed.Center).norm() < seed.Radius)
  {
    throw Error(ErrorCode::OutOfRange, NameOf(point) + " lies in " + which + "; " + remedy);
  }
}

} // namespace

ConstraintList SortedConstraints(ConstraintList constraints)
{
  std::stable_sort(constraints.begin(), constraints.end(),
    [](const auto& a, const auto& b) { return KeyOf(a) < KeyOf(b); });
  constraints.erase(std::unique(constraints.begin(), constraints.end(),
                      [](const auto& a, const auto& b) { return KeyOf(a) == KeyOf(b); }),
    constraints.end());
  return constraints;
}

void TakeLargestSeed(SeedSphere& seed, ConstraintList& constraints)
{
  const auto isBefore = [](const PointConstraint& one, const PointConstraint& two)
  { return one.Radius != two.Radius ? one.Radius > two.Radius : KeyOf(one) < KeyOf(two); };
  PointConstraint largest{ ConstraintKind::Seed, seed.Center, seed.Radius };
  for (PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Seed && isBefore(constraint, largest))
    {
      std::swap(constraint, largest);
    }
  }
  seed = { largest.Point, largest.Radius };
}

const char* NameOf(ConstraintKind kind)
{
  return KindNames[static_cast<std::size_t>(kind)];
}

std::optional<ConstraintKind> KindNamed(const std::string& name)
{
  const auto* const found = std::find(std::begin(KindNames), std::end(KindNames), name);
  return found == std::end(KindNames)
    ? std::nullopt
    : std::optional<ConstraintKind>(static_cast<ConstraintKind>(found - std::begin(KindNames)));
}

std::string NameOf(const PointConstraint& constraint)
{
  if (!constraint.Name.empty())
  {
    return constraint.Name;
  }
  const std::string start = constraint.Kind == ConstraintKind::Seed
    ? "the further seed at "
    : std::string("the ") + NameOf(constraint.Kind) + " point ";
  return start + TextOf(constraint.Point) + " mm";
}

void RequireConstraints(const ImageGeometry& geometry, const ConstraintList& constraints,
  const std::string& name)
{
  const double same = SamePlace * geometry.Spacing.minCoeff();
  for (auto one = constraints.begin(); one != constraints.end(); ++one)
  {
    RequireProper(geometry, *one, name);
    for (auto two = one + 1; two != constraints.end(); ++two)
    {
      if (one->Kind != two->Kind && (one->Point - two->Point).norm() <= same)
      {
        throw Error(ErrorCode::OutOfRange,
          NameOf(*one) + " and " + NameOf(*two) + " are in the same place; remove one of them");
      }
    }
    if (one->Kind == ConstraintKind::Outside)
    {
      for (const PointConstraint& other : constraints)
      {
        if (other.Kind == ConstraintKind::Seed)
        {
          RequireApart(*one, { other.Point, other.Radius }, "the sphere of " + NameOf(other),
            "move one of them, or lower the radius");
        }
      }
    }
  }
}

void RequireConstraints(const ImageGeometry& geometry, const SeedSphere& seed,
  const ConstraintList& constraints, const std::string& name, const std::string& filled)
{
  RequireConstraints(geometry, constraints, name);
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Outside || constraint.Kind == ConstraintKind::Boundary)
    {
      RequireApart(constraint, { seed.Center, CertainPartOfSeed * seed.Radius },
        "the inner half of " +
          (filled.empty() ? "the seed sphere" : "the largest sphere in " + filled),
        filled.empty() ? "move one of them, or lower {SeedRadius}" : "move it");
    }
  }
}

} // namespace FlipFree
