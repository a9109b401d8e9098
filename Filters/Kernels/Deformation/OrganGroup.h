/**
 * Several organs of a volume, segmented together: each is background for the others, and their
 * surfaces, grown under one guard, never meet.
 *
 * Each organ first finds its foreground by itself. Then the voxels that several claim are divided
 * (OrganDivision.h), and all surfaces start again from their seeds and deform jointly
 * (DeformationLoop.h). None passes through another, so a surface that starts outside another does
 * not end inside it, and a voxel lies in at most one. Seeds and inside points of an organ are
 * outside points of all others. The result does not depend on the order of the organs. The surfaces
 * are refined together: where one of them cannot be refined without meeting itself or another, all
 * stay coarse (StopReason::NotRefined).
 */
#ifndef FlipFreeOrganGroup_h
#define FlipFreeOrganGroup_h

#include "Deformation/OrganConflicts.h"
#include "Deformation/VolumeSegmentation.h"
#include "Image/BitMask.h"

#include <memory>
#include <string>
#include <vector>

namespace FlipFree
{

struct SeededOrgan
{
  std::string Name; ///< of its own
  SeedSphere Seed;
};

/// Sees the iterations of the organ with that index.
using GroupObserver = std::function<void(std::size_t organ, const ContourMesh&, const PointList&,
  const CorrespondenceField&, const IterationRecord&)>;

/// Segments the organs again and again with other constraints. What these do not change is done
/// once.
class OrganGroup
{
public:
  /// The volume's voxels outlive the object; `name` is the volume's. Guard and Carving are on, and
  /// the fixed surfaces embedded (MakeStartSurface). Throws Error, naming organs, for bad input:
  /// none, two of one name, seeds of two organs that overlap, a seed that meets a fixed surface.
  OrganGroup(const GrayVolume& volume, const std::string& name, std::vector<SeededOrgan> organs,
    std::vector<FixedSurface> fixed, const VolumeSegmentationSettings& settings,
    const Threading& threading);
  ~OrganGroup();
  OrganGroup(const OrganGroup&) = delete;
  OrganGroup& operator=(const OrganGroup&) = delete;

  /// One list of constraints and one result per organ, in the order of the organs. Throws as the
  /// constructor does, also for a point of one organ in a seed of another or in a fixed surface,
  /// and where a constraint cannot be obeyed; std::logic_error if surfaces should meet all the
  /// same. A stop by the monitor gives results that are aborted, and nothing is kept.
  std::vector<VolumeSegmentation> Segment(const std::vector<ConstraintList>& constraints,
    const Monitor& monitor, const GroupObserver& observer);

private:
  struct Member;
  void RequirePointsApart(const std::vector<ConstraintList>& constraints) const;
  void TakeConstraints(const std::vector<ConstraintList>& constraints);
  void FindPointsOfOthers(Member& member) const;
  BitMask FixedVoxels(const ImageGeometry& region) const;
  bool Divide(const Monitor& monitor);
  bool FindForegrounds(const Monitor& monitor, const GroupObserver& observer);
  bool Deform(const Monitor& monitor, const GroupObserver& observer);
  bool Run(const Monitor& monitor, const GroupObserver& observer);
  VolumeSegmentation Finish(Member& member) const;
  void DropSettledQuestions(std::vector<VolumeSegmentation>& results) const;
  void RequireDisjoint(const std::vector<VolumeSegmentation>& results) const;

  const ImageGeometry Geometry;
  const std::string Name;
  const std::vector<FixedSurface> Fixed;
  const Threading Threads;
  std::vector<std::unique_ptr<Member>> Members; ///< in the order of their seeds
};

} // namespace FlipFree

#endif
