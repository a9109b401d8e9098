/**
 * Where constraints have changed nothing in a foreground. Corrections promise to move the surface
 * only locally, and the same evidence alone does not ensure that: a mesh whose vertices arrived by
 * another route comes to rest elsewhere on the voxels of a mask, by some tenths of a millimeter. So
 * in these places the surface without constraints is kept.
 */
#ifndef FlipFreeUnchangedPlaces_h
#define FlipFreeUnchangedPlaces_h

#include "Deformation/ConstraintEnforcer.h"
#include "Deformation/StartSurface.h"
#include "Image/BitMask.h"

namespace FlipFree
{

/// Of what differs, the parts that reach farther than `depth` millimeters away from what the masks
/// have in common: leaks that go, and lobes that are added, without what is connected to them
/// farther away from where they are deep. Returns false if the monitor stopped it.
bool FindDeepChange(const BitMask& before, const BitMask& after, double depth,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& deep);

class UnchangedPlaces
{
public:
  /// `changed` are voxels; the surroundings of the constraints count as changed, too.
  UnchangedPlaces(BitMask changed, const ConstraintList& constraints);

  /// From 0 near to a change to 1 where nothing has changed within ChangeReach, one per point.
  Eigen::VectorXd WeightsOf(const PointList& points, const ParallelFor& parallelFor) const;

  /// In millimeters.
  static constexpr double ChangeReach = 15;

private:
  double WeightAt(const Eigen::Vector3d& place) const;

  const BitMask Changed;
  const VoxelBox Bounds;
  const ConstraintList Constraints;
};

/// Moves vertices toward the nearest places of a surface, by guarded steps, as far as their weights
/// say. Returns false if the monitor stopped it.
bool Attract(const DeformableSurface& surface, const Eigen::VectorXd& weights,
  const PointList& obstacles, const GuardedStep& step, const ParallelFor& parallelFor,
  const Monitor& monitor, PointList& points);

} // namespace FlipFree

#endif
