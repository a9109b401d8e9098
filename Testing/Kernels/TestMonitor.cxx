// The hook by which kernels are stopped: monitors that remember that they were, and those of parts.
#include "KernelTypes.h"

#include <gtest/gtest.h>

#include <vector>

using namespace FlipFree;

namespace
{

// Says stop the third time it is asked, and then never again.
class StopOnce
{
public:
  const Monitor Ask = [this](double fraction)
  {
    this->Fractions.push_back(fraction);
    return this->Fractions.size() != 3;
  };
  std::vector<double> Fractions;
};

} // namespace

TEST(RememberingMonitor, AsksUntilItIsStopped)
{
  StopOnce monitor;
  const RememberingMonitor remembering(monitor.Ask);
  EXPECT_TRUE(remembering.Get()(0.25));
  EXPECT_TRUE(remembering.Get()(0.5));
  EXPECT_FALSE(remembering.HasStopped());
  EXPECT_FALSE(remembering.Get()(0.75));
  EXPECT_TRUE(remembering.HasStopped());
  EXPECT_FALSE(remembering.Get()(1));
  EXPECT_TRUE(remembering.HasStopped());
  EXPECT_EQ(monitor.Fractions, (std::vector<double>{ 0.25, 0.5, 0.75 }));
}

// Parts refer to the whole, so each sees a stop of another.
TEST(RememberingMonitor, StopsAllParts)
{
  StopOnce monitor;
  const RememberingMonitor remembering(monitor.Ask);
  const Monitor first = PartOf(remembering.Get(), 0, 0.5);
  const Monitor second = PartOf(remembering.Get(), 0.5, 1);
  EXPECT_TRUE(first(0));
  EXPECT_TRUE(second(0));
  EXPECT_FALSE(first(0.5));
  EXPECT_FALSE(second(1));
  EXPECT_TRUE(remembering.HasStopped());
  EXPECT_EQ(monitor.Fractions, (std::vector<double>{ 0, 0.5, 0.25 }));
}
