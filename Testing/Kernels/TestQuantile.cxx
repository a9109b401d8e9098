// Quantiles of few values, by hand.
#include "Quantile.h"

#include <gtest/gtest.h>

using namespace FlipFree;

TEST(Quantile, IsTheLesserOfTwo)
{
  std::vector<float> values{ 5, 1, 4, 2, 3 };
  EXPECT_EQ(TakeQuantile(values, 0), 1);
  EXPECT_EQ(TakeQuantile(values, 0.5), 3);
  EXPECT_EQ(TakeQuantile(values, 0.74), 3);
  EXPECT_EQ(TakeQuantile(values, 0.75), 4);
  EXPECT_EQ(TakeQuantile(values, 1), 5);
  std::vector<double> even{ 2, 1 };
  EXPECT_EQ(TakeQuantile(even, 0.5), 1);
}

TEST(Quantile, TheMedianIsTheGreaterOfTwo)
{
  std::vector<double> values{ 4, 1, 3, 2 };
  EXPECT_EQ(TakeMedian(values), 3);
  values = { 7, 9, 8 };
  EXPECT_EQ(TakeMedian(values), 8);
  values = { 6 };
  EXPECT_EQ(TakeMedian(values), 6);
}
