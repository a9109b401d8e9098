#include "Vessel/Polyline.h"

#include "Quantile.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

constexpr double Truncation = 3; // of Gaussians, in standard deviations

double Weight(Eigen::Index offset, double deviation)
{
  const double x = static_cast<double>(offset) / deviation;
  return std::exp(-0.5 * x * x);
}

} // namespace

Eigen::VectorXd ArcLengths(const PointList& line)
{
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(line.rows());
  for (Eigen::Index point = 1; point < line.rows(); ++point)
  {
    lengths[point] = lengths[point - 1] + (line.row(point) - line.row(point - 1)).norm();
  }
  return lengths;
}

PointList ResampleLine(const PointList& line, double step)
{
  const Eigen::VectorXd lengths = ArcLengths(line);
  const double whole = lengths[lengths.size() - 1];
  const auto pieces = std::max<Eigen::Index>(1, std::lround(whole / step));
  PointList points(pieces + 1, 3);
  Eigen::Index segment = 0;
  for (Eigen::Index piece = 0; piece <= pieces; ++piece)
  {
    const double place = whole * static_cast<double>(piece) / static_cast<double>(pieces);
    while (segment + 2 < line.rows() && lengths[segment + 1] < place)
    {
      ++segment;
    }
    const double length = lengths[segment + 1] - lengths[segment];
    const double part =
      length > 0 ? std::min(1.0, std::max(0.0, (place - lengths[segment]) / length)) : 0;
    points.row(piece) = line.row(segment) + part * (line.row(segment + 1) - line.row(segment));
  }
  points.row(0) = line.row(0);
  points.row(pieces) = line.row(line.rows() - 1);
  return points;
}

PointList SmoothLine(const PointList& line, double deviation)
{
  PointList smooth = line;
  const Eigen::Index last = line.rows() - 1;
  for (Eigen::Index point = 1; point < last; ++point)
  {
    // Symmetric, so that ends do not draw the line together.
    const Eigen::Index reach = std::min(
      { point, last - point, static_cast<Eigen::Index>(std::ceil(Truncation * deviation)) });
    const double width = std::min(deviation, static_cast<double>(reach) / 2 + 0.25);
    Eigen::RowVector3d sum = line.row(point);
    double weights = 1;
    for (Eigen::Index offset = 1; offset <= reach; ++offset)
    {
      const double weight = Weight(offset, width);
      sum += weight * (line.row(point - offset) + line.row(point + offset));
      weights += 2 * weight;
    }
    smooth.row(point) = sum / weights;
  }
  return smooth;
}

Eigen::VectorXd SmoothAlong(const Eigen::VectorXd& values, double deviation)
{
  const auto reach = static_cast<Eigen::Index>(std::ceil(Truncation * deviation));
  Eigen::VectorXd smooth(values.size());
  for (Eigen::Index place = 0; place < values.size(); ++place)
  {
    const Eigen::Index first = std::max<Eigen::Index>(0, place - reach);
    const Eigen::Index last = std::min(values.size() - 1, place + reach);
    double sum = 0;
    double weights = 0;
    for (Eigen::Index other = first; other <= last; ++other)
    {
      const double weight = Weight(other - place, deviation);
      sum += weight * values[other];
      weights += weight;
    }
    smooth[place] = sum / weights;
  }
  return smooth;
}

Eigen::VectorXd MeanAlong(const Eigen::VectorXd& values, double step, double length)
{
  const auto reach = static_cast<Eigen::Index>(std::lround(length / 2 / step));
  Eigen::VectorXd along(values.size());
  for (Eigen::Index place = 0; place < values.size(); ++place)
  {
    const Eigen::Index first = std::max<Eigen::Index>(0, place - reach);
    const Eigen::Index last = std::min<Eigen::Index>(values.size() - 1, place + reach);
    along[place] = values.segment(first, last - first + 1).mean();
  }
  return along;
}

Eigen::VectorXd MedianAlong(const Eigen::VectorXd& values, int reach)
{
  Eigen::VectorXd medians(values.size());
  std::vector<double> window;
  for (Eigen::Index place = 0; place < values.size(); ++place)
  {
    const Eigen::Index first = std::max<Eigen::Index>(0, place - reach);
    const Eigen::Index last = std::min(values.size() - 1, place + reach);
    window.assign(values.data() + first, values.data() + last + 1);
    medians[place] = TakeMedian(window);
  }
  return medians;
}

} // namespace FlipFree
