/**
 * Motions that no step of a segmentation should have, but one may: noise, folds, collapses,
 * crossings, spikes, inversions. And the count of what must not come of them.
 */
#ifndef FlipFreeAdverseMotions_h
#define FlipFreeAdverseMotions_h

#include "RandomMotions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace FlipFree
{

/// Corners of the faces, and triangles, whose normal turned by 90 degrees or more.
inline int CountFlippedCorners(const ContourMesh& mesh, const PointList& before,
  const PointList& after)
{
  const auto normal = [](const PointList& points, int a, int v, int b) -> Eigen::RowVector3d
  {
    return Eigen::RowVector3d(points.row(b) - points.row(v))
      .cross(Eigen::RowVector3d(points.row(a) - points.row(v)));
  };
  int count = 0;
  const auto check = [&](int a, int v, int b)
  { count += normal(before, a, v, b).dot(normal(after, a, v, b)) > 0 ? 0 : 1; };
  for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
  {
    const int* vertices = mesh.Faces.Face(face);
    const int size = mesh.Faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      check(vertices[(corner + size - 1) % size], vertices[corner], vertices[(corner + 1) % size]);
    }
  }
  for (Eigen::Index row = 0; row < mesh.Triangles.rows(); ++row)
  {
    check(mesh.Triangles(row, 0), mesh.Triangles(row, 1), mesh.Triangles(row, 2));
  }
  return count;
}

/// The kinds of them.
constexpr const char* AdverseMotionNames[] = { "white noise, 0.1 to 5 edges",
  "inversion through the middle", "all targets equal", "collapse to a plane and beyond",
  "collapse to a line", "one half folded over", "far parts cross", "spikes",
  "targets change places", "twist", "turn up to 180 degrees", "needle through the whole",
  "one target far out of range", "targets on a coarse grid" };
constexpr int NumberOfAdverseMotions = 14;

/// One of them, on a mesh with edges of about the given length.
inline PointList AdverseMotion(int kind, double edge, const PointList& points, std::mt19937& random)
{
  const Eigen::Index count = points.rows();
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Eigen::RowVector3d axis = WhiteNoise(1, 1.0, random).row(0).normalized();
  const PointList outward = points.rowwise() - points.colwise().mean();
  const Eigen::VectorXd height = outward * axis.transpose();
  PointList motion = PointList::Zero(count, 3);
  switch (kind)
  {
    case 0: // white noise
      return WhiteNoise(count, (0.1 + 4.9 * uniform(random)) * edge, random);
    case 1: // inversion through the middle
      return -(1 + uniform(random)) * outward;
    case 2: // all targets equal
      return (-points).rowwise() + Eigen::RowVector3d(points.colwise().mean() + 30 * axis);
    case 3: // collapse to a plane and beyond
      return -(0.9 + uniform(random)) * height * axis;
    case 4: // collapse to a line
      return -(outward - height * axis);
    case 5: // one half is folded over
      for (Eigen::Index i = 0; i < count; ++i)
      {
        if (height[i] > 0)
        {
          motion.row(i) = -2 * height[i] * axis + 5 * axis.unitOrthogonal();
        }
      }
      return motion;
    case 6: // two far parts pass through each other
      for (Eigen::Index i = 0; i < count; ++i)
      {
        motion.row(i) = (std::abs(height[i]) > 15 ? -2.2 * height[i] : 0.0) * axis;
      }
      return motion;
    case 7: // spikes
      for (int spike = 0; spike < 5; ++spike)
      {
        const Eigen::Index i = static_cast<Eigen::Index>(uniform(random) * (count - 1));
        motion.row(i) = (6 * uniform(random) - 3) * outward.row(i);
      }
      return motion;
    case 8: // targets change places
    {
      std::vector<int> order(count);
      std::iota(order.begin(), order.end(), 0);
      std::shuffle(order.begin(), order.end(), random);
      for (Eigen::Index i = 0; i < count; ++i)
      {
        motion.row(i) = points.row(order[i]) - points.row(i);
      }
      return motion;
    }
    case 9: // twisted
      for (Eigen::Index i = 0; i < count; ++i)
      {
        const Eigen::AngleAxisd turn(0.2 * height[i], axis.transpose());
        motion.row(i) = (turn * outward.row(i).transpose()).transpose() - outward.row(i);
      }
      return motion;
    case 10: // turned by much
    {
      const Eigen::AngleAxisd turn(M_PI * uniform(random), axis.transpose());
      return outward * turn.toRotationMatrix().transpose() - outward;
    }
    case 11: // a needle through the whole
      for (Eigen::Index i = 0; i < count; ++i)
      {
        const double distance = (outward.row(i) - 25 * axis).norm();
        motion.row(i) = -60 * std::exp(-distance * distance / 50) * axis;
      }
      return motion;
    case 12: // far out of range
      motion = WhiteNoise(count, edge, random);
      motion.row(static_cast<Eigen::Index>(uniform(random) * (count - 1))) *=
        std::pow(10.0, 250 * uniform(random));
      return motion;
    default: // targets on a coarse grid, many of them equal
      return ((points + WhiteNoise(count, edge, random)) / (2 * edge)).array().round().matrix() *
        (2 * edge) -
        points;
  }
}

} // namespace FlipFree

#endif
