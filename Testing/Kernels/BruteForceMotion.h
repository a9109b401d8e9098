/**
 * What the guard promises, seen by brute force: how long all cuts of a moving surface's faces keep
 * their distance, over all pairs of vertices, edges and triangles, and how long its faces keep
 * their shape. Shares nothing with the guard but the list of faces.
 */
#ifndef FlipFreeBruteForceMotion_h
#define FlipFreeBruteForceMotion_h

#include "Mesh/ContourMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace FlipFree
{

/// Later than the end of a motion.
constexpr double Never = 2;

inline double PointToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b)
{
  const Eigen::Vector3d ab = b - a;
  const double square = ab.squaredNorm();
  const double place = square > 0 ? (p - a).dot(ab) / square : 0;
  return (a + std::clamp(place, 0.0, 1.0) * ab - p).norm();
}

inline double PointToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const auto isInside = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to)
  { return (to - from).cross(p - from).dot(normal) >= 0; };
  if (normal.squaredNorm() > 0 && isInside(a, b) && isInside(b, c) && isInside(c, a))
  {
    return std::abs((p - a).dot(normal)) / normal.norm();
  }
  return std::min({ PointToSegment(p, a, b), PointToSegment(p, b, c), PointToSegment(p, c, a) });
}

inline double SegmentToSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const Eigen::Vector3d across = (b - a).cross(d - c);
  const double square = across.squaredNorm();
  const double onOne = (c - a).cross(d - c).dot(across);
  const double onTwo = (c - a).cross(b - a).dot(across);
  if (square > 0 && onOne >= 0 && onOne <= square && onTwo >= 0 && onTwo <= square)
  {
    return std::abs((c - a).dot(across)) / std::sqrt(square);
  }
  return std::min({ PointToSegment(a, c, d), PointToSegment(b, c, d), PointToSegment(c, a, b),
    PointToSegment(d, a, b) });
}

/// The vertices, edges and triangles of all cuts of a surface's faces, in pairs that have no vertex
/// in common and are in one cut. Of a face of more than eight corners, only the fan is a cut.
class CutFeatures
{
public:
  explicit CutFeatures(const FaceList& faces)
  {
    for (int face = 0; face < faces.NumberOfFaces(); ++face)
    {
      this->AddFace(faces.Face(face), faces.FaceSize(face));
    }
    for (const int vertex : std::set<int>(faces.Connectivity.begin(), faces.Connectivity.end()))
    {
      this->AddPoint(vertex);
    }
    for (auto one = this->Edges.begin(); one != this->Edges.end(); ++one)
    {
      for (auto two = std::next(one); two != this->Edges.end(); ++two)
      {
        const auto [a, b] = *one;
        const auto [c, d] = *two;
        if (a != c && a != d && b != c && b != d && this->Crossing.count({ *one, *two }) == 0)
        {
          this->Pairs.push_back({ { { a, b, c, d } }, 2 });
        }
      }
    }
  }

  /// A vertex, or a fixed point, that stays apart from all triangles.
  void AddPoint(int point)
  {
    for (const auto& [a, b, c] : this->Triangles)
    {
      if (point != a && point != b && point != c)
      {
        this->Pairs.push_back({ { { point, a, b, c } }, 1 });
      }
    }
  }

  /// A time at which two features are nearer than `distance`, before which all keep more than half
  /// of it; or Never.
  double TimeNearerThan(double distance, const PointList& from, const PointList& to) const
  {
    const PointList motion = to - from;
    double first = Never;
    for (const Pair& pair : this->Pairs)
    {
      first = std::min(first, TimeNearerThan(distance, pair, from, motion, std::min(first, 1.0)));
    }
    return first;
  }

private:
  using Edge = std::array<int, 2>;

  struct Pair
  {
    std::array<int, 4> Points;
    int SizeOfFirst;
  };

  static Edge EdgeOf(int one, int two) { return { { std::min(one, two), std::max(one, two) } }; }

  void AddFace(const int* v, int size)
  {
    const auto isCut = [&](int i, int j)
    { return size <= 8 || i == 0 || j == i + 1; }; // a side, or in the fan
    for (int i = 0; i < size; ++i)
    {
      for (int j = i + 1; j < size; ++j)
      {
        if (isCut(i, j))
        {
          this->Edges.insert(EdgeOf(v[i], v[j]));
        }
        for (int k = j + 1; k < size; ++k)
        {
          if (isCut(i, j) && isCut(i, k) && isCut(j, k))
          {
            this->Triangles.insert({ { v[i], v[j], v[k] } });
          }
          for (int l = k + 1; l < size; ++l)
          {
            this->Crossing.insert(std::minmax(EdgeOf(v[i], v[k]), EdgeOf(v[j], v[l])));
          }
        }
      }
    }
  }

  static double SpeedOf(const Pair& pair, const PointList& motion)
  {
    double greatest = 0;
    for (int one = 0; one < pair.SizeOfFirst; ++one)
    {
      for (int two = pair.SizeOfFirst; two < 4; ++two)
      {
        greatest =
          std::max(greatest, (motion.row(pair.Points[one]) - motion.row(pair.Points[two])).norm());
      }
    }
    return greatest;
  }

  static double DistanceOf(const Pair& pair, const PointList& from, const PointList& motion,
    double time)
  {
    const auto at = [&](int i) -> Eigen::Vector3d
    { return from.row(pair.Points[i]) + time * motion.row(pair.Points[i]); };
    return pair.SizeOfFirst == 1 ? PointToTriangle(at(0), at(1), at(2), at(3))
                                 : SegmentToSegment(at(0), at(1), at(2), at(3));
  }

  // No distance changes faster than the greatest difference of two motions.
  static double TimeNearerThan(double distance, const Pair& pair, const PointList& from,
    const PointList& motion, double until)
  {
    const double speed = SpeedOf(pair, motion);
    for (double time = 0; time <= until;)
    {
      const double present = DistanceOf(pair, from, motion, time);
      if (present < distance)
      {
        return time;
      }
      if (time == 1 || present - (1 - time) * speed >= distance)
      {
        return Never;
      }
      time = std::min(1.0, time + (present - distance / 2) / speed);
    }
    return Never;
  }

  std::set<Edge> Edges;
  std::set<std::array<int, 3>> Triangles;   // in the order of their face
  std::set<std::pair<Edge, Edge>> Crossing; // diagonals of one face, the lesser first
  std::vector<Pair> Pairs;
};

/// Whether seen along its normal, a quad is not convex.
inline bool IsBackward(const PointList& points, const int* quad)
{
  const auto at = [&](int corner) -> Eigen::RowVector3d { return points.row(quad[corner % 4]); };
  const Eigen::RowVector3d normal = (at(2) - at(0)).cross(at(3) - at(1));
  for (int corner = 0; corner < 4; ++corner)
  {
    const Eigen::RowVector3d side = at(corner + 1) - at(corner);
    if (!(side.cross(at(corner + 2) - at(corner + 1)).dot(normal) > 0))
    {
      return true;
    }
  }
  return false;
}

/// Whether a corner's normal, or that of a triangle of a face's fan, has turned by 90 degrees or
/// more, or a quad has become folded.
inline bool HasLostShape(const ContourMesh& mesh, const PointList& from, const PointList& now)
{
  const auto isFlipped = [&](int a, int b, int c)
  {
    const auto normal = [&](const PointList& points) -> Eigen::RowVector3d
    {
      const Eigen::RowVector3d side = points.row(b) - points.row(a);
      return side.cross(Eigen::RowVector3d(points.row(c) - points.row(a)));
    };
    return !(normal(from).dot(normal(now)) > 0);
  };
  for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
  {
    const int* const v = mesh.Faces.Face(face);
    const int size = mesh.Faces.FaceSize(face);
    for (int i = 0; i < size; ++i)
    {
      if (isFlipped(v[i], v[(i + 1) % size], v[(i + 2) % size]) ||
        (i > 1 && isFlipped(v[0], v[i - 1], v[i])))
      {
        return true;
      }
    }
    if (size == 4 && !IsBackward(from, v) && IsBackward(now, v))
    {
      return true;
    }
  }
  return false;
}

/// The first of many times at which that is so, or Never.
inline double TimeOfLostShape(const ContourMesh& mesh, const PointList& from, const PointList& to,
  int samples = 256)
{
  for (int sample = 1; sample <= samples; ++sample)
  {
    const double time = static_cast<double>(sample) / samples;
    if (HasLostShape(mesh, from, (1 - time) * from + time * to))
    {
      return time;
    }
  }
  return Never;
}

} // namespace FlipFree

#endif
