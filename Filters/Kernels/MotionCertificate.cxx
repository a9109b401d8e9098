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
  const MotionGap& gap, double enough)
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
    if (!(separation >= kept) || enough <= 0)
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
    if (advance <= LeastAdvance || (time >= enough && time < 1))
    {
      return time;
    }
  }
}

// Tries directions across two triangles, four at once in single precision, for the vector units:
// they decide most pairs for a fraction of the cost of an advancement.
//
// The error bound. Let u = 2^-24, E the greatest coordinate relative to a vertex of the pair (at
// either end of the motion its own), and |d| the sum of a direction's components. A coordinate is
// wrong by u E, the products and sums of a projection add 3 u E |d|, and a difference of two
// projections 2 u E |d|: together less than 11 u E |d|, for which 32 u E |d| is taken. Of the
// direction nothing is assumed but that it is the same at both ends. Numbers so small that they
// underflow, or so large that they overflow, prove nothing.
class DirectionTest
{
public:
  using Lanes = Eigen::Array4f;
  using Vector = Eigen::Vector3f;

  DirectionTest(const Motion& motion, const std::array<int, 3>& one, const std::array<int, 3>& two,
    double gap)
    : Gap(std::max(static_cast<float>(gap * (1 + 1e-6)), Tiny))
  {
    for (int end = 0; end < 2; ++end)
    {
      const PointList& points = end == 0 ? motion.From : motion.To;
      const Eigen::RowVector3d origin = points.row(one[0]);
      float greatest = 0;
      for (int i = 0; i < 3; ++i)
      {
        this->One[end][i] = (points.row(one[i]) - origin).transpose().cast<float>();
        this->Two[end][i] = (points.row(two[i]) - origin).transpose().cast<float>();
        greatest = std::max({ greatest, this->One[end][i].lpNorm<Eigen::Infinity>(),
          this->Two[end][i].lpNorm<Eigen::Infinity>() });
      }
      this->Extent[end] = greatest;
    }
  }

  // Tries the normals of both triangles, across which sheets that lie on each other are apart, the
  // line between their centres, the perpendiculars of their edges.
  bool FindsProof()
  {
    std::array<Vector, 3> a;
    std::array<Vector, 3> b;
    for (int i = 0; i < 3; ++i)
    {
      a[i] = this->One[0][i] + this->One[1][i];
      b[i] = this->Two[0][i] + this->Two[1][i];
    }
    const std::array<Vector, 3> u = { a[1] - a[0], a[2] - a[1], a[0] - a[2] };
    const std::array<Vector, 3> v = { b[1] - b[0], b[2] - b[1], b[0] - b[2] };
    const Vector across = u[0].cross(u[1]);
    const Vector acrossTwo = v[0].cross(v[1]);
    const Vector between = a[0] + a[1] + a[2] - b[0] - b[1] - b[2];
    if (this->IsProof({ across, acrossTwo, between, u[0].cross(v[0]) }))
    {
      return true;
    }
    for (int i = 0; i < 3; ++i)
    {
      if (this->IsProof({ u[i].cross(v[0]), u[i].cross(v[1]), u[i].cross(v[2]), u[i].cross(across) }))
      {
        return true;
      }
    }
    return false;
  }

  // Has any of the directions that were tried shown the gap at the start?
  bool StartsApart() const { return this->IsApartAtStart; }

private:
  static constexpr float Tiny = 1e-30F;
  static constexpr float Error = 32.0F / (1 << 24);

  bool IsProof(const std::array<Vector, 4>& directions)
  {
    Lanes d[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      d[axis] << directions[0][axis], directions[1][axis], directions[2][axis], directions[3][axis];
    }
    const Lanes square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const Lanes wanted = this->Gap * square.sqrt();
    const Lanes sum = Error * (d[0].abs() + d[1].abs() + d[2].abs());
    Lanes above[2];
    Lanes below[2];
    for (int end = 0; end < 2; ++end)
    {
      Lanes low[2];
      Lanes high[2];
      this->Project(this->One[end], d, low[0], high[0]);
      this->Project(this->Two[end], d, low[1], high[1]);
      const Lanes apart = wanted + this->Extent[end] * sum;
      above[end] = low[0] - high[1] - apart;
      below[end] = low[1] - high[0] - apart;
    }
    const float least = std::min(this->Extent[0], this->Extent[1]);
    for (int lane = 0; lane < 4; ++lane)
    {
      if (square[lane] > Tiny && least * sum[lane] > Tiny)
      {
        this->IsApartAtStart = this->IsApartAtStart || above[0][lane] >= 0 || below[0][lane] >= 0;
        if ((above[0][lane] >= 0 && above[1][lane] >= 0) ||
          (below[0][lane] >= 0 && below[1][lane] >= 0))
        {
          return true;
        }
      }
    }
    return false;
  }

  static void Project(const std::array<Vector, 3>& vertices, const Lanes (&d)[3], Lanes& low,
    Lanes& high)
  {
    const Lanes p = vertices[0][0] * d[0] + vertices[0][1] * d[1] + vertices[0][2] * d[2];
    const Lanes q = vertices[1][0] * d[0] + vertices[1][1] * d[1] + vertices[1][2] * d[2];
    const Lanes r = vertices[2][0] * d[0] + vertices[2][1] * d[1] + vertices[2][2] * d[2];
    low = p.min(q).min(r);
    high = p.max(q).max(r);
  }

  float Gap;
  float Extent[2];
  std::array<Vector, 3> One[2];
  std::array<Vector, 3> Two[2];
  bool IsApartAtStart = false;
};

// Most corners turn so little that no square root and no division is needed to see it: the
// component of the normal along the first one is quadratic in time, and positive when its three
// Bernstein coefficients are. They are sums of products of four edges, so that their rounding
// errors are below 1e-14 times the fourth power of the longest.
bool StaysClearlyUpright(const Motion& motion, const std::array<int, 3>& corner)
{
  const auto edge = [&](const PointList& points, int end) -> Vector3d
  { return (points.row(corner[end]) - points.row(corner[1])).transpose(); };
  const Vector3d a = edge(motion.From, 2);
  const Vector3d b = edge(motion.From, 0);
  const Vector3d c = edge(motion.To, 2);
  const Vector3d d = edge(motion.To, 0);
  const double greatest =
    std::max({ a.squaredNorm(), b.squaredNorm(), c.squaredNorm(), d.squaredNorm() });
  const double error = 4 * NormalError * greatest * greatest;
  const Vector3d normal = a.cross(b);
  // Neither underflow nor overflow comes near the comparisons.
  return greatest > 1e-60 && greatest < 1e60 && normal.squaredNorm() > error &&
    normal.dot(a.cross(d) + c.cross(b)) > error && normal.dot(c.cross(d)) > error;
}

} // namespace

double UprightUntil(const Motion& motion, const std::array<int, 3>& corner)
{
  if (StaysClearlyUpright(motion, corner) || AreAtRest(motion, corner))
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
  return Advance(motion, vertex, face, gap, 1);
}

double ApartUntil(const Motion& motion, const std::array<int, 2>& one,
  const std::array<int, 2>& two, const MotionGap& gap)
{
  return Advance(motion, one, two, gap, 1);
}

double ApartUntil(const Motion& motion, const std::array<int, 3>& one,
  const std::array<int, 3>& two, const MotionGap& gap, double enough)
{
  DirectionTest test(motion, one, two, gap.Wanted);
  if (test.FindsProof())
  {
    return 1;
  }
  if (enough <= 0 && test.StartsApart())
  {
    return 0;
  }
  return Advance(motion, one, two, gap, enough);
}

} // namespace FlipFree
