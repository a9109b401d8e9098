/**
 * Edge-preserving smoothing (paper section 3.2): the anisotropic diffusion of P. Perona and J.
 * Malik (Scale-space and edge detection using anisotropic diffusion, 1990) with physical spacing.
 * Grey values flow between neighbours along the grid's axes: the diffusion is the same in all
 * directions where the axes are at right angles, whichever way they point. On a sheared grid (a
 * tilted gantry's) the angle between the axes is not taken into account, so that the smoothing is
 * sheared with the grid; it is as stable, and keeps edges all the same.
 */
#ifndef FlipFreeAnisotropicDiffusion_h
#define FlipFreeAnisotropicDiffusion_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

struct AnisotropicDiffusionSettings
{
  int Iterations = 5;

  /// Differences between neighbouring voxels, in grey values, well above it are edges and are kept.
  double Contrast = 20;
};

/// Smooths `voxels` in place. The time step is the greatest stable one for the spacing. Returns
/// false if the monitor stopped it.
bool DiffuseAnisotropically(std::vector<float>& voxels, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor);

/// The contrast that keeps edges above the image's noise, of the given standard deviation.
double ContrastOfNoise(double noiseDeviation);

} // namespace FlipFree

#endif
