#include "Vessel/SectionSupport.h"

#include "Vessel/SectionRays.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

Eigen::VectorXd SectionSupport(const ImageView<float>& image, const VesselSections& sections,
  const ParallelFor& parallelFor)
{
  constexpr double contrast = 25; // gray values
  const SectionRays rays(image, sections.Frames, static_cast<int>(sections.Radii.cols()));
  Eigen::VectorXd support(sections.Radii.rows());
  parallelFor(0, support.size(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t section = first; section < last; ++section)
      {
        double sum = 0;
        for (int ray = 0; ray < sections.Radii.cols(); ++ray)
        {
          const double radius = sections.Radii(section, ray);
          const auto meanFrom = [&](double begin)
          {
            double mean = 0;
            for (const double beyond : { 0.0, 0.5, 1.0 })
            {
              mean += rays.Sample(section, ray, std::max(0.0, begin + beyond)) / 3;
            }
            return mean;
          };
          sum +=
            std::min(1.0, std::abs(meanFrom(radius + 0.75) - meanFrom(radius - 1.75)) / contrast);
        }
        support[section] = sum / static_cast<double>(sections.Radii.cols());
      }
    });
  return support;
}

} // namespace FlipFree
