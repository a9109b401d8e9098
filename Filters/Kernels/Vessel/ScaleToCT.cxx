#include "Vessel/ScaleToCT.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Most gray values of CT are within this range.
constexpr double SpanInCT = 250;

double Quantile(std::vector<float> values, double part)
{
  const auto place =
    values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// In which a thin vessel may be so few voxels that only its points tell of its contrast.
double SpanOf(const FloatImage& image, const PointList& points)
{
  constexpr double spanOverContrast = 2.5; // in CT, of vessels with contrast medium
  constexpr double ball = 1.5;             // mm
  const double median = Quantile(image.Voxels, 0.5);
  double contrast = 0;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    double sum = 0;
    const auto voxels = VoxelsInSphere(image.Geometry, { points.row(point).transpose(), ball });
    for (const std::size_t voxel : voxels)
    {
      sum += image.Voxels[voxel];
    }
    contrast = voxels.empty()
      ? contrast
      : std::max(contrast, std::abs(sum / static_cast<double>(voxels.size()) - median));
  }
  return std::max(Quantile(image.Voxels, 0.9) - Quantile(image.Voxels, 0.1),
    spanOverContrast * contrast);
}

} // namespace

void ScaleToCT(const PointList& points, FloatImage& image)
{
  const double span = SpanOf(image, points);
  const auto scale = static_cast<float>(span > 0 ? SpanInCT / span : 1);
  for (float& value : image.Voxels)
  {
    value *= scale;
  }
}

} // namespace FlipFree
