#include "Measures/SurfaceSamples.h"

#include "Error.h"

#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

// Along each edge of a triangle. A larger triangle is no better known by more of them, which take
// minutes: one vertex that is meters away makes such triangles.
constexpr double MaximumDivisions = 512;
constexpr double MaximumNumberOfSamples = 1e8;

} // namespace

SurfaceSamples::SurfaceSamples(const PointList& points, TriangleList triangles, double spacing,
  const std::string& name)
  : Points(points)
  , Triangles(std::move(triangles))
  , Offsets{ 0 }
{
  double area = 0;
  for (Eigen::Index triangle = 0; triangle < this->Triangles.rows(); ++triangle)
  {
    const Eigen::RowVector3d a = points.row(this->Triangles(triangle, 0));
    const Eigen::RowVector3d b = points.row(this->Triangles(triangle, 1));
    const Eigen::RowVector3d c = points.row(this->Triangles(triangle, 2));
    // The centroids of neighboring patches are two thirds of a patch's median apart.
    const double step = std::sqrt(std::max({ (b + c - 2 * a).squaredNorm(),
                          (c + a - 2 * b).squaredNorm(), (a + b - 2 * c).squaredNorm() })) /
      3;
    const double divisions = std::max(1.0, std::min(MaximumDivisions, std::ceil(step / spacing)));
    const double patches = divisions * divisions;
    if (static_cast<double>(this->Size()) + patches > MaximumNumberOfSamples)
    {
      throw Error(ErrorCode::TooLarge,
        name + " would need more than a hundred million samples; choose a greater sample spacing");
    }
    this->Divisions.push_back(static_cast<int>(divisions));
    this->Offsets.push_back(this->Size() + static_cast<std::size_t>(patches));
    this->PatchAreas.push_back((b - a).cross(c - a).norm() / 2 / patches);
    area += this->PatchAreas.back() * patches;
  }
  if (!std::isfinite(area))
  {
    throw Error(ErrorCode::TooLarge,
      name + " is too large to be measured; check that its coordinates are in millimeters");
  }
  if (!(area > 0))
  {
    throw Error(ErrorCode::InvalidMesh, name + " has no area: all its triangles are degenerate");
  }
}

Eigen::RowVector3d SurfaceSamples::PositionOf(std::size_t sample, Eigen::Index triangle) const
{
  const int n = this->Divisions[triangle];
  const auto index = static_cast<int>(sample - this->Offsets[triangle]);
  // Row i has 2 (n - i) - 1 patches, which leaves (n - i)^2 for it and those behind it.
  const int i = n - static_cast<int>(std::ceil(std::sqrt(n * n - index)));
  const int inRow = index - i * (2 * n - i);
  const int j = inRow / 2;
  const double inPatch = inRow % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
  const Eigen::RowVector3d a = this->Points.row(this->Triangles(triangle, 0));
  return a + (i + inPatch) / n * (this->Points.row(this->Triangles(triangle, 1)) - a) +
    (j + inPatch) / n * (this->Points.row(this->Triangles(triangle, 2)) - a);
}

std::size_t SurfaceSamples::SampleAt(Eigen::Index triangle, int corner) const
{
  // The first, the last, or the last one of the first row.
  const std::size_t n = this->Divisions[triangle];
  return this->Offsets[triangle] + (corner == 0 ? 0 : corner == 1 ? n * n - 1 : 2 * (n - 1));
}

double SurfaceSamples::DistanceToSampleAt(Eigen::Index triangle, int corner) const
{
  const auto point = [&](int which)
  { return this->Points.row(this->Triangles(triangle, (corner + which) % 3)); };
  return (point(1) + point(2) - 2 * point(0)).norm() / (3 * this->Divisions[triangle]);
}

} // namespace FlipFree
