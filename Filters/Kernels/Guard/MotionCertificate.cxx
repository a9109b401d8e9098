#include "Guard/MotionCertificate.h"

#include "Geometry/ClosestDirection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

// Advances shorter than this fraction of the motion are given up: the parts are about to touch.
constexpr double MinimumAdvance = 0.01;

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
    if (advance <= MinimumAdvance || (time >= enough && time < 1))
    {
      return time;
    }
  }
}

// Tries directions across two triangles, four at once in single precision, for the vector units:
// they decide most pairs for a fraction of the cost of an advancement.
//
// The error bound. Let u = 2^-24, G the greatest coordinate of the vertices at one end of the
// motion, E the greatest relative to one of them, and |d| the sum of a direction's components. A
// coordinate is wrong by u G from its conversion and u E from being made relative; the products and
// sums of a projection add 3 u E |d|, and a difference of two projections 2 u E |d|: together less
// than (2 G + 10 E) u |d|, for which (4 G + 32 E) u |d| is taken. Of the direction nothing is
// assumed but that it is the same at both ends. Where one end is compared with the other, the way S
// from origin to origin adds less than (2 G + 6 S) u |d|, and a last sum u S |d|. (That is plain
// but generous: a proof that hangs on rounding has its way nearly across the direction, where S
// adds at most 2.5 u S |d|, which the 4 G of both ends cover; no test can tell that S is there.)
// Numbers so small that they may underflow, or so large that they may overflow, prove nothing.
class DirectionTest
{
public:
  using Lanes = Eigen::Array4f;

  DirectionTest(const RoughMotion& motion, const std::array<int, 3>& one,
    const std::array<int, 3>& two, double gap)
    : Gap(std::max(static_cast<float>(gap * (1 + 1e-6)), Tiny))
  {
    for (int end = 0; end < 2; ++end)
    {
      const std::vector<Lanes>& points = motion.Ends[end];
      const Lanes origin = points[one[0]];
      Lanes greatest = origin;
      Lanes relative = Lanes::Zero();
      const auto take = [&](int vertex)
      {
        Lanes local = points[vertex] - origin;
        greatest = greatest.max(points[vertex]);
        relative = relative.max(local.abs());
        return local;
      };
      for (int i = 0; i < 3; ++i)
      {
        this->One[end][i] = take(one[i]);
        this->Two[end][i] = take(two[i]);
      }
      this->Extent[end] = relative.head<3>().maxCoeff();
      this->Error[end] = Unit * (4 * greatest[3] + 32 * this->Extent[end]);
    }
    this->Way = motion.Ends[1][one[0]] - motion.Ends[0][one[0]];
    this->ErrorBetween =
      this->Error[0] + this->Error[1] + 32 * Unit * this->Way.head<3>().abs().maxCoeff();
  }

  // Tries the normals of both triangles, across which sheets that lie on each other are apart, the
  // line between their centers, the perpendiculars of their edges.
  QuickProof Find()
  {
    if (!(this->Extent[0] < Huge && this->Extent[1] < Huge))
    {
      return QuickProof::None;
    }
    const auto a = [this](int i) -> Lanes { return this->One[0][i] + this->One[1][i]; };
    const auto b = [this](int i) -> Lanes { return this->Two[0][i] + this->Two[1][i]; };
    const Lanes u[3] = { a(1) - a(0), a(2) - a(1), a(0) - a(2) };
    const Lanes v[3] = { b(1) - b(0), b(2) - b(1), b(0) - b(2) };
    const Lanes across = Cross(u[0], u[1]);
    const Lanes between = a(0) + a(1) + a(2) - b(0) - b(1) - b(2);
    this->Try(Transposed(across, Cross(v[0], v[1]), between, Cross(u[0], v[0])));
    if (this->Found >= QuickProof::ApartThroughout)
    {
      return this->Found;
    }
    const Eigen::Matrix4f others = Transposed(v[0], v[1], v[2], across);
    for (const Lanes& edge : u)
    {
      Eigen::Matrix4f directions;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int next = axis < 2 ? axis + 1 : 0;
        const int last = axis > 0 ? axis - 1 : 2;
        directions.col(axis) = edge[next] * others.col(last) - edge[last] * others.col(next);
      }
      this->Try(directions);
      if (this->Found >= QuickProof::ApartThroughout)
      {
        break;
      }
    }
    return this->Found;
  }

private:
  static constexpr float Tiny = 1e-30F;
  static constexpr float Huge = 1e5F; // its seventh power is still in range
  static constexpr float Unit = 1.0F / (1 << 24);

  static Lanes Cross(const Lanes& a, const Lanes& b)
  {
    return a.matrix().cross3(b.matrix()).array();
  }

  // One column per component.
  static Eigen::Matrix4f Transposed(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d)
  {
    Eigen::Matrix4f rows;
    rows << a.matrix(), b.matrix(), c.matrix(), d.matrix();
    rows.transposeInPlace();
    return rows;
  }

  void Try(const Eigen::Matrix4f& directions)
  {
    const Lanes x = directions.col(0);
    const Lanes y = directions.col(1);
    const Lanes z = directions.col(2);
    const Lanes square = x * x + y * y + z * z;
    const Lanes wanted = this->Gap * square.sqrt();
    const Lanes sum = x.abs() + y.abs() + z.abs();
    Lanes low[2][2];
    Lanes high[2][2];
    Lanes above[2];
    Lanes below[2];
    for (int end = 0; end < 2; ++end)
    {
      for (int side = 0; side < 2; ++side)
      {
        const Lanes* const vertices = side == 0 ? this->One[end] : this->Two[end];
        const Lanes p = vertices[0][0] * x + vertices[0][1] * y + vertices[0][2] * z;
        const Lanes q = vertices[1][0] * x + vertices[1][1] * y + vertices[1][2] * z;
        const Lanes r = vertices[2][0] * x + vertices[2][1] * y + vertices[2][2] * z;
        low[end][side] = p.min(q).min(r);
        high[end][side] = p.max(q).max(r);
      }
      const Lanes apart = wanted + this->Error[end] * sum;
      above[end] = low[end][0] - high[end][1] - apart;
      below[end] = low[end][1] - high[end][0] - apart;
    }
    // Numbers that may have underflown make one of these conditions fail.
    const float least = std::min(this->Error[0], this->Error[1]);
    const Lanes sound = (square - Tiny).min(least * sum - Tiny);
    const auto holds = [&sound](const Lanes& condition)
    { return condition.min(sound).maxCoeff() >= 0; };
    if (holds(above[0].min(above[1]).max(below[0].min(below[1]))))
    {
      const Lanes way = this->Way[0] * x + this->Way[1] * y + this->Way[2] * z;
      Lanes lowest[2];
      Lanes highest[2];
      for (int side = 0; side < 2; ++side)
      {
        lowest[side] = low[0][side].min(low[1][side] + way);
        highest[side] = high[0][side].max(high[1][side] + way);
      }
      const Lanes apart = wanted + this->ErrorBetween * sum;
      this->Found = holds((lowest[0] - highest[1]).max(lowest[1] - highest[0]) - apart)
        ? QuickProof::ApartOnAnyPart
        : QuickProof::ApartThroughout;
    }
    else if (holds(above[0].max(below[0])))
    {
      this->Found = QuickProof::ApartAtStart;
    }
  }

  float Gap;
  float Extent[2];
  float Error[2];
  Lanes One[2][3];
  Lanes Two[2][3];
  Lanes Way; // from end to end, of what positions are relative to
  float ErrorBetween;
  QuickProof Found = QuickProof::None;
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
  const std::array<int, 3>& face, const MotionGap& gap, double enough)
{
  return Advance(motion, vertex, face, gap, enough);
}

double ApartUntil(const Motion& motion, const std::array<int, 2>& one,
  const std::array<int, 2>& two, const MotionGap& gap, double enough)
{
  return Advance(motion, one, two, gap, enough);
}

double ApartUntil(const Motion& motion, const std::array<int, 3>& one,
  const std::array<int, 3>& two, const MotionGap& gap, double enough)
{
  return Advance(motion, one, two, gap, enough);
}

RoughMotion::RoughMotion(Eigen::Index count, const Eigen::Vector3d& origin)
  : Ends{ std::vector<Eigen::Array4f>(count), std::vector<Eigen::Array4f>(count) }
  , Origin(origin)
{
}

void RoughMotion::Update(const Motion& motion, int vertex)
{
  for (int end = 0; end < 2; ++end)
  {
    const PointList& points = end == 0 ? motion.From : motion.To;
    Eigen::Array4f& rough = this->Ends[end][vertex];
    for (int axis = 0; axis < 3; ++axis)
    {
      rough[axis] = static_cast<float>(points(vertex, axis) - this->Origin[axis]);
    }
    rough[3] = rough.head<3>().abs().maxCoeff();
  }
}

QuickProof ProveApart(const RoughMotion& motion, const std::array<int, 3>& one,
  const std::array<int, 3>& two, double gap)
{
  return DirectionTest(motion, one, two, gap).Find();
}

} // namespace FlipFree
