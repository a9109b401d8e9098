/**
 * The smoothed image of the region that a surface can reach, computed on demand in a box that grows
 * with the organ, so that time and memory depend on the organ and not on the region. The box has
 * the bits that smoothing the whole region would give.
 */
#ifndef FlipFreeSmoothRegion_h
#define FlipFreeSmoothRegion_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/BitMask.h"

#include <functional>
#include <memory>

namespace FlipFree
{

/// Makes an image have values in a box. Returns false if a monitor stopped it.
using ImageMaker = std::function<bool(const VoxelBox& box)>;

struct SmoothingSettings
{
  /// How far from the seed's center the surface may get, in millimeters; only this box of the image
  /// is read. Zero: ten seed radii, at least 100 and at most 250 mm.
  double Reach = 0;

  int Iterations = 5; ///< of the diffusion
};

/// The reach in millimeters.
double ReachOf(const SmoothingSettings& settings, double seedRadius);

/// Throws Error where a reach is set that ends within the seed sphere.
void RequireReach(const SmoothingSettings& settings, double seedRadius);

/// The diffusion that keeps edges above noise of the given standard deviation.
AnisotropicDiffusionSettings DiffusionOf(const SmoothingSettings& settings,
  double noiseStandardDeviation);

class SmoothRegion
{
public:
  /// The voxels that `read` reads must outlive the region. Unless they are `complete`, as integers
  /// are, all are looked at once.
  SmoothRegion(VoxelReader read, const ImageGeometry& geometry,
    const AnisotropicDiffusionSettings& settings, ParallelFor parallelFor, bool complete = false);

  /// The whole region. Only the voxels of the box made so far have values; the others take no
  /// memory, since the operating system provides it on first use.
  ImageView<float> View() const { return { this->Voxels.get(), this->Geometry }; }

  /// Reads the voxels before smoothing, all of them.
  const VoxelReader& GetReader() const { return this->Read; }

  /// Where the region has no data; empty without such voxels.
  const BitMask& GetNoData() const { return this->NoData; }

  /// The box that has been made so far; empty at first.
  const VoxelBox& GetMade() const { return this->Made; }

  /// Extends the box to hold the one wanted as well; beyond DiffusionIterationsAtOnce iterations,
  /// to the whole region. Returns false if the monitor stopped it; the region is then useless.
  bool Make(const VoxelBox& wanted, const Monitor& monitor);

private:
  bool MakeAll(const Monitor& monitor);

  VoxelReader Read;
  ImageGeometry Geometry;
  AnisotropicDiffusionSettings Settings;
  ParallelFor Parallel;
  BitMask NoData;
  std::unique_ptr<float[]> Voxels;
  VoxelBox Made;
};

} // namespace FlipFree

#endif
