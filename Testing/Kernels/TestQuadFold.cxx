#include "BruteForceMotion.h"
#include "Guard/QuadFold.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

const Hull Quad{ { 0, 1, 2, 3 } };

PointList UnitSquare()
{
  PointList square(4, 3);
  square << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  return square;
}

} // namespace

TEST(QuadFold, ByShape)
{
  EXPECT_FALSE(IsFolded(UnitSquare(), Quad));
  PointList bent = UnitSquare();
  bent(2, 2) = 0.9; // by less than 90 degrees between its triangles
  EXPECT_FALSE(IsFolded(bent, Quad));
  PointList notConvex = UnitSquare();
  notConvex.row(2) << 0.4, 0.4, 0;
  EXPECT_TRUE(IsFolded(notConvex, Quad));
  PointList closed = UnitSquare(); // the last triangle folded back over the first
  closed.row(3) << 0.9, 0.1, 0.2;
  EXPECT_TRUE(IsFolded(closed, Quad));
  PointList crossed = UnitSquare();
  crossed.row(1).swap(crossed.row(2));
  EXPECT_TRUE(IsFolded(crossed, Quad));
  EXPECT_TRUE(IsFolded(PointList::Zero(4, 3), Quad));
}

// Until the time that is returned, no sample of the motion is folded; and that time is not
// wasteful.
TEST(QuadFold, TimesAreSafeAndTight)
{
  std::mt19937 random(1);
  int folds = 0;
  int early = 0;
  for (int repeat = 0; repeat < 2000; ++repeat)
  {
    const PointList from = UnitSquare() + WhiteNoise(4, 0.3, random);
    const PointList to = from + WhiteNoise(4, 0.2 * (1 + repeat % 5), random);
    const double time = TimeOfFold({ from, to }, Quad);
    if (IsBackward(from, Quad.data()))
    {
      EXPECT_EQ(time, 1);
      continue;
    }
    double firstFold = 1;
    for (int step = 400; step > 0; --step)
    {
      const double at = step / 400.0;
      firstFold = IsBackward((1 - at) * from + at * to, Quad.data()) ? at : firstFold;
    }
    EXPECT_LE(time, firstFold);
    folds += firstFold < 1 ? 1 : 0;
    early += time < firstFold - 0.05 ? 1 : 0;
  }
  EXPECT_GT(folds, 300);
  EXPECT_LT(early, 20);
}

TEST(QuadFold, RestAndCommonMotionNeverFold)
{
  const PointList square = UnitSquare();
  EXPECT_EQ(TimeOfFold({ square, square }, Quad), 1);
  const PointList shifted = square.array() + 100;
  EXPECT_EQ(TimeOfFold({ square, shifted }, Quad), 1);
}

// However long the motion is, compared with the quad.
TEST(QuadFold, LongMotionsAreNotTakenForFoldedStarts)
{
  const PointList square = UnitSquare();
  for (double height : { 10.0, 100.0, 1000.0, 1e5 })
  {
    PointList moved = square;
    moved.col(2) << 0, height, -height, height;
    EXPECT_LT(TimeOfFold({ square, moved }, Quad), 1) << height;
  }
}
