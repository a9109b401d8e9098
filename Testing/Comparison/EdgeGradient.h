/**
 * The magnitude of an image's gradient, by ITK's recursive Gaussians, and what they need of the
 * image.
 */
#ifndef FlipFreeEdgeGradient_h
#define FlipFreeEdgeGradient_h

#include "Error.h"
#include "ItkRegion.h"
#include "SeedStatistics.h"

#include "vtkSMPTools.h"

#include "itkGradientMagnitudeRecursiveGaussianImageFilter.h"

#include <algorithm>
#include <string>
#include <vector>

namespace FlipFree
{

/// Throws Error if the region within reach has fewer than four voxels along one of its first `axes`
/// axes.
inline void RequireGaussianWidth(const ImageGeometry& region, int axes)
{
  constexpr int minimum = 4;
  for (int axis = 0; axis < axes; ++axis)
  {
    if (region.Dimensions[axis] < minimum)
    {
      throw Error(ErrorCode::OutOfRange,
        "only " + std::to_string(region.Dimensions[axis]) +
          " voxels of the image{ on port 0} can be reached along axis " + std::to_string(axis) +
          ", and gradients need four; give it a larger image, raise {Reach}, or choose another "
          "method");
    }
  }
}

/// Turns each voxel into mapped(squared), the squared ratio of the gradient's magnitude at the
/// scale `sigma` and `contrast` times its mean over the seed's voxels. Null if the monitor stopped
/// it.
template <typename TImage, typename Map>
typename TImage::Pointer MapGradient(const typename TImage::Pointer& image, double sigma,
  double contrast, const std::vector<std::size_t>& seedVoxels, const Monitor& monitor,
  const Map& mapped)
{
  using Filter = itk::GradientMagnitudeRecursiveGaussianImageFilter<TImage, TImage>;
  auto gradient = Filter::New();
  gradient->SetInput(image);
  gradient->SetSigma(sigma);
  gradient->SetNumberOfWorkUnits(
    static_cast<itk::ThreadIdType>(vtkSMPTools::GetEstimatedNumberOfThreads()));
  if (!UpdateMonitored<Filter>(gradient, ReportedProgress<Filter>, monitor))
  {
    return nullptr;
  }
  typename TImage::Pointer result = gradient->GetOutput();
  result->DisconnectPipeline();
  float* const begin = result->GetBufferPointer();
  const double scale = std::max(contrast * StatisticsOf(begin, seedVoxels).Mean, 1e-30);
  std::transform(begin, begin + result->GetBufferedRegion().GetNumberOfPixels(), begin,
    [&](float value)
    {
      const double squared = (value / scale) * (value / scale);
      return static_cast<float>(mapped(squared));
    });
  return result;
}

} // namespace FlipFree

#endif
