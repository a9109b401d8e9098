#include "PathEnds.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// The points x with Normal . x <= Offset.
struct HalfSpace
{
  Eigen::Vector3d Normal;
  double Offset;
};

// What is beyond an end is convex: the far side of a plane, and nearer to the end than to any other
// point, which is another half-space for each of them.
using Polyhedron = std::vector<HalfSpace>;

Polyhedron BeyondEnd(const PathLines& path, const Eigen::Vector3d& end,
  const Eigen::Vector3d& outward)
{
  Polyhedron beyond{ { -outward, -outward.dot(end) } };
  for (const PointList& line : path)
  {
    for (Eigen::Index place = 0; place < line.rows(); ++place)
    {
      const Eigen::Vector3d point = line.row(place);
      beyond.push_back({ 2 * (point - end), point.squaredNorm() - end.squaredNorm() });
    }
  }
  return beyond;
}

// Of the places start + t step, those in the polyhedron: first to last, none if first > last.
struct Interval
{
  double First;
  double Last;
};

Interval Clip(const Polyhedron& polyhedron, const Eigen::Vector3d& start,
  const Eigen::Vector3d& step, Interval within)
{
  for (const HalfSpace& half : polyhedron)
  {
    const double slope = half.Normal.dot(step);
    const double rest = half.Offset - half.Normal.dot(start);
    if (slope > 0)
    {
      within.Last = std::min(within.Last, rest / slope);
    }
    else if (slope < 0)
    {
      within.First = std::max(within.First, rest / slope);
    }
    else if (rest < 0)
    {
      within.Last = within.First - 1;
    }
    if (within.First > within.Last)
    {
      break;
    }
  }
  return within;
}

std::vector<Polyhedron> BeyondEnds(const PathLines& path)
{
  std::vector<Polyhedron> ends;
  const PointList& trunk = path.front();
  ends.push_back(BeyondEnd(path, trunk.row(0), trunk.row(0) - trunk.row(1)));
  for (const PointList& line : path)
  {
    const Eigen::Index last = line.rows() - 1;
    ends.push_back(BeyondEnd(path, line.row(last), line.row(last) - line.row(last - 1)));
  }
  return ends;
}

} // namespace

BitMask VoxelsBeyondEnds(const PathLines& path, const ImageGeometry& geometry,
  const ParallelFor& parallelFor)
{
  const std::vector<Polyhedron> ends = BeyondEnds(path);
  const Eigen::Vector3d step =
    geometry.ToPhysical(Eigen::Vector3d::UnitX()) - geometry.ToPhysical(Eigen::Vector3d::Zero());
  const Interval row{ 0, static_cast<double>(geometry.Dimensions[0] - 1) };
  BitMask beyond(geometry);
  parallelFor(0, geometry.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < geometry.Dimensions[1]; ++j)
        {
          const Eigen::Vector3d start = geometry.ToPhysical(Eigen::Vector3d(0, j, k));
          for (const Polyhedron& end : ends)
          {
            const Interval run = Clip(end, start, step, row);
            const auto begin = static_cast<int>(std::ceil(run.First));
            const auto behind = static_cast<int>(std::floor(run.Last)) + 1;
            if (begin < behind)
            {
              beyond.InsertRun(begin, behind, j, k);
            }
          }
        }
      }
    });
  return beyond;
}

} // namespace FlipFree
