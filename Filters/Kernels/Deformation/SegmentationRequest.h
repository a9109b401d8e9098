/**
 * What users ask for, in one place for all front ends: an organ, again and again with other points,
 * or several organs together. A front end converts its own types to these and back; what is given
 * is checked here. Messages call images, label maps and surfaces by the names that come with them.
 */
#ifndef FlipFreeSegmentationRequest_h
#define FlipFreeSegmentationRequest_h

#include "Deformation/StartSurface.h"
#include "Deformation/VolumeSegmentation.h"
#include "Image/LabelValues.h"
#include "Image/PointConstraint.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace FlipFree
{

/// Of one organ.
struct OrganRequest
{
  std::optional<SeedSphere> Seed; ///< none to fill the label (OrganSession::FillLabel())
  ConstraintList Constraints;     ///< a further seed that is larger takes the place of the seed
  VolumeSegmentationSettings Settings;
};

struct OrganAnswer
{
  VolumeSegmentation Result;
  SeedSphere Seed;        ///< the largest; of a label the largest ball in it
  std::string Provenance; ///< Provenance.h
};

/// Segments an organ of a volume, again and again. What constraints do not change is kept from run
/// to run while seed and settings stay the same. The result does not depend on what is kept.
class OrganSession
{
public:
  /// The volume's voxels outlive the object; `name` is the volume's.
  OrganSession(GrayVolume volume, std::string name, Threading threading);
  // Neither copied nor moved, as the VolumeSegmenter that it keeps.
  OrganSession(const OrganSession&) = delete;
  OrganSession& operator=(const OrganSession&) = delete;

  /// Starts from a surface in place of a sphere.
  void StartFrom(GivenSurface surface);

  /// Takes the label that runs without a seed fill in place of a foreground that is found in the
  /// volume; 0 stands for all nonzero voxels. Returns the largest ball in it, in which they start.
  /// Throws Error as StartMaskOf() does; then there is none.
  SeedSphere FillLabel(const LabelVolume& labels, int label);

  /// Throws Error for a volume, seed, surface or parameter that cannot be used, and whatever
  /// VolumeSegmenter::Segment() throws. The observer, which may be null, sees the iterations if
  /// their history is to be kept. Nothing is kept of a run that was aborted.
  OrganAnswer Segment(const OrganRequest& request, const Monitor& monitor,
    const IterationObserver& observer);

  /// The voxels that would change sides by one more inside or outside point than the last run's;
  /// the surface follows them as far as it can. No surface is deformed. None before the first run,
  /// without carving, and for points beyond the region of the last run.
  /// Throws as Segment() does for a point that cannot be used.
  std::optional<std::vector<VoxelRun>> Preview(const PointConstraint& point,
    const Monitor& monitor);

  const ImageGeometry& GetGeometry() const { return this->Volume.Geometry; }

  /// Frees what is kept between runs.
  void Release();

private:
  struct FilledLabel
  {
    std::string Name; // of the label map
    int Label;
    std::shared_ptr<const BitMask> Mask; // on the volume's grid
    double Outside;                      // which fraction of the label lies outside the volume
    SeedSphere Ball;
  };
  VolumeSegmenter& Prepare(const SeedSphere& seed, bool fills,
    const VolumeSegmentationSettings& settings);

  const GrayVolume Volume;
  const std::string Name;
  const Threading Threads;
  std::optional<GivenSurface> Start;
  std::optional<FilledLabel> Filled;
  std::optional<VolumeSegmenter> Kept;
  ConstraintList Constraints; ///< of the last run
  std::vector<double> MadeOf; ///< the seed, whether a label is filled, and all parameters
};

/// An organ among several: its seeds and points.
struct NamedOrgan
{
  std::string Name;
  ConstraintList Constraints;
};

/// Of several organs together.
struct GroupRequest
{
  std::vector<NamedOrgan> Organs;      ///< each with a seed; the largest is where it starts
  std::vector<GivenSurface> Fixed;     ///< what they must not meet
  VolumeSegmentationSettings Settings; ///< LabelValue is that of the first organ
};

struct GroupAnswer
{
  std::vector<VolumeSegmentation> Results; ///< in the order of the organs
  std::string Provenance;                  ///< of all surfaces
};

/// `name` is the volume's. Throws Error as OrganSession::Segment() and OrganGroup do, also where an
/// organ has no seed, or where labels do not suffice.
GroupAnswer SegmentGroup(const GrayVolume& volume, const std::string& name,
  const GroupRequest& request, const Threading& threading, const Monitor& monitor);

} // namespace FlipFree

#endif
