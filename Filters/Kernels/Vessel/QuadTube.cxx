#include "Vessel/QuadTube.h"

#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "MessageText.h"
#include "Vessel/CellSurface.h"
#include "Vessel/Polyline.h"
#include "Vessel/SectionFrames.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

void RequireLine(const PointList& line, const Eigen::VectorXd& radii, const std::string& name)
{
  if (line.rows() < 2)
  {
    throw Error(ErrorCode::InvalidLine, name + " has fewer than two points; give its course");
  }
  for (Eigen::Index point = 0; point < line.rows(); ++point)
  {
    if (!line.row(point).allFinite() || !(radii[point] > 0) || !std::isfinite(radii[point]))
    {
      throw Error(ErrorCode::InvalidLine,
        name + " has a point " + TextOf(line.row(point)) + " mm of radius " +
          std::to_string(radii[point]) + " mm; points must be finite and radii positive");
    }
    if (point > 0 && line.row(point) == line.row(point - 1))
    {
      throw Error(ErrorCode::RepeatedPoint,
        name + " has two points at " + TextOf(line.row(point)) +
          " mm in a row; remove one of them");
    }
  }
}

// A value at a length along the line, between its points.
double ValueAt(const Eigen::VectorXd& lengths, const Eigen::VectorXd& values, double length)
{
  const auto after =
    std::upper_bound(lengths.data() + 1, lengths.data() + lengths.size() - 1, length);
  const Eigen::Index next = after - lengths.data();
  const double part = (length - lengths[next - 1]) / (lengths[next] - lengths[next - 1]);
  return (1 - part) * values[next - 1] + part * values[next];
}

// From a square to a disk of radius 1: squares around the middle become circles, evenly divided.
Eigen::Vector2d OnDisk(const Eigen::Vector2d& place)
{
  const double radius = place.cwiseAbs().maxCoeff();
  if (radius == 0)
  {
    return { 0, 0 };
  }
  const bool isBeside = std::abs(place.x()) >= std::abs(place.y());
  const double major = isBeside ? place.x() : place.y();
  const double minor = isBeside ? place.y() : place.x();
  const double angle = 0.25 * EIGEN_PI * minor / std::abs(major);
  const Eigen::Vector2d across(std::copysign(radius * std::cos(angle), major),
    radius * std::sin(angle));
  return isBeside ? across : Eigen::Vector2d(across.y(), across.x());
}

// The surface of a box of cells, whose sides' centers have coordinates from 0 to n, n and m.
CellSurface SurfaceOfBox(int n, int m)
{
  ImageGeometry grid;
  grid.Dimensions = { { n, n, m } };
  grid.Origin.setConstant(0.5);
  BitMask cells(grid);
  cells.Complement();
  return MakeCellSurface(cells);
}

} // namespace

QuadTube MakeQuadTube(const PointList& line, const Eigen::VectorXd& radii, int n,
  const std::string& name, const ParallelFor& parallelFor)
{
  RequireLine(line, radii, name);
  const Eigen::VectorXd lengths = ArcLengths(line);
  const double length = lengths[lengths.size() - 1];
  const double edge = 2 * EIGEN_PI * radii.mean() / (4 * n);
  const int m = std::max(2, static_cast<int>(std::lround(length / edge)) + 1);
  const PointList even = ResampleLine(line, length / (m - 1));
  const std::vector<SectionFrame> frames = MakeSectionFrames(even);
  const CellSurface box = SurfaceOfBox(n, static_cast<int>(frames.size()));
  QuadTube tube;
  tube.Faces = box.Faces;
  tube.Points.resize(box.Points.rows(), 3);
  const auto last = static_cast<Eigen::Index>(frames.size()) - 1;
  for (Eigen::Index vertex = 0; vertex < box.Points.rows(); ++vertex)
  {
    const Eigen::Vector2d disk =
      OnDisk(2 * box.Points.row(vertex).head<2>().transpose() / n - Eigen::Vector2d::Ones());
    const auto section =
      std::min(last, static_cast<Eigen::Index>(std::floor(box.Points(vertex, 2))));
    const double radius =
      ValueAt(lengths, radii, length * static_cast<double>(section) / static_cast<double>(last));
    const SectionFrame& frame = frames[section];
    tube.Points.row(vertex) =
      frame.Origin + radius * (disk.x() * frame.First + disk.y() * frame.Second);
  }
  const auto pairs = FindSelfIntersections(tube.Points, tube.Faces, parallelFor);
  if (!pairs.empty())
  {
    throw Error(ErrorCode::SelfIntersecting,
      "a tube along " + name + " would intersect itself near " +
        TextOf(tube.Points.row(tube.Faces.Face(pairs.front().first)[0])) +
        " mm; smooth the line, or lower the radii, where it bends more tightly than its radius or "
        "comes near to itself");
  }
  return tube;
}

} // namespace FlipFree
