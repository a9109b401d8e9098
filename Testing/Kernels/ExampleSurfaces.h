/**
 * Surfaces and voxel grids that several tests share.
 */
#ifndef FlipFreeExampleSurfaces_h
#define FlipFreeExampleSurfaces_h

#include "Geometry/FaceHulls.h"
#include "Mesh/ContourMesh.h"
#include "Mesh/MidpointMesh.h"
#include "Mesh/QuadSphere.h"

#include <cmath>
#include <future>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace FlipFree
{

struct Surface
{
  PointList Points;
  TriangleList Triangles;
};

inline Surface Sphere(int n, const Eigen::Vector3d& center, double radius)
{
  const QuadSphere sphere = MakeQuadSphere(n, center, radius, QuadSphereSpacing::Equiangular);
  return { sphere.Points,
    BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces).Triangles };
}

/// A sphere with bumps and dents deep enough that rays cross it several times.
inline Surface Potato(int n, const Eigen::Vector3d& center, double radius)
{
  Surface surface = Sphere(n, Eigen::Vector3d::Zero(), 1);
  for (Eigen::Index vertex = 0; vertex < surface.Points.rows(); ++vertex)
  {
    const Eigen::Vector3d d = surface.Points.row(vertex);
    const double bumps = 1 + 0.35 * std::sin(5 * d.x() + 1) * std::cos(6 * d.y() - 4 * d.z());
    surface.Points.row(vertex) = center + radius * bumps * d;
  }
  return surface;
}

inline Surface Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  Surface box;
  box.Points.resize(8, 3);
  for (int corner = 0; corner < 8; ++corner)
  {
    box.Points.row(corner) << (corner & 1 ? high : low).x(), (corner & 2 ? high : low).y(),
      (corner & 4 ? high : low).z();
  }
  box.Triangles.resize(12, 3);
  box.Triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6,
    0, 6, 2, 1, 3, 7, 1, 7, 5;
  return box;
}

inline Surface Moved(Surface surface, const Eigen::Matrix3d& matrix,
  const Eigen::Vector3d& translation)
{
  surface.Points =
    ((surface.Points * matrix.transpose()).rowwise() + translation.transpose()).eval();
  return surface;
}

inline Surface Joined(const Surface& first, const Surface& second)
{
  Surface both;
  both.Points.resize(first.Points.rows() + second.Points.rows(), 3);
  both.Points << first.Points, second.Points;
  both.Triangles.resize(first.Triangles.rows() + second.Triangles.rows(), 3);
  both.Triangles << first.Triangles,
    (second.Triangles.array() + static_cast<int>(first.Points.rows())).matrix();
  return both;
}

/// Two blobs, joined by a neck of two quads, faces 0 and 1, that share two opposite corners: cut
/// along these, both have the same diagonal. Of each blob, two pentagons (2 and 3, 10 and 11) have
/// a diagonal in common, too. No faces intersect, and each vertex has four neighbors.
inline PolygonMesh NeckOfTwoFaces()
{
  PolygonMesh mesh;
  mesh.Points.resize(16, 3);
  mesh.Points << 0, 1, 0, 0, -1, 0,                                                      // the neck
    -1, 0, 1, -1, 0, -1, -2, 1, 0.7, -2, -1, 0.7, -2, 1, -0.7, -2, -1, -0.7, -2.5, 0, 0, //
    1, 0, 1, 1, 0, -1, 2, 1, 0.7, 2, -1, 0.7, 2, 1, -0.7, 2, -1, -0.7, 2.5, 0, 0;
  mesh.Faces.Append({ 0, 2, 1, 9 });
  mesh.Faces.Append({ 0, 10, 1, 3 });
  mesh.Faces.Append({ 2, 0, 3, 6, 4 });
  mesh.Faces.Append({ 1, 2, 5, 7, 3 });
  mesh.Faces.Append({ 2, 4, 5 });
  mesh.Faces.Append({ 3, 7, 6 });
  mesh.Faces.Append({ 4, 6, 8 });
  mesh.Faces.Append({ 7, 5, 8 });
  mesh.Faces.Append({ 5, 4, 8 });
  mesh.Faces.Append({ 6, 7, 8 });
  mesh.Faces.Append({ 11, 13, 10, 0, 9 });
  mesh.Faces.Append({ 10, 14, 12, 9, 1 });
  mesh.Faces.Append({ 12, 11, 9 });
  mesh.Faces.Append({ 13, 14, 10 });
  mesh.Faces.Append({ 15, 13, 11 });
  mesh.Faces.Append({ 15, 12, 14 });
  mesh.Faces.Append({ 15, 11, 12 });
  mesh.Faces.Append({ 15, 14, 13 });
  return mesh;
}

/// Positive where the triangles face outward.
inline double EnclosedVolume(const Surface& surface)
{
  double volume = 0;
  for (Eigen::Index triangle = 0; triangle < surface.Triangles.rows(); ++triangle)
  {
    const Eigen::Vector3d a = surface.Points.row(surface.Triangles(triangle, 0));
    const Eigen::Vector3d b = surface.Points.row(surface.Triangles(triangle, 1));
    const Eigen::Vector3d c = surface.Points.row(surface.Triangles(triangle, 2));
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

/// How often the surface winds around a point, by the triangles' solid angles (van Oosterom and
/// Strackee 1983): an inside test that shares nothing with scan conversion.
inline double WindingNumber(const Surface& surface, const Eigen::Vector3d& point)
{
  double solidAngle = 0;
  for (Eigen::Index triangle = 0; triangle < surface.Triangles.rows(); ++triangle)
  {
    const Eigen::Vector3d a =
      surface.Points.row(surface.Triangles(triangle, 0)).transpose() - point;
    const Eigen::Vector3d b =
      surface.Points.row(surface.Triangles(triangle, 1)).transpose() - point;
    const Eigen::Vector3d c =
      surface.Points.row(surface.Triangles(triangle, 2)).transpose() - point;
    solidAngle += 2 *
      std::atan2(a.dot(b.cross(c)),
        a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() +
          c.dot(a) * b.norm());
  }
  return solidAngle / (16 * std::atan(1.0));
}

inline Eigen::Matrix3d ObliqueRotation()
{
  return (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized())).toRotationMatrix();
}

/// Identity, permuted, flipped, oblique, and oblique left-handed axes.
inline std::vector<std::pair<std::string, Eigen::Matrix3d>> ExampleDirections()
{
  Eigen::Matrix3d permuted;
  permuted << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  Eigen::Matrix3d flipped = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  return { { "identity", Eigen::Matrix3d::Identity() }, { "permuted", permuted },
    { "flipped", flipped }, { "oblique", ObliqueRotation() }, { "left-handed", permuted * mirror },
    { "oblique left-handed", ObliqueRotation() * mirror } };
}

/// Two threads take the parts of the range alternately, in many parts and in reverse order: what
/// differs from SerialFor under it would differ between numbers of threads.
inline void ScatteredFor(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
{
  constexpr std::ptrdiff_t size = 7;
  const auto work = [&](std::ptrdiff_t last)
  {
    for (; last > begin; last -= 2 * size)
    {
      body(std::max(begin, last - size), last);
    }
  };
  // The future waits for its thread when it is destroyed, and passes exceptions on.
  std::future<void> other = std::async(std::launch::async, work, end - size);
  work(end);
  other.get();
}

/// Of parts of adjacent faces, or of one, without those that others cover.
inline std::vector<HullPair> AdjacentPairsOf(const FaceHulls& hulls)
{
  std::vector<HullPair> all;
  hulls.VisitAdjacentPairs(false,
    [&all](const std::vector<HullPair>& pairs)
    { all.insert(all.end(), pairs.begin(), pairs.end()); });
  return all;
}

/// The message of the std::invalid_argument that an action throws; "" if it throws none.
template <typename Action>
std::string ErrorOf(Action&& action)
{
  try
  {
    action();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}

} // namespace FlipFree

#endif
