#include "Vessel/SectionSupport.h"

#include "Image/ImageInterpolation.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

Eigen::VectorXd SectionSupport(const ImageView<float>& image, const VesselSections& sections,
  const ParallelFor& parallelFor)
{
  constexpr double contrast = 25; // gray values
  const auto rays = sections.Radii.cols();
  Eigen::VectorXd support(sections.Radii.rows());
  parallelFor(0, support.size(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t section = first; section < last; ++section)
      {
        const SectionFrame& frame = sections.Frames[section];
        double sum = 0;
        for (Eigen::Index ray = 0; ray < rays; ++ray)
        {
          const double radius = sections.Radii(section, ray);
          const Eigen::Vector3d direction =
            frame.Ray(2 * EIGEN_PI * static_cast<double>(ray) / static_cast<double>(rays));
          const auto meanFrom = [&](double begin)
          {
            double mean = 0;
            for (const double beyond : { 0.0, 0.5, 1.0 })
            {
              mean += InterpolateClamped(image,
                        image.Geometry.ToIndex(
                          frame.Origin + std::max(0.0, begin + beyond) * direction)) /
                3;
            }
            return mean;
          };
          sum +=
            std::min(1.0, std::abs(meanFrom(radius + 0.75) - meanFrom(radius - 1.75)) / contrast);
        }
        support[section] = sum / static_cast<double>(rays);
      }
    });
  return support;
}

Eigen::VectorXd SupportAlong(const Eigen::VectorXd& support, double sectionStep, double length)
{
  const auto reach = static_cast<Eigen::Index>(std::lround(length / 2 / sectionStep));
  Eigen::VectorXd along(support.size());
  for (Eigen::Index section = 0; section < support.size(); ++section)
  {
    const Eigen::Index first = std::max<Eigen::Index>(0, section - reach);
    const Eigen::Index last = std::min<Eigen::Index>(support.size() - 1, section + reach);
    along[section] = support.segment(first, last - first + 1).mean();
  }
  return along;
}

} // namespace FlipFree
