/**
 * The smoothed image of the region that a surface can reach, made where it is asked for: a box that
 * grows with the organ, so that time and memory follow the organ and not the region. What is made
 * has the bits that smoothing all of it would give.
 */
#ifndef FlipFreeSmoothRegion_h
#define FlipFreeSmoothRegion_h

#include "Image/AnisotropicDiffusion.h"

#include <memory>

namespace FlipFree
{

struct SmoothingSettings
{
  /// How far from the seed's center the surface may get, in millimeters; only this box of the image
  /// is read. Zero: ten seed radii, at least 100 and at most 250.
  double Reach = 0;

  int Iterations = 5; ///< of the diffusion
};

/// The reach in millimeters.
double ReachOf(const SmoothingSettings& settings, double seedRadius);

/// The diffusion that keeps edges above the noise, of the given standard deviation, in that part of
/// the image.
AnisotropicDiffusionSettings DiffusionOf(const SmoothingSettings& settings,
  double noiseStandardDeviation, const ImageGeometry& geometry);

class SmoothRegion
{
public:
  /// The voxels that `read` reads must outlive the region.
  SmoothRegion(VoxelReader read, const ImageGeometry& geometry,
    const AnisotropicDiffusionSettings& settings, ParallelFor parallelFor);

  /// The whole region, whose voxels have a value only in the box that has been made. The operating
  /// system gives the others no memory.
  ImageView<float> View() const { return { this->Voxels.get(), this->Geometry }; }

  /// The box that has been made so far; empty at first.
  const VoxelBox& GetMade() const { return this->Made; }

  /// Makes the least box that holds the one wanted and all that has been made before. Beyond
  /// DiffusionIterationsAtOnce iterations, all of the region. Returns false if the monitor stopped
  /// it; the region is then worthless.
  bool Make(const VoxelBox& wanted, const Monitor& monitor);

private:
  bool MakeAll(const Monitor& monitor);

  VoxelReader Read;
  ImageGeometry Geometry;
  AnisotropicDiffusionSettings Settings;
  ParallelFor Parallel;
  std::unique_ptr<float[]> Voxels;
  VoxelBox Made;
};

} // namespace FlipFree

#endif
