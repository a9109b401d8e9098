/**
 * Conflicts that make it impossible to segment several organs together, found in advance: names
 * that are not distinct, and seeds, points and fixed surfaces that contradict each other. Each
 * check throws Error, naming the organs and a remedy.
 */
#ifndef FlipFreeOrganConflicts_h
#define FlipFreeOrganConflicts_h

#include "Deformation/StartSurface.h"
#include "Image/PointConstraint.h"
#include "KernelTypes.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// A surface that stays as it is, and that the organs must not meet: an earlier result.
struct FixedSurface
{
  std::string Name; ///< in messages as it is, unlike names of organs, which are quoted
  DeformableSurface Surface;
};

/// What is known of an organ before it is segmented.
struct KnownOrgan
{
  std::string Name;
  SeedSphere Seed;
  ConstraintList Points; ///< further seeds among them
};

struct OrganStart
{
  std::string Name;
  SeedSphere Seed;
  SeedSphere Sphere;         ///< where the surface starts
  DeformableSurface Surface; ///< that sphere's mesh
};

/// There is an organ, and each has a name of its own.
void RequireDistinctNames(const std::vector<std::string>& names);

/// Seeds and points of different organs, and those of each from the fixed surfaces. Points nearer
/// than `same` are in the same place.
void RequirePointsApart(const std::vector<KnownOrgan>& organs,
  const std::vector<FixedSurface>& fixed, double same);

/// Start spheres and fixed surfaces.
void RequireStartsApart(const std::vector<OrganStart>& starts,
  const std::vector<FixedSurface>& fixed, const ParallelFor& parallelFor);

/// Of embedded surfaces. Exact.
bool MeetOrNest(const std::vector<const DeformableSurface*>& surfaces,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
