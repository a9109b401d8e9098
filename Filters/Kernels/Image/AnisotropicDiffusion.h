/**
 * Edge-preserving smoothing (paper section 3.2): the anisotropic diffusion of P. Perona and J.
 * Malik (Scale-space and edge detection using anisotropic diffusion, 1990) with physical spacing.
 * The conductance of the face between two voxels depends on the difference d across it, as
 * 1 / (1 + (d / Contrast)^2). The time step is the largest stable one.
 *
 * On a sheared grid (a tilted gantry's) the angles between the axes are ignored, so the smoothing
 * is sheared with the grid; it stays stable and keeps edges.
 *
 * Across the border of voxels without data (NoData.h), nothing flows, as across the image's; they
 * keep their values.
 *
 * The contrast is given, not measured on the image. The result at a voxel therefore depends only on
 * voxels within as many places as there are iterations, and a smoothed crop with that margin has
 * exactly the bits of the whole.
 *
 * The image is processed part by part, and all iterations of a part run slice behind slice while it
 * is in the cache: the image is read once and the result written once.
 */
#ifndef FlipFreeAnisotropicDiffusion_h
#define FlipFreeAnisotropicDiffusion_h

#include "Image/VoxelBox.h"
#include "KernelTypes.h"

#include <cmath>
#include <limits>
#include <type_traits>

namespace FlipFree
{

struct AnisotropicDiffusionSettings
{
  int Iterations = 5;

  /// Differences between neighboring voxels well above it are edges and are kept. Zero: all are.
  double Contrast = 20;

  /// Number of threads that the ParallelFor runs; 0: as many as the machine has. The monitor is
  /// asked after a few parts of the image per thread. Does not affect the result.
  int Threads = 0;
};

/// Copies the voxels (begin, j, k) to (end - 1, j, k) of an image, as floats. Called concurrently.
using VoxelReader = std::function<void(int begin, int end, int j, int k, float* to)>;

/// Reads the part of an image that begins at the voxel `first`; what has no data (NoData.h) is NaN.
/// The voxels must outlive the reader.
template <typename T>
VoxelReader ReaderOf(const ImageView<T>& image, const std::array<int, 3>& first = { { 0, 0, 0 } })
{
  return [image, first](int begin, int end, int j, int k, float* to)
  {
    const T* const from = &image(first[0] + begin, first[1] + j, first[2] + k);
    for (int i = 0; i < end - begin; ++i)
    {
      const auto value = static_cast<float>(from[i]);
      to[i] = std::is_integral_v<T> || std::isfinite(value)
        ? value
        : std::numeric_limits<float>::quiet_NaN();
    }
  };
}

/// Smooths an image into `out`, x fastest. Voxels are read a few times each and the image is not
/// copied. Returns false if the monitor stopped it; `out` is then undefined.
bool DiffuseAnisotropically(const VoxelReader& read, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, float* out);

/// Smooths only the voxels of a box, in their places in `out`, which is as large as the whole
/// image. At most DiffusionIterationsAtOnce iterations.
bool DiffuseBox(const VoxelReader& read, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const VoxelBox& box, const ParallelFor& parallelFor,
  const Monitor& monitor, float* out);

/// More iterations take several passes: the margins of the parts would cost too much.
constexpr int DiffusionIterationsAtOnce = 10;

/// The contrast that keeps edges above noise of the given standard deviation; zero without noise.
double ContrastOfNoise(double noiseStandardDeviation);

} // namespace FlipFree

#endif
