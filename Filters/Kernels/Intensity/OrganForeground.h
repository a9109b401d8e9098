/**
 * The organ's foreground in an image that is smoothed only where the organ is: in a box that grows
 * until the foreground keeps away from its sides. The voxels are those that smoothing the whole
 * image would give.
 */
#ifndef FlipFreeOrganForeground_h
#define FlipFreeOrganForeground_h

#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

#include <utility>

namespace FlipFree
{

class OrganForeground
{
public:
  /// The arguments must outlive the object. `rim` is how far around the foreground, in millimeters,
  /// the smoothed image will be read. Without leak control, the foreground is not connected to the
  /// seed, so the whole region is smoothed.
  OrganForeground(SmoothRegion& region, const SeedSphere& seed,
    const OrganFeatureSettings& settings, double rim, const ParallelFor& parallelFor);
  OrganForeground(const OrganForeground&) = delete;
  OrganForeground& operator=(const OrganForeground&) = delete;

  // Each of these returns false if the monitor stopped it.

  /// Smooths the seed's surroundings.
  bool SmoothAroundSeed(const Monitor& monitor);
  /// Smooths a box of the image.
  bool Smooth(const VoxelBox& box, const Monitor& monitor);
  /// Smooths all within `reach` millimeters of the points.
  bool SmoothAround(const PointList& points, double reach, const Monitor& monitor);
  /// Finds the foreground, smoothing more wherever it comes near the sides of the box.
  bool Update(const IntensityModel& model, const Monitor& monitor);

  void SetMask(BitMask mask);
  /// Leaves none.
  BitMask TakeMask() { return std::exchange(this->Mask, BitMask()); }

  /// Of the image, where the settings leave it open; not Automatic.
  FlipFree::Modality GetModality() const;

  /// Frees the mask's memory.
  void Clear() { this->Mask = BitMask(); }

  const BitMask& GetMask() const { return this->Mask; }
  /// Reads the voxels before smoothing.
  const VoxelReader& GetReader() const { return this->Region.GetReader(); }
  const BitMask& GetNoData() const { return this->Region.GetNoData(); }
  /// Has values in the box that has been smoothed.
  ImageView<float> GetImage() const { return this->Region.View(); }
  double GetSmoothingSeconds() const { return this->SmoothingSeconds; }

private:
  VoxelBox BoundsOfBalls(const PointList& points, double reach,
    const std::array<int, 3>& margin) const;
  VoxelBox FirstSearched() const;
  VoxelBox Grown(const VoxelBox& searched) const;

  SmoothRegion& Region;
  const ImageGeometry Geometry;
  const VoxelBox Whole;
  const SeedSphere& Seed;
  const OrganFeatureSettings& Settings;
  const ParallelFor& Parallel;

  const LeakControlRadii Leaks;
  std::array<int, 3> Margin; ///< voxels between the foreground and the sides of the box
  BitMask Mask;
  VoxelBox Bounds; ///< of the foreground; empty before the first update
  double SmoothingSeconds = 0;
};

} // namespace FlipFree

#endif
