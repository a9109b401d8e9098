/**
 * The vertices that may move where the rest of a surface stays: how far each of them may, and when
 * they have come to rest. They form connected components, each of which comes to rest by itself, so
 * that what happens in one does not change another. Once all have, DeformingOrgan ends the level.
 */
#ifndef FlipFreeMobileComponents_h
#define FlipFreeMobileComponents_h

#include "Deformation/Correspondence.h"
#include "Deformation/SegmentationSettings.h"
#include "Mesh/ContourMesh.h"

#include <vector>

namespace FlipFree
{

class MobileComponents
{
public:
  /// One mobility per vertex: 0 where it stays, 1 where it moves freely.
  explicit MobileComponents(Eigen::VectorXd mobility);

  /// Begins a level: finds the connected components, none of which is at rest.
  void BeginLevel(const ContourMesh& mesh);

  /// Notes how far the components are from their targets. Returns the mean of all, without the rest
  /// of the surface, which would hide that they are not at rest.
  double MeasureDistances(const CorrespondenceField& field);

  /// Scales a motion, one row per vertex, by the mobilities; components at rest do not move.
  void Restrict(PointList& motion) const;

  /// Ends an iteration, in which distances were measured: a component whose own mean distances give
  /// a reason to stop (ScheduleSettings::ReasonToStop()) is at rest from now on. `voxel` is the
  /// greatest spacing.
  void FindThoseAtRest(const ScheduleSettings& schedule, double voxel);

  bool AreAllAtRest() const;

  /// Vertices that were pulled from one place to another must find the boundary again: they move
  /// freely if it was by a quarter of a voxel or more, and more freely than before if by less.
  void FreePulled(const PointList& from, const PointList& to, double voxel);

private:
  struct Component
  {
    std::vector<int> Vertices;
    std::vector<double> Distances; // means, by iteration
    bool IsAtRest = false;
  };

  Eigen::VectorXd Mobility;
  std::vector<Component> Components;
};

} // namespace FlipFree

#endif
