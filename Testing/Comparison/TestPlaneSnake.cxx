// The snake of the plane: filled outlines against the rule that defines them, and the curve's
// motion where its end is known.
#include "PlaneSnake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace FlipFree;

namespace
{

// How often the outline goes around a point, by the angles under which its edges are seen.
int WindingNumber(const Outline& outline, const Eigen::Vector2d& point)
{
  double angle = 0;
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
  {
    const Eigen::Vector2d a = outline.row(i).transpose() - point;
    const Eigen::Vector2d b = outline.row((i + 1) % outline.rows()).transpose() - point;
    angle += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  }
  return static_cast<int>(std::lround(angle / (2 * std::acos(-1))));
}

// Unit forces toward a circle.
PlaneField FieldOfCircle(int size, const Eigen::Vector2d& center, double radius)
{
  PlaneField field{ size, size, {} };
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const Eigen::Vector2d fromCenter = Eigen::Vector2d(x, y) - center;
      const double beyond = fromCenter.norm() - radius;
      // Soft at the circle, as between two pixels of an edge.
      field.Forces.emplace_back(
        -std::max(-1.0, std::min(1.0, beyond)) * fromCenter.stableNormalized());
    }
  }
  return field;
}

} // namespace

TEST(PlaneSnake, FillsThePixelsThatTheOutlineWindsAround)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-3, 23); // beyond the image, too
  for (int trial = 0; trial < 200; ++trial)
  {
    Outline outline(3 + trial % 6, 2); // crosses itself more often than not
    for (Eigen::Index i = 0; i < outline.size(); ++i)
    {
      outline.data()[i] = place(random);
    }
    const std::vector<unsigned char> mask = FillOutline(outline, 20, 17);
    for (int y = 0; y < 17; ++y)
    {
      for (int x = 0; x < 20; ++x)
      {
        EXPECT_EQ(mask[x + 20 * y] != 0, WindingNumber(outline, Eigen::Vector2d(x, y)) != 0)
          << "trial " << trial << ", pixel " << x << ", " << y;
      }
    }
  }
}

TEST(PlaneSnake, OutlinesThatShareAnEdgeShareNoPixel)
{
  Outline left(4, 2);
  left << 2, 2, 7, 2, 7, 9, 2, 9;
  Outline right(4, 2);
  right << 7, 2, 12, 2, 12, 9, 7, 9;
  const auto a = FillOutline(left, 15, 12);
  const auto b = FillOutline(right, 15, 12);
  int filled = 0;
  for (std::size_t pixel = 0; pixel < a.size(); ++pixel)
  {
    EXPECT_LE(a[pixel] + b[pixel], 1);
    filled += a[pixel] + b[pixel];
  }
  EXPECT_EQ(filled, 10 * 7);
}

TEST(PlaneSnake, AreaIsThatOfTheShape)
{
  Outline square(4, 2);
  square << 1, 1, 4, 1, 4, 3, 1, 3;
  EXPECT_DOUBLE_EQ(SignedArea(square), 6);
  EXPECT_DOUBLE_EQ(SignedArea(square.colwise().reverse()), -6);
  EXPECT_NEAR(SignedArea(MakeCircle(Eigen::Vector2d(3, 4), 20)), 400 * std::acos(-1), 2);
}

TEST(PlaneSnake, ComesToRestOnTheCircleThatForcesPointTo)
{
  const Eigen::Vector2d center(50, 45);
  SnakeSettings settings;
  settings.AreaTolerance = 1e-4;
  for (const double start : { 8.0, 40.0 }) // from within and from without
  {
    Outline outline = MakeCircle(center + Eigen::Vector2d(3, -2), start);
    int iterations = 0;
    ASSERT_TRUE(
      MoveSnake(FieldOfCircle(100, center, 25), settings, NeverStop, outline, iterations));
    EXPECT_LT(iterations, 300);
    for (Eigen::Index i = 0; i < outline.rows(); ++i)
    {
      EXPECT_NEAR((outline.row(i).transpose() - center).norm(), 25, 0.2);
      const double edge = (outline.row((i + 1) % outline.rows()) - outline.row(i)).norm();
      EXPECT_NEAR(edge, 1.5, 0.5);
    }
  }
}

TEST(PlaneSnake, TensionAloneShrinksACircleAsTheMatrixSays)
{
  const PlaneField none{ 100, 100, std::vector<Eigen::Vector2d>(10000, Eigen::Vector2d::Zero()) };
  SnakeSettings settings;
  settings.Elasticity = 0.3;
  settings.Rigidity = 0.1;
  settings.MaximumIterations = 1;
  const Eigen::Vector2d center(50, 50);
  Outline outline = MakeCircle(center, 30);
  const double angle = 2 * std::acos(-1) / static_cast<double>(outline.rows());
  int iterations = 0;
  ASSERT_TRUE(MoveSnake(none, settings, NeverStop, outline, iterations));
  EXPECT_EQ(iterations, 1);
  // A circle is an eigenvector of the cyclic stencils.
  const double tension = 2 - 2 * std::cos(angle);
  const double expected = 30 / (1 + 0.3 * tension + 0.1 * tension * tension);
  EXPECT_NEAR((outline.row(0).transpose() - center).norm(), expected, 1e-2);
  EXPECT_LT(expected, 29.98);
}

TEST(PlaneSnake, PressureBlowsItUpToTheImagesEnd)
{
  const PlaneField none{ 60, 40, std::vector<Eigen::Vector2d>(2400, Eigen::Vector2d::Zero()) };
  SnakeSettings settings;
  settings.Pressure = 1;
  settings.MaximumIterations = 200;
  Outline outline = MakeCircle(Eigen::Vector2d(30, 20), 5);
  int iterations = 0;
  ASSERT_TRUE(MoveSnake(none, settings, NeverStop, outline, iterations));
  EXPECT_GE(outline.minCoeff(), 0);
  EXPECT_LE(outline.col(0).maxCoeff(), 59);
  EXPECT_LE(outline.col(1).maxCoeff(), 39);
  EXPECT_GT(SignedArea(outline), 0.9 * 59 * 39);
}

TEST(PlaneSnake, Stops)
{
  Outline outline = MakeCircle(Eigen::Vector2d(30, 20), 5);
  int asked = 0;
  int iterations = 0;
  EXPECT_FALSE(MoveSnake(
    FieldOfCircle(60, Eigen::Vector2d(30, 30), 20), SnakeSettings(),
    [&asked](double fraction) { return fraction < 1 && ++asked < 7; }, outline, iterations));
  EXPECT_EQ(asked, 7);
}
