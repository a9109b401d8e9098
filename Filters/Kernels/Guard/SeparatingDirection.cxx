#include "Guard/SeparatingDirection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

using Lanes = Eigen::Array4f;

constexpr float Tiny = 1e-30F;
constexpr float Huge = 1e5F; // its seventh power is still in range
constexpr float Unit = 1.0F / (1 << 24);

// One column per component.
inline Eigen::Matrix4f Transposed(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d)
{
  Eigen::Matrix4f rows;
  rows << a.matrix(), b.matrix(), c.matrix(), d.matrix();
  rows.transposeInPlace();
  return rows;
}

// Rounding. Let u = 2^-24, G the greatest absolute coordinate of the vertices at one end of the
// motion, E the greatest relative to one of them, and |d| the sum of a direction's absolute
// components. The direction itself is taken as it is; it only has to be the same at both ends.
// The errors are at most
//   of a coordinate    u G     its conversion
//                      u E     the subtraction of the local origin, whose own error all share
//   of a projection    (u G + u E) |d| by its coordinates, 3 u E |d| by its products and sums
//   of a difference    twice that, and 2 u E |d| by the subtraction
// together (2 G + 10 E) u |d|. (4 G + 32 E) u |d| is allowed for, which also covers the rounding of
// the allowance itself. The gap is raised by 1e-6 = 17 u of itself for its product with the
// direction's length, which is off by at most 12 u of itself: 1 u for the gap's conversion, 1.5 u
// for half the error of the square, 7.5 u for its root, 2 u for the product and the sum. The root
// is that of Eigen 3.4 (and 3.3 for SSE), which depends on the vector unit:
//   SSE            one step of Newton's method from an approximate inverse root, whose error is
//                  e = 1.5 2^-12: too small by 1.5 e^2 = 3.4 u, and 4 u of roundings
//   WebAssembly    the same code, from an inverse root that is rounded twice: 4 u
//   64-bit ARM     an instruction, rounded correctly: 1 u
//   32-bit ARM     two such steps from e = 2^-8, of which 0.02 u are left, and 4 u of roundings
//                  (not tested there)
//   no vectors     std::sqrt, rounded correctly: 1 u
// A root that is off by 12 u would still do. Numbers that may underflow or overflow prove nothing.
class DirectionTest
{
public:
  DirectionTest(const SinglePrecisionMotion& motion, const Hull& one, const Hull& two, double gap)
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
      for (int i = 0; i < 4; ++i)
      {
        this->One[end][i] = take(one[i]);
        this->Two[end][i] = take(two[i]);
      }
      this->Extent[end] = relative.head<3>().maxCoeff();
      this->Error[end] = Unit * (4 * greatest[3] + 32 * this->Extent[end]);
    }
  }

  // Tries, all at the middle of the motion, the normals of both hulls, the line between their
  // centers, the perpendiculars of the edges in the plane of the hull, and the common
  // perpendiculars of the edges of both.
  bool Succeeds() const
  {
    if (!(this->Extent[0] < Huge && this->Extent[1] < Huge))
    {
      return false;
    }
    const Sides one(this->One);
    const Sides two(this->Two);
    const Lanes between = one.Center - two.Center;
    if (this->AnySeparates(
          Transposed(one.Normal, two.Normal, between, Cross(one.Edges[0], two.Edges[0]))) ||
      this->AnySeparates(CrossAll(one.Normal, one.Edges)) ||
      this->AnySeparates(CrossAll(two.Normal, two.Edges)))
    {
      return true;
    }
    return std::any_of(std::begin(one.Edges), std::end(one.Edges),
      [&](const Lanes& edge) { return this->AnySeparates(CrossAll(edge, two.Edges)); });
  }

private:
  static Lanes Cross(const Lanes& a, const Lanes& b)
  {
    return a.matrix().cross3(b.matrix()).array();
  }

  // The cross products with one vector.
  static Eigen::Matrix4f CrossAll(const Lanes& one, const Lanes (&others)[4])
  {
    const Eigen::Matrix4f rows = Transposed(others[0], others[1], others[2], others[3]);
    Eigen::Matrix4f products;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int next = axis < 2 ? axis + 1 : 0;
      const int last = axis > 0 ? axis - 1 : 2;
      products.col(axis) = one[next] * rows.col(last) - one[last] * rows.col(next);
    }
    return products;
  }

  // Of a hull as a quad, at the middle of the motion; twice or four times as long.
  struct Sides
  {
    explicit Sides(const Lanes (&corners)[2][4])
      : Center(Lanes::Zero())
    {
      Lanes at[4];
      for (int i = 0; i < 4; ++i)
      {
        at[i] = corners[0][i] + corners[1][i];
        this->Center += at[i];
      }
      for (int i = 0; i < 4; ++i)
      {
        this->Edges[i] = at[(i + 1) % 4] - at[i];
      }
      this->Normal = Cross(at[2] - at[0], at[3] - at[1]);
    }

    Lanes Center;
    Lanes Normal;
    Lanes Edges[4];
  };

  // One direction per row.
  bool AnySeparates(const Eigen::Matrix4f& directions) const
  {
    const Lanes x = directions.col(0);
    const Lanes y = directions.col(1);
    const Lanes z = directions.col(2);
    const Lanes square = x * x + y * y + z * z;
    const Lanes gap = this->Gap * square.sqrt();
    const Lanes sum = x.abs() + y.abs() + z.abs();
    Lanes above[2]; // by how much the first hull is above the second one
    Lanes below[2];
    for (int end = 0; end < 2; ++end)
    {
      Lanes low[2];
      Lanes high[2];
      for (int side = 0; side < 2; ++side)
      {
        const Lanes* const vertices = side == 0 ? this->One[end] : this->Two[end];
        const Lanes p = vertices[0][0] * x + vertices[0][1] * y + vertices[0][2] * z;
        const Lanes q = vertices[1][0] * x + vertices[1][1] * y + vertices[1][2] * z;
        const Lanes r = vertices[2][0] * x + vertices[2][1] * y + vertices[2][2] * z;
        const Lanes s = vertices[3][0] * x + vertices[3][1] * y + vertices[3][2] * z;
        low[side] = p.min(q).min(r.min(s));
        high[side] = p.max(q).max(r.max(s));
      }
      const Lanes apart = gap + this->Error[end] * sum;
      above[end] = low[0] - high[1] - apart;
      below[end] = low[1] - high[0] - apart;
    }
    // Numbers that may have underflown make one of the first two conditions fail.
    const Lanes sound = (square - Tiny).min(std::min(this->Error[0], this->Error[1]) * sum - Tiny);
    const Lanes separated = above[0].min(above[1]).max(below[0].min(below[1]));
    return sound.min(separated).maxCoeff() >= 0;
  }

  float Gap;
  float Extent[2];
  float Error[2];
  Lanes One[2][4]; // per end of the motion, relative to a vertex there
  Lanes Two[2][4];
};

// A hull at one end of the motion.
struct CornersAtEnd
{
  CornersAtEnd(const std::vector<Lanes>& points, const Hull& hull)
    : Sum(points[hull[0]] + points[hull[1]] + (points[hull[2]] + points[hull[3]]))
    , Rows(Transposed(points[hull[0]], points[hull[1]], points[hull[2]], points[hull[3]]))
  {
  }
  // The greatest of all coordinates.
  float Greatest() const { return this->Rows.col(3).maxCoeff(); }
  Lanes Along(const Lanes& direction) const
  {
    return this->Rows.col(0).array() * direction[0] + this->Rows.col(1).array() * direction[1] +
      this->Rows.col(2).array() * direction[2];
  }

  Lanes Sum;
  Eigen::Matrix4f Rows;
};

// The line between the centers alone, without a local origin: enough for most pairs. In the
// notation above, the error of a projection is at most (u G + 3 u G) |d|, that of the difference of
// two 8 u G |d| and, by the subtraction of numbers up to 2 G |d| apart, 2 u G |d|; 32 u G |d| is
// allowed for.
bool CentersSeparate(const SinglePrecisionMotion& motion, const Hull& one, const Hull& two,
  double gap)
{
  const CornersAtEnd ones[2] = { { motion.Ends[0], one }, { motion.Ends[1], one } };
  const CornersAtEnd twos[2] = { { motion.Ends[0], two }, { motion.Ends[1], two } };
  const Lanes direction = ones[0].Sum + ones[1].Sum - twos[0].Sum - twos[1].Sum;
  const float square = direction.head<3>().square().sum();
  const float sum = direction.head<3>().abs().sum();
  for (int end = 0; end < 2; ++end)
  {
    const float error = 32 * Unit * sum * std::max(ones[end].Greatest(), twos[end].Greatest());
    const float apart = static_cast<float>(gap * (1 + 1e-6)) * std::sqrt(square) + error;
    // Numbers that may have underflowed or overflowed prove nothing.
    if (!(square > Tiny && square < 1 / Tiny && error > Tiny &&
          ones[end].Along(direction).minCoeff() - twos[end].Along(direction).maxCoeff() >= apart))
    {
      return false;
    }
  }
  return true;
}

} // namespace

SinglePrecisionMotion::SinglePrecisionMotion(Eigen::Index count, const Eigen::Vector3d& origin)
  : Ends{ std::vector<Eigen::Array4f>(count), std::vector<Eigen::Array4f>(count) }
  , Origin(origin)
{
}

void SinglePrecisionMotion::Update(const Motion& motion, int vertex)
{
  for (int end = 0; end < 2; ++end)
  {
    const PointList& points = end == 0 ? motion.From : motion.To;
    Eigen::Array4f& rounded = this->Ends[end][vertex];
    for (int axis = 0; axis < 3; ++axis)
    {
      rounded[axis] = static_cast<float>(points(vertex, axis) - this->Origin[axis]);
    }
    rounded[3] = rounded.head<3>().abs().maxCoeff();
  }
}

bool HaveSeparatingDirection(const SinglePrecisionMotion& motion, const Hull& one, const Hull& two,
  double gap)
{
  if (CentersSeparate(motion, one, two, gap))
  {
    return true;
  }
  return DirectionTest(motion, one, two, gap).Succeeds();
}

} // namespace FlipFree
