#include "MotionCertificate.h"

#include "ClosestDirection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

// Advances shorter than this fraction of the motion are given up: the parts are about to touch.
constexpr double LeastAdvance = 0.01;

// Parts that are nearer than the wanted gap keep their distance, up to this fraction; without it,
// rounding would refuse every motion.
constexpr double KeptFraction = 1 - 1e-6;

// Relative to the square of the greatest length, well above the rounding errors of a normal.
constexpr double NormalError = 1e-12;

template <std::size_t N>
bool AreAtRest(const Motion& motion, const std::array<int, N>& vertices)
{
  return std::all_of(vertices.begin(), vertices.end(),
    [&](int vertex) { return motion.IsAtRest(vertex); });
}

template <std::size_t N>
std::array<Vector3d, N> PositionsAt(const Motion& motion, const std::array<int, N>& vertices,
  double time)
{
  std::array<Vector3d, N> positions;
  for (std::size_t i = 0; i < N; ++i)
  {
    positions[i] = motion.At(vertices[i], time);
  }
  return positions;
}

// Where vertices lie along a direction.
template <std::size_t N>
struct Projection
{
  std::array<double, N> Places;
  double Low = std::numeric_limits<double>::infinity();
  double High = -std::numeric_limits<double>::infinity();
};

template <std::size_t N>
Projection<N> Project(const std::array<Vector3d, N>& vertices, const Vector3d& direction)
{
  Projection<N> projection;
  for (std::size_t i = 0; i < N; ++i)
  {
    projection.Places[i] = vertices[i].dot(direction);
    projection.Low = std::min(projection.Low, projection.Places[i]);
    projection.High = std::max(projection.High, projection.Places[i]);
  }
  return projection;
}

// Conservative advancement: a direction carries the proof as far as it separates, then the next one
// is taken from where it got.
template <std::size_t A, std::size_t B>
double Advance(const Motion& motion, const std::array<int, A>& one, const std::array<int, B>& two,
  const MotionGap& gap)
{
  if (AreAtRest(motion, one) && AreAtRest(motion, two))
  {
    return 1;
  }
  const std::array<Vector3d, A> oneEnd = PositionsAt(motion, one, 1);
  const std::array<Vector3d, B> twoEnd = PositionsAt(motion, two, 1);
  double time = 0;
  double kept = gap.Wanted;
  while (true)
  {
    const std::array<Vector3d, A> oneNow = PositionsAt(motion, one, time);
    const std::array<Vector3d, B> twoNow = PositionsAt(motion, two, time);
    const Vector3d direction = ClosestDirection(oneNow, twoNow).normalized();

    const Projection<A> oneBefore = Project(oneNow, direction);
    const Projection<B> twoBefore = Project(twoNow, direction);
    const double separation = oneBefore.Low - twoBefore.High;
    if (time == 0)
    {
      kept = std::min(gap.Wanted, KeptFraction * separation);
    }
    if (!(kept >= gap.Resolution && kept > 0))
    {
      return -1;
    }
    if (!(separation >= kept))
    {
      return time;
    }

    const Projection<A> oneAfter = Project(oneEnd, direction);
    const Projection<B> twoAfter = Project(twoEnd, direction);
    if (oneAfter.Low - twoAfter.High >= kept)
    {
      return 1;
    }
    double reached = 1;
    for (std::size_t i = 0; i < A; ++i)
    {
      for (std::size_t j = 0; j < B; ++j)
      {
        const double end = oneAfter.Places[i] - twoAfter.Places[j];
        if (!(end >= kept))
        {
          const double now = oneBefore.Places[i] - twoBefore.Places[j];
          reached = std::min(reached, (now - kept) / (now - end));
        }
      }
    }
    const double advance = (1 - time) * reached;
    if (!(advance > 0))
    {
      return time;
    }
    time += advance;
    if (advance <= LeastAdvance)
    {
      return time;
    }
  }
}

// Does the direction, of any length, separate two triangles?
bool Separates(const std::array<Vector3d, 3>& one, const std::array<Vector3d, 3>& two,
  const Vector3d& direction, double gap)
{
  return Project(one, direction).Low - Project(two, direction).High >= gap;
}

} // namespace

double UprightUntil(const Motion& motion, const std::array<int, 3>& corner)
{
  if (AreAtRest(motion, corner))
  {
    return 1;
  }
  Vector3d edges[2][2];
  double greatest = 0;
  for (int end = 0; end < 2; ++end)
  {
    const PointList& points = end == 0 ? motion.From : motion.To;
    const Vector3d vertex = points.row(corner[1]);
    edges[end][0] = points.row(corner[2]).transpose() - vertex;
    edges[end][1] = points.row(corner[0]).transpose() - vertex;
    greatest = std::max({ greatest, edges[end][0].norm(), edges[end][1].norm() });
  }
  if (greatest == 0)
  {
    return 1;
  }
  for (auto& pair : edges)
  {
    pair[0] /= greatest; // so that no product underflows
    pair[1] /= greatest;
  }
  const Vector3d normal = edges[0][0].cross(edges[0][1]);
  const double length = normal.norm();
  if (length <= NormalError)
  {
    return 1;
  }
  // The normal is quadratic in time, and so is its component along the first one:
  // b0 (1 - t)^2 + 2 b1 t (1 - t) + b2 t^2, which must stay above what rounding may make of it.
  const double error = NormalError * length;
  const double b0 = length * length - error;
  const double b1 =
    0.5 * normal.dot(edges[0][0].cross(edges[1][1]) + edges[1][0].cross(edges[0][1])) - error;
  const double b2 = normal.dot(edges[1][0].cross(edges[1][1])) - error;
  const double discriminant = b1 * b1 - b0 * b2;
  if (b2 > 0 && (b1 >= 0 || discriminant < 0))
  {
    return 1;
  }
  // The first zero as t / (1 - t). Neither form subtracts what may be nearly the same: a corner
  // that is thin at both ends and wide in between has a b1 beside which b0 and b2 are lost.
  const double root = std::sqrt(std::max(0.0, discriminant));
  const double ratio = b1 < 0 ? b0 / (root - b1) : (root + b1) / -b2;
  const double time = std::isfinite(ratio) ? ratio / (1 + ratio) : 1;
  return std::min(time, std::nextafter(1.0, 0.0));
}

double ApartUntil(const Motion& motion, const std::array<int, 1>& vertex,
  const std::array<int, 3>& face, const MotionGap& gap)
{
  return Advance(motion, vertex, face, gap);
}

double ApartUntil(const Motion& motion, const std::array<int, 2>& one,
  const std::array<int, 2>& two, const MotionGap& gap)
{
  return Advance(motion, one, two, gap);
}

double ApartUntil(const Motion& motion, const std::array<int, 3>& one,
  const std::array<int, 3>& two, const MotionGap& gap)
{
  if (AreAtRest(motion, one) && AreAtRest(motion, two))
  {
    return 1;
  }
  // These directions decide most pairs for a fraction of the cost: the one between the centres, the
  // normals, across which sheets that lie on each other are apart, and those across two edges.
  const std::array<Vector3d, 3> oneStart = PositionsAt(motion, one, 0);
  const std::array<Vector3d, 3> twoStart = PositionsAt(motion, two, 0);
  const std::array<Vector3d, 3> oneEnd = PositionsAt(motion, one, 1);
  const std::array<Vector3d, 3> twoEnd = PositionsAt(motion, two, 1);
  std::array<Vector3d, 3> a;
  std::array<Vector3d, 3> b;
  for (int corner = 0; corner < 3; ++corner)
  {
    a[corner] = 0.5 * (oneStart[corner] + oneEnd[corner]);
    b[corner] = 0.5 * (twoStart[corner] + twoEnd[corner]);
  }
  const Vector3d between = (a[0] + a[1] + a[2]) - (b[0] + b[1] + b[2]);
  const auto isProof = [&](const Vector3d& direction)
  {
    const double apart = gap.Wanted * direction.norm();
    // Of a direction that is zero nothing can be said, and nothing can be proven.
    return apart > 0 && Separates(oneStart, twoStart, direction, apart) &&
      Separates(oneEnd, twoEnd, direction, apart);
  };
  const auto towardsOne = [&](const Vector3d& normal) -> Vector3d
  { return normal.dot(between) < 0 ? Vector3d(-normal) : normal; };
  if (isProof(towardsOne((b[1] - b[0]).cross(b[2] - b[0]))) ||
    isProof(towardsOne((a[1] - a[0]).cross(a[2] - a[0]))) || isProof(between))
  {
    return 1;
  }
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      if (isProof(towardsOne((a[(i + 1) % 3] - a[i]).cross(b[(j + 1) % 3] - b[j]))))
      {
        return 1;
      }
    }
  }
  return Advance(motion, one, two, gap);
}

} // namespace FlipFree
