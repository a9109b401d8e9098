// Positions as files of single precision hold them.
#include "Guard/SinglePrecision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

// The nearest numbers of single precision, and whether `rounded` is one of them. Ties have two.
bool IsNearestSingle(double rounded, double value)
{
  const volatile float single = static_cast<float>(value);
  const volatile float back = static_cast<float>(rounded);
  return back == rounded && std::abs(rounded - value) == std::abs(single - value);
}

} // namespace

// Values of all magnitudes, ties between two numbers, and the neighbors of ties.
TEST(SinglePrecision, RoundsToTheNearestNumber)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> mantissa(1, 2);
  std::uniform_int_distribution<int> exponent(-120, 120);
  for (int repeat = 0; repeat < 20000; ++repeat)
  {
    const double sign = repeat % 2 == 0 ? 1 : -1;
    const double value = sign * std::ldexp(mantissa(random), exponent(random));
    const volatile float single = static_cast<float>(value);
    const double tie = (static_cast<double>(single) +
                         std::nextafter(single, std::numeric_limits<float>::infinity())) /
      2;
    const Eigen::RowVector3d position(value, tie, std::nextafter(tie, 0.0));
    const Eigen::RowVector3d rounded = RoundToSingle(position, 1e38);
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_TRUE(IsNearestSingle(rounded[axis], position[axis])) << position[axis];
      ASSERT_LE(std::abs(rounded[axis] - position[axis]),
        std::ldexp(std::abs(position[axis]), -24));
    }
  }
  EXPECT_EQ(RoundToSingle(Eigen::RowVector3d(0, -1, 3), 1), Eigen::RowVector3d(0, -1, 3));
}

// By less than a thousandth of an edge along each axis, or not at all.
TEST(SinglePrecision, LeavesWhatItWouldMoveTooFar)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int left = 0;
  int rounded = 0;
  for (int repeat = 0; repeat < 20000; ++repeat)
  {
    const double edge = std::ldexp(1.0, repeat % 40 - 20);
    const Eigen::RowVector3d position =
      1000 * Eigen::RowVector3d(uniform(random), uniform(random), uniform(random));
    const Eigen::RowVector3d result = RoundToSingle(position, edge);
    ASSERT_LE((result - position).lpNorm<Eigen::Infinity>(), 1e-3 * edge);
    const bool isFine = position.cwiseAbs().maxCoeff() < 1e-3 * edge * (1 << 24);
    ASSERT_EQ(result == position, !isFine) << edge;
    (isFine ? rounded : left) += 1;
  }
  EXPECT_GT(left, 5000);
  EXPECT_GT(rounded, 5000);
}
