#include "GradientVectorFlow.h"

#include "ItkRegion.h"

#include "itkCovariantVector.h"
#include "itkGradientVectorFlowImageFilter.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

using FlowImage = itk::Image<itk::CovariantVector<float, 2>, 2>;

/// ITK's filter with another time step: its own, a quarter of the inverse smoothness, is just
/// stable where there are no edges, and diverges where there are. This one also reports its
/// progress and can be stopped.
class FlowFilter : public itk::GradientVectorFlowImageFilter<FlowImage, FlowImage>
{
public:
  using Self = FlowFilter;
  using Superclass = itk::GradientVectorFlowImageFilter<FlowImage, FlowImage>;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

protected:
  FlowFilter() = default;
  ~FlowFilter() override = default;

  void GenerateData() override
  {
    this->AllocateOutputs();
    this->InitInterImage();
    for (int i = 0; i < this->GetIterationNum() && !this->GetAbortGenerateData(); ++i)
    {
      this->UpdatePixels();
      this->UpdateInterImage();
      this->UpdateProgress(static_cast<float>(i) / static_cast<float>(this->GetIterationNum()));
    }
  }
};

/// Central differences, per pixel.
FlowImage::Pointer GradientOf(const PlaneImage::Pointer& edges)
{
  auto gradient = FlowImage::New();
  gradient->SetRegions(edges->GetBufferedRegion());
  gradient->Allocate();
  const auto width = static_cast<std::ptrdiff_t>(edges->GetBufferedRegion().GetSize()[0]);
  const auto height = static_cast<std::ptrdiff_t>(edges->GetBufferedRegion().GetSize()[1]);
  const float* const value = edges->GetBufferPointer();
  auto* vector = gradient->GetBufferPointer();
  for (std::ptrdiff_t y = 0; y < height; ++y)
  {
    for (std::ptrdiff_t x = 0; x < width; ++x, ++vector)
    {
      const auto at = [&](std::ptrdiff_t i, std::ptrdiff_t j)
      {
        return value[std::max<std::ptrdiff_t>(0, std::min(i, width - 1)) +
          width * std::max<std::ptrdiff_t>(0, std::min(j, height - 1))];
      };
      (*vector)[0] = (at(x + 1, y) - at(x - 1, y)) / 2;
      (*vector)[1] = (at(x, y + 1) - at(x, y - 1)) / 2;
    }
  }
  return gradient;
}

/// Half of the largest time step at which no mode of the explicit scheme grows.
double StableTimeStep(const FlowImage& gradient, double smoothness)
{
  const auto* begin = gradient.GetBufferPointer();
  double greatest = 0;
  std::for_each(begin, begin + gradient.GetBufferedRegion().GetNumberOfPixels(),
    [&greatest](const auto& vector)
    { greatest = std::max(greatest, static_cast<double>(vector.GetSquaredNorm())); });
  return 1 / (greatest + 8 * smoothness);
}

} // namespace

bool FindVectorFlow(const PlaneImage::Pointer& edges, double smoothness, int iterations,
  const Monitor& monitor, PlaneField& field)
{
  const FlowImage::Pointer gradient = GradientOf(edges);
  auto flow = FlowFilter::New();
  flow->SetInput(gradient);
  flow->SetNoiseLevel(smoothness);
  flow->SetTimeStep(StableTimeStep(*gradient, smoothness));
  flow->SetIterationNum(iterations);
  if (!UpdateMonitored<FlowFilter>(flow, ReportedProgress<FlowFilter>, monitor))
  {
    return false;
  }
  const auto* force = flow->GetOutput()->GetBufferPointer();
  for (Eigen::Vector2d& vector : field.Forces)
  {
    vector = Eigen::Vector2d((*force)[0], (*force)[1]).stableNormalized();
    ++force;
  }
  return true;
}

} // namespace FlipFree
