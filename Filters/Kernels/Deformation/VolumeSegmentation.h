/**
 * The whole method on a volume, as every front end runs it: the checks of the input, the noise, the
 * region that the surface can reach, the organ's surface, what may be wrong with it, and its
 * voxels.
 */
#ifndef FlipFreeVolumeSegmentation_h
#define FlipFreeVolumeSegmentation_h

#include "Deformation/OrganSegmentation.h"
#include "Deformation/StartSurface.h"
#include "Evidence/PartQuestions.h"
#include "Evidence/SurfaceConfidence.h"
#include "Image/BitMask.h"
#include "Image/SliceParts.h"
#include "Mesh/SurfaceVoxelization.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace FlipFree
{

/// A volume with voxels of any type, which somebody else owns.
struct GrayVolume
{
  ImageGeometry Geometry;
  VoxelReader Read;        ///< voxels that are not finite as floats are without data (NoData.h)
  bool IsComplete = false; ///< known to have data everywhere
};

template <typename T>
GrayVolume GrayVolumeOf(const ImageView<T>& image)
{
  return { image.Geometry, ReaderOf(image), !std::is_floating_point_v<T> };
}

struct VolumeSegmentationSettings
{
  OrganSegmentationSettings Method;

  /// Radius of the first sphere in seed radii, and its center relative to the seed's.
  double StartScale = 1;
  Eigen::Vector3d StartCenterOffset = Eigen::Vector3d::Zero();

  int LabelValue = 1;       ///< of the organ's voxels; read by those who make the label map
  bool KeepHistory = false; ///< whether those who can observe iterations are to keep the surfaces
};

struct VolumeSegmentation
{
  OrganSurface Organ;
  std::vector<VoxelRun> Voxels;        ///< inside; none where it was aborted
  SurfaceConfidence Confidence;        ///< empty where it was aborted
  std::vector<std::string> Warnings;   ///< a message each, with its remedy
  std::vector<DoubtfulPart> Questions; ///< that constraints have not answered; the first first
  /// Smoothing, feature, deformation with the exact count of self-intersections (which a group does
  /// not include), label map with confidence and warnings.
  std::array<double, 4> StageSeconds{ { 0, 0, 0, 0 } };
};

/// Segments an organ, again and again with other constraints; from the sphere that the settings
/// describe, or from a given surface. What constraints do not change is done once.
class VolumeSegmenter
{
public:
  /// `name` is the volume's, whose voxels outlive the object. `start` may be null. Throws Error for
  /// bad input, such as a seed that touches voxels without data, when it is segmented at the
  /// latest.
  VolumeSegmenter(GrayVolume volume, std::string name, const SeedSphere& seed,
    const DeformableSurface* start, const VolumeSegmentationSettings& settings,
    Threading threading);
  // Neither copied nor moved: what is kept between calls refers to this object's threading.
  VolumeSegmenter(const VolumeSegmenter&) = delete;
  VolumeSegmenter& operator=(const VolumeSegmenter&) = delete;

  /// Fills a mask, on exactly the volume's grid, in place of a foreground that is found in the
  /// image: the surface is that of the mask (LabelStart.h), and the start surface has no part in
  /// it. The seed lies in it (see LargestBallIn()); `name` names it in errors.
  void SetForeground(std::shared_ptr<const BitMask> mask, std::string name);

  /// Throws as the constructor does, also where a constraint cannot be obeyed, naming it; and
  /// std::logic_error if a guarded surface should intersect itself. A stop by the monitor gives the
  /// iterations so far and StopReason::Aborted, and nothing is kept.
  VolumeSegmentation Segment(const ConstraintList& constraints, const Monitor& monitor,
    const IterationObserver& observer);

  /// The voxels that would change sides by one more constraint than the last call's, in the
  /// foreground that the surface follows. Runs nothing. None where the constraint is beyond what is
  /// kept, or without carving. Throws as Segment() does.
  std::optional<std::vector<VoxelRun>> Preview(const ConstraintList& constraints,
    const PointConstraint& next, const Monitor& monitor);

  /// Frees the smoothed image and what else is kept between calls.
  void Release();

  // What Segment() consists of, for several organs together (OrganGroup.h).

  /// Checks the constraints, and smooths anew where their region is another.
  OrganSegmenter& Prepare(const ConstraintList& constraints);
  /// Its start surface, small enough to keep off the outside points.
  DeformableSurface StartWithin(const ConstraintList& constraints) const;
  /// Adds the confidence, warnings, questions and voxels of a surface that was not aborted.
  void Complete(const ConstraintList& constraints, VolumeSegmentation& result) const;

  /// The part of the volume that the surface can reach, once prepared.
  const VoxelBox& GetBox() const { return this->Box; }
  const ImageGeometry& GetGeometry() const { return this->Volume.Geometry; }
  double GetNoise() const { return this->Noise; }
  /// The seed; once prepared, without what reaches out of its tissue.
  const SeedSphere& GetCore() const { return this->Core; }

private:
  void RequireProper(const ConstraintList& constraints) const;
  VoxelBox RegionOf(const ConstraintList& constraints) const;
  void PrepareBox(const VoxelBox& box);
  void LookAtSeed();
  void StartAtCore();
  void RequireDataAtSeeds(const ConstraintList& constraints) const;

  const GrayVolume Volume;
  const std::string Name;
  const SeedSphere Seed;
  const VolumeSegmentationSettings Settings;
  const Threading Threads;
  SeedSphere Core; ///< the seed's, from which the organ is sought (UniformSphere)
  DeformableSurface Start;
  SeedSphere StartBall;
  bool IsSphere = true; ///< the start
  bool StartsAtSeed = false;

  std::shared_ptr<const BitMask> Given; ///< null where the foreground is to be found
  std::string GivenName;                ///< of the mask

  double Noise = 0;
  std::string MixedSeed; ///< a warning, if any
  VoxelBox Box;
  ImageGeometry Region;
  std::unique_ptr<SmoothRegion> Smooth;
  std::unique_ptr<OrganSegmenter> Organ;
};

} // namespace FlipFree

#endif
