#include "Vessel/Polyline.h"
#include "Vessel/SectionFrames.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

PointList Helix(int points)
{
  PointList line(points, 3);
  for (int point = 0; point < points; ++point)
  {
    const double angle = 4 * EIGEN_PI * point / (points - 1);
    line.row(point) << 20 * std::cos(angle), 20 * std::sin(angle), 3 * angle;
  }
  return line;
}

} // namespace

TEST(SectionFrames, AreOrthonormalAndRightHanded)
{
  for (const SectionFrame& frame : MakeSectionFrames(Helix(150)))
  {
    EXPECT_NEAR(frame.Tangent.norm(), 1, 1e-12);
    EXPECT_NEAR(frame.First.norm(), 1, 1e-12);
    EXPECT_LT((frame.First.cross(frame.Second) - frame.Tangent).norm(), 1e-12);
  }
}

TEST(SectionFrames, TurnAsLittleAsPossible)
{
  // In a plane they do not turn at all: the axis out of the plane stays.
  PointList arc(60, 3);
  for (int point = 0; point < 60; ++point)
  {
    const double angle = 1.5 * EIGEN_PI * point / 59;
    arc.row(point) << 30 * std::cos(angle), 30 * std::sin(angle), 0;
  }
  const auto frames = MakeSectionFrames(arc);
  const double first = frames[0].First.z();
  for (const SectionFrame& frame : frames)
  {
    EXPECT_NEAR(frame.First.z(), first, 1e-9);
  }
  // Along a helix they turn against the tangent's frame by the torsion's integral.
  const auto helix = MakeSectionFrames(Helix(2000));
  double turn = 0;
  for (std::size_t frame = 1; frame < helix.size(); ++frame)
  {
    const Eigen::Vector3d change = helix[frame].First - helix[frame - 1].First;
    turn += std::abs(change.dot(helix[frame].Second));
  }
  EXPECT_LT(turn, 2e-2); // about the tangent they do not
}

TEST(Polyline, ResamplesAndSmooths)
{
  const PointList helix = Helix(400);
  const double length = ArcLengths(helix)[399];
  EXPECT_NEAR(length, 4 * EIGEN_PI * std::hypot(20, 3), 0.05);
  const PointList even = ResampleLine(helix, 1.5);
  EXPECT_EQ(even.row(0), helix.row(0));
  EXPECT_EQ(even.row(even.rows() - 1), helix.row(399));
  const Eigen::VectorXd lengths = ArcLengths(even);
  for (Eigen::Index point = 1; point < even.rows(); ++point)
  {
    EXPECT_NEAR(lengths[point] - lengths[point - 1], 1.5, 0.02);
  }
  // A zigzag goes, a straight line and the ends stay.
  PointList zigzag(50, 3);
  for (int point = 0; point < 50; ++point)
  {
    zigzag.row(point) << point, point % 2 == 0 ? 0.5 : -0.5, 0;
  }
  const PointList smooth = SmoothLine(zigzag, 2);
  EXPECT_EQ(smooth.row(0), zigzag.row(0));
  EXPECT_EQ(smooth.row(49), zigzag.row(49));
  for (int point = 8; point < 42; ++point)
  {
    EXPECT_NEAR(smooth(point, 0), point, 1e-9);
    EXPECT_NEAR(smooth(point, 1), 0, 0.01);
  }
}

TEST(Polyline, MediansAndAverages)
{
  Eigen::VectorXd values = Eigen::VectorXd::Constant(20, 3);
  values[10] = 100;
  EXPECT_EQ(MedianAlong(values, 2), Eigen::VectorXd::Constant(20, 3));
  const Eigen::VectorXd constant = Eigen::VectorXd::Constant(20, 3);
  EXPECT_TRUE(SmoothAlong(constant, 2).isApprox(constant));
}
