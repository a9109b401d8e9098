#include "Vessel/ScaleToCT.h"

#include "Image/NoData.h"
#include "Quantile.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace FlipFree
{
namespace
{

// Most gray values of CT are within this range.
constexpr double SpanInCT = 250;

// In which a thin vessel may be so few voxels that only its points tell of its contrast.
double SpanOf(const FloatImage& image, const PointList& points)
{
  constexpr double spanOverContrast = 2.5; // in CT, of vessels with contrast medium
  constexpr double ball = 1.5;             // mm
  std::vector<float> values;
  std::copy_if(image.Voxels.begin(), image.Voxels.end(), std::back_inserter(values), HasData);
  const double median = TakeQuantile(values, 0.5);
  double contrast = 0;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    double sum = 0;
    int count = 0;
    for (const std::size_t voxel :
      VoxelsInSphere(image.Geometry, { points.row(point).transpose(), ball }))
    {
      if (HasData(image.Voxels[voxel]))
      {
        sum += image.Voxels[voxel];
        ++count;
      }
    }
    contrast = count == 0 ? contrast : std::max(contrast, std::abs(sum / count - median));
  }
  const double brightest = TakeQuantile(values, 0.9);
  return std::max(brightest - TakeQuantile(values, 0.1), spanOverContrast * contrast);
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
