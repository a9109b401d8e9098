#include "Deformation/OrganConflicts.h"

#include "Deformation/DeformationLoop.h"
#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "Mesh/MeshUnion.h"
#include "MessageText.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace FlipFree
{
namespace
{

DeformableSurface UnionOf(const std::vector<const DeformableSurface*>& surfaces)
{
  DeformableSurface all;
  all.Points.resize(0, 3);
  for (const DeformableSurface* surface : surfaces)
  {
    AppendMesh(surface->Mesh, all.Mesh);
    AppendPoints(surface->Points, all.Points);
  }
  return all;
}

PointConstraint SphereOf(const SeedSphere& seed)
{
  return { ConstraintKind::Seed, seed.Center, seed.Radius };
}

// The organ's seeds.
std::vector<PointConstraint> SpheresOf(const KnownOrgan& organ)
{
  std::vector<PointConstraint> spheres{ SphereOf(organ.Seed) };
  std::copy_if(organ.Points.begin(), organ.Points.end(), std::back_inserter(spheres),
    [](const PointConstraint& constraint) { return constraint.Kind == ConstraintKind::Seed; });
  return spheres;
}

std::string TextOfSphere(const PointConstraint& sphere)
{
  return "the sphere of " + FlipFree::TextOf(sphere.Radius) + " mm at " +
    FlipFree::TextOf(sphere.Point) + " mm";
}

void RequireSpheresApart(const KnownOrgan& one, const KnownOrgan& two)
{
  for (const PointConstraint& sphere : SpheresOf(one))
  {
    for (const PointConstraint& other : SpheresOf(two))
    {
      if ((sphere.Point - other.Point).norm() < sphere.Radius + other.Radius)
      {
        throw Error(ErrorCode::OutOfRange,
          "the seeds of " + Quoted(one.Name) + " and " + Quoted(two.Name) +
            " overlap: " + TextOfSphere(sphere) + " and " + TextOfSphere(other) +
            "; move them apart, or lower a radius");
      }
    }
  }
}

void RequireNoPointInSpheres(const KnownOrgan& one, const KnownOrgan& two)
{
  for (const PointConstraint& sphere : SpheresOf(one))
  {
    for (const PointConstraint& point : two.Points)
    {
      if (point.Kind != ConstraintKind::Outside &&
        (sphere.Point - point.Point).norm() < sphere.Radius)
      {
        throw Error(ErrorCode::OutOfRange,
          NameOf(point) + " of " + Quoted(two.Name) + " lies in the seed of " + Quoted(one.Name) +
            "; move one of them, or lower the radius");
      }
    }
  }
}

void RequirePlacesApart(const KnownOrgan& one, const KnownOrgan& two, double same)
{
  for (const PointConstraint& point : one.Points)
  {
    for (const PointConstraint& other : two.Points)
    {
      if (point.Kind == ConstraintKind::Inside &&
        (other.Kind == ConstraintKind::Inside || other.Kind == ConstraintKind::Boundary) &&
        (point.Point - other.Point).norm() <= same)
      {
        throw Error(ErrorCode::OutOfRange,
          NameOf(point) + " of " + Quoted(one.Name) + " and " + NameOf(other) + " of " +
            Quoted(two.Name) + " are in the same place; remove one of them");
      }
    }
  }
}

bool Contains(const FixedSurface& fixed, const Eigen::Vector3d& point)
{
  return WindingNumber(fixed.Surface.Points, fixed.Surface.Mesh.Triangles, point) != 0;
}

void RequireSphereOutside(const FixedSurface& fixed, const PointConstraint& sphere,
  const std::string& organ)
{
  const SurfacePlace nearest =
    ClosestPlace(fixed.Surface.Points, fixed.Surface.Mesh.Triangles, sphere.Point);
  if ((nearest.Point - sphere.Point).norm() < sphere.Radius || Contains(fixed, sphere.Point))
  {
    throw Error(ErrorCode::OutOfRange,
      "a seed of " + Quoted(organ) + ", " + TextOfSphere(sphere) + ", meets " + fixed.Name +
        ", which stays as it is; move the seed, or lower its radius");
  }
}

void RequireOutside(const FixedSurface& fixed, const KnownOrgan& organ)
{
  for (const PointConstraint& point : organ.Points)
  {
    if (point.Kind != ConstraintKind::Outside && Contains(fixed, point.Point))
    {
      throw Error(ErrorCode::UnreachablePoint,
        NameOf(point) + " of " + Quoted(organ.Name) + " lies in " + fixed.Name +
          ", which stays as it is; move the point");
    }
    if (point.Kind == ConstraintKind::Seed)
    {
      RequireSphereOutside(fixed, point, organ.Name);
    }
  }
}

} // namespace

bool MeetOrNest(const std::vector<const DeformableSurface*>& surfaces,
  const ParallelFor& parallelFor)
{
  const DeformableSurface all = UnionOf(surfaces);
  return CountSelfIntersections(all.Points, all.Mesh.Faces, parallelFor) > 0 ||
    !NoneIsWithinAnother(surfaces);
}

void RequireDistinctNames(const std::vector<std::string>& names)
{
  if (names.empty())
  {
    throw Error(ErrorCode::OutOfRange, "there is no organ; give each a name and a seed");
  }
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (sorted.front().empty() || twice != sorted.end())
  {
    throw Error(ErrorCode::OutOfRange,
      sorted.front().empty()
        ? "an organ has no name; give each one of its own"
        : "two organs are named " + Quoted(*twice) + "; give each a name of its own");
  }
}

void RequirePointsApart(const std::vector<KnownOrgan>& organs,
  const std::vector<FixedSurface>& fixed, double same)
{
  for (const KnownOrgan& one : organs)
  {
    for (const KnownOrgan& two : organs)
    {
      if (&one != &two)
      {
        RequireSpheresApart(one, two);
        RequireNoPointInSpheres(one, two);
        RequirePlacesApart(one, two, same);
      }
    }
    for (const FixedSurface& surface : fixed)
    {
      RequireOutside(surface, one);
    }
  }
}

void RequireStartsApart(const std::vector<OrganStart>& starts,
  const std::vector<FixedSurface>& fixed, const ParallelFor& parallelFor)
{
  for (auto one = starts.begin(); one != starts.end(); ++one)
  {
    for (auto two = one + 1; two != starts.end(); ++two)
    {
      if ((one->Sphere.Center - two->Sphere.Center).norm() <
        one->Sphere.Radius + two->Sphere.Radius)
      {
        throw Error(ErrorCode::OutOfRange,
          "the start spheres of " + Quoted(one->Name) + " and " + Quoted(two->Name) +
            " overlap; lower {StartScale}, or move the seeds apart");
      }
    }
    for (const FixedSurface& surface : fixed)
    {
      if (MeetOrNest({ &one->Surface, &surface.Surface }, parallelFor))
      {
        throw Error(ErrorCode::OutOfRange,
          "the start sphere of " + Quoted(one->Name) + " meets " + surface.Name +
            ", which stays as it is; move the seed, or lower its radius");
      }
      RequireSphereOutside(surface, SphereOf(one->Seed), one->Name);
    }
  }
  for (auto one = fixed.begin(); one != fixed.end(); ++one)
  {
    for (auto two = one + 1; two != fixed.end(); ++two)
    {
      if (MeetOrNest({ &one->Surface, &two->Surface }, parallelFor))
      {
        throw Error(ErrorCode::SelfIntersecting,
          one->Name + " and " + two->Name +
            " meet; of surfaces that stay as they are, none may meet another or lie in it");
      }
    }
  }
}

} // namespace FlipFree
