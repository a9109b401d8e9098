/**
 * Private to the module: ITK's anisotropic diffusion filters, which look up only once per
 * iteration, made to report progress and to stop within an iteration.
 */
#ifndef FlipFreeItkDiffusion_h
#define FlipFreeItkDiffusion_h

#include "KernelTypes.h"

class vtkImageData;

namespace FlipFree
{

struct ItkDiffusionSettings
{
  bool Curvature = true; ///< or else Perona and Malik's gradient equation
  int Iterations = 5;
  double TimeStep = 0.0625;
  double Conductance = 1;
  double GradientScale = 1; ///< intensities per millimeter
};

/// Smooths an image of floats in place. Returns false if the monitor stopped it; the image is then
/// worthless.
bool DiffuseByItk(vtkImageData* image, const ItkDiffusionSettings& settings,
  const Monitor& monitor);

} // namespace FlipFree

#endif
