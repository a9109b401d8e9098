// This file is compiled without contraction to fused multiply-add: the error terms below are those
// of separately rounded operations.
#include "Geometry/ExactPredicates.h"

#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// Half the spacing of the doubles at 1, the greatest relative error u of one operation, also
// relative to its rounded result.
constexpr double Epsilon = std::numeric_limits<double>::epsilon() / 2;

// The bounds on the error of a determinant, relative to its permanent P, in which all signs are
// positive (Shewchuk, section 4.3). P is computed in the same order, and rounding is monotone, so
// that each intermediate result is at most its counterpart in P. In space, a product of two
// differences is off by (1 + u)^3 - 1 of its computed self, a minor by (1 + u)^4 - 1, and its
// product with the third difference by (1 + u)^6 - 1 of its counterpart. The first of the last two
// sums adds u P; the second one has the sign of its exact value. The products of P sum up to at
// most (1 + u)^2 P, so that the sign is right if the exact second sum is above
// ((1 + u)^8 - (1 + u)^2 + u) P < (7 + 28 u) u P. The other 28 u^2 are for the rounding of that sum
// and of the bound. In the plane, that is ((1 + u)^4 - (1 + u)) P < (3 + 7 u) u P and 9 u^2.
constexpr double Bound3D = (7 + 56 * Epsilon) * Epsilon;
constexpr double Bound2D = (3 + 16 * Epsilon) * Epsilon;

// sum + error == a + b, exactly.
inline void TwoSum(double a, double b, double& sum, double& error)
{
  sum = a + b;
  const double virtualB = sum - a;
  const double virtualA = sum - virtualB;
  error = (a - virtualA) + (b - virtualB);
}

inline void TwoProduct(double a, double b, double& product, double& error)
{
  product = a * b;
  error = std::fma(a, b, -product);
}

// An unevaluated sum of doubles that do not overlap, of increasing magnitude, zeros left out.
template <int Capacity>
struct Expansion
{
  double Terms[Capacity];
  int Size = 0;

  void Append(double term)
  {
    if (term != 0)
    {
      this->Terms[this->Size++] = term;
    }
  }
  int Sign() const
  {
    // The last term outweighs all others together.
    return this->Size == 0 ? 0 : (this->Terms[this->Size - 1] > 0 ? 1 : -1);
  }
};

Expansion<2> Difference(double a, double b)
{
  double sum = 0;
  double error = 0;
  TwoSum(a, -b, sum, error);
  Expansion<2> result;
  result.Append(error);
  result.Append(sum);
  return result;
}

// Adds one double to an expansion in place.
template <int Capacity>
void Grow(Expansion<Capacity>& expansion, double term)
{
  const int size = expansion.Size;
  expansion.Size = 0;
  for (int i = 0; i < size; ++i)
  {
    double error = 0;
    TwoSum(term, expansion.Terms[i], term, error);
    expansion.Append(error);
  }
  expansion.Append(term);
}

template <int A, int B>
Expansion<A + B> Sum(const Expansion<A>& a, const Expansion<B>& b)
{
  Expansion<A + B> result;
  for (int i = 0; i < a.Size; ++i)
  {
    result.Append(a.Terms[i]);
  }
  for (int i = 0; i < b.Size; ++i)
  {
    Grow(result, b.Terms[i]);
  }
  return result;
}

template <int A, int B>
Expansion<2 * A * B> Product(const Expansion<A>& a, const Expansion<B>& b)
{
  Expansion<2 * A * B> result;
  for (int i = 0; i < a.Size; ++i)
  {
    for (int j = 0; j < b.Size; ++j)
    {
      double product = 0;
      double error = 0;
      TwoProduct(a.Terms[i], b.Terms[j], product, error);
      Grow(result, error);
      Grow(result, product);
    }
  }
  return result;
}

template <int A>
Expansion<A> Negative(Expansion<A> a)
{
  for (int i = 0; i < a.Size; ++i)
  {
    a.Terms[i] = -a.Terms[i];
  }
  return a;
}

// a b - c d
template <int A>
Expansion<4 * A * A> Minor(const Expansion<A>& a, const Expansion<A>& b, const Expansion<A>& c,
  const Expansion<A>& d)
{
  return Sum(Product(a, b), Negative(Product(c, d)));
}

int ExactOrientation3D(const double* a, const double* b, const double* c, const double* d)
{
  const Expansion<2> ax = Difference(a[0], d[0]);
  const Expansion<2> ay = Difference(a[1], d[1]);
  const Expansion<2> az = Difference(a[2], d[2]);
  const Expansion<2> bx = Difference(b[0], d[0]);
  const Expansion<2> by = Difference(b[1], d[1]);
  const Expansion<2> bz = Difference(b[2], d[2]);
  const Expansion<2> cx = Difference(c[0], d[0]);
  const Expansion<2> cy = Difference(c[1], d[1]);
  const Expansion<2> cz = Difference(c[2], d[2]);
  const auto first = Product(Minor(bx, cy, cx, by), az);
  const auto second = Product(Minor(cx, ay, ax, cy), bz);
  const auto third = Product(Minor(ax, by, bx, ay), cz);
  return Sum(Sum(first, second), third).Sign();
}

int ExactOrientation2D(const double* a, const double* b, const double* c, int x, int y)
{
  return Minor(Difference(a[x], c[x]), Difference(b[y], c[y]), Difference(a[y], c[y]),
    Difference(b[x], c[x]))
    .Sign();
}

} // namespace

int Orientation3D(const double* a, const double* b, const double* c, const double* d)
{
  const double ax = a[0] - d[0];
  const double ay = a[1] - d[1];
  const double az = a[2] - d[2];
  const double bx = b[0] - d[0];
  const double by = b[1] - d[1];
  const double bz = b[2] - d[2];
  const double cx = c[0] - d[0];
  const double cy = c[1] - d[1];
  const double cz = c[2] - d[2];

  const double bxcy = bx * cy;
  const double cxby = cx * by;
  const double cxay = cx * ay;
  const double axcy = ax * cy;
  const double axby = ax * by;
  const double bxay = bx * ay;
  const double determinant = az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay);
  const double permanent = (std::abs(bxcy) + std::abs(cxby)) * std::abs(az) +
    (std::abs(cxay) + std::abs(axcy)) * std::abs(bz) +
    (std::abs(axby) + std::abs(bxay)) * std::abs(cz);
  const double bound = Bound3D * permanent;
  if (determinant > bound)
  {
    return 1;
  }
  if (-determinant > bound)
  {
    return -1;
  }
  // Points in a plane across an axis, as on the sides of a cube: differences that are zero are
  // exact.
  if ((ax == 0 && bx == 0 && cx == 0) || (ay == 0 && by == 0 && cy == 0) ||
    (az == 0 && bz == 0 && cz == 0))
  {
    return 0;
  }
  return ExactOrientation3D(a, b, c, d);
}

int Orientation2D(const double* a, const double* b, const double* c, int x, int y)
{
  const double ax = a[x] - c[x];
  const double ay = a[y] - c[y];
  const double bx = b[x] - c[x];
  const double by = b[y] - c[y];
  const double left = ax * by;
  const double right = ay * bx;
  const double determinant = left - right;
  const double bound = Bound2D * (std::abs(left) + std::abs(right));
  if (determinant > bound)
  {
    return 1;
  }
  if (-determinant > bound)
  {
    return -1;
  }
  if ((ax == 0 || by == 0) && (ay == 0 || bx == 0))
  {
    return 0;
  }
  return ExactOrientation2D(a, b, c, x, y);
}

} // namespace FlipFree
