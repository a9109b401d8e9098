/**
 * Edge-preserving smoothing (paper section 3.2): the anisotropic diffusion of P. Perona and J.
 * Malik (Scale-space and edge detection using anisotropic diffusion, 1990) with physical spacing,
 * in three forms. Gray values flow between neighbors along the grid's axes: the diffusion is the
 * same in all directions where the axes are at right angles, whichever way they point. On a sheared
 * grid (a tilted gantry's) the angle between the axes is not taken into account, so that the
 * smoothing is sheared with the grid; it is as stable, and keeps edges all the same.
 *
 * What counts as an edge is given, not taken from the image, so that the result of a voxel depends
 * on the voxels within as many places as there are iterations, and on nothing else: a part of an
 * image, smoothed with that margin around it, has the very bits of the whole.
 *
 * All iterations are made on one part of the image after the other, slice behind slice, while it is
 * in the cache: the image is read once and the result written once, however many there are.
 */
#ifndef FlipFreeAnisotropicDiffusion_h
#define FlipFreeAnisotropicDiffusion_h

#include "Image/VoxelBox.h"
#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

enum class DiffusionEquation
{
  /// The conductance of a face falls off with the difference across it alone, as 1 / (1 + (d /
  /// Contrast)^2). Smooths most and costs least.
  Faces,

  /// It falls off with the gradient at the face, as exp(-(|g| / Contrast)^2 / 2): the equation and
  /// the numbers of ITK's GradientNDAnisotropicDiffusionFunction.
  Gradient,

  /// The same conductance drives level sets by their curvature (R. Whitaker and X. Xue,
  /// Variable-conductance, level-set curvature for image denoising, 2001): the equation and the
  /// numbers of ITK's CurvatureNDAnisotropicDiffusionFunction.
  Curvature
};

struct AnisotropicDiffusionSettings
{
  int Iterations = 5;

  /// Differences between neighboring voxels, in gray values, well above it are edges and are kept.
  /// Of Gradient and Curvature: gradients, in gray values per millimeter; of ITK's filters it is
  /// the conductance parameter times the average gradient magnitude.
  double Contrast = 20;

  DiffusionEquation Equation = DiffusionEquation::Faces;

  /// Of Gradient and Curvature, as ITK counts time: a step moves gray values along an axis by
  /// TimeStep / spacing of their second difference. Zero: the greatest that ITK calls stable, a
  /// sixteenth of the least spacing. The step of Faces is the greatest stable one.
  double TimeStep = 0;

  /// How many threads the ParallelFor has. So many parts of the image, each of some milliseconds,
  /// are done at least between two questions to the monitor, or threads would have nothing to do.
  /// Zero: as many as the machine has. Has no part in the result.
  int Threads = 0;
};

/// Copies the voxels (begin, j, k) to (end - 1, j, k) of an image, as floats. Called by several
/// threads at a time.
using VoxelReader = std::function<void(int begin, int end, int j, int k, float* to)>;

/// Reads a part of the image that begins at the voxel `first`. The voxels must outlive the reader.
template <typename T>
VoxelReader ReaderOf(const ImageView<T>& image, const std::array<int, 3>& first = { { 0, 0, 0 } })
{
  return [image, first](int begin, int end, int j, int k, float* to)
  {
    const T* const from = &image(first[0] + begin, first[1] + j, first[2] + k);
    for (int i = 0; i < end - begin; ++i)
    {
      to[i] = static_cast<float>(from[i]);
    }
  };
}

/// Smooths an image, which is read voxel by voxel a few times and nowhere copied, into `out`, x
/// fastest. Returns false if the monitor stopped it; what is in `out` is then worthless.
bool DiffuseAnisotropically(const VoxelReader& read, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, float* out);

/// Smooths only the voxels of a box, in their places in `out`, which is as large as the whole;
/// those around them, as many as there are iterations, are read. At most DiffusionIterationsAtOnce
/// iterations.
bool DiffuseBox(const VoxelReader& read, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const VoxelBox& box, const ParallelFor& parallelFor,
  const Monitor& monitor, float* out);

/// More of them are made in several passes, since they would compute too much around the parts, and
/// need too much memory.
constexpr int DiffusionIterationsAtOnce = 10;

/// The contrast that keeps edges above the image's noise, of the given standard deviation.
double ContrastOfNoise(double noiseStandardDeviation, const ImageGeometry& geometry,
  DiffusionEquation equation);

} // namespace FlipFree

#endif
