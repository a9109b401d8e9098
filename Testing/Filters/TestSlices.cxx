// Adapters that process an image a few slices at a time.
#include "../Kernels/ExampleSurfaces.h"
#include "ExecutionAdapter.h"
#include "Image/FiniteVoxels.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace FlipFree;

// So many that no two slices share a batch.
constexpr std::ptrdiff_t VoxelsOfSlice = 1 << 22;

std::size_t QuestionsFor(std::ptrdiff_t slices)
{
  return (slices + NumberOfThreads() - 1) / NumberOfThreads();
}

} // namespace

TEST(SMPForSlices, VisitsEachSliceOnceAndReportsBetweenThem)
{
  constexpr std::ptrdiff_t first = 3;
  constexpr std::ptrdiff_t last = 40;
  std::vector<std::atomic<int>> visits(last);
  std::vector<double> fractions;
  const auto ask = [&fractions](double fraction)
  {
    fractions.push_back(fraction);
    return true;
  };
  const auto visit = [&visits](std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    for (std::ptrdiff_t slice = begin; slice < end; ++slice)
    {
      ++visits[slice];
    }
  };
  EXPECT_TRUE(SMPForSlices(first, last, VoxelsOfSlice, ask, visit));
  for (std::ptrdiff_t slice = 0; slice < last; ++slice)
  {
    EXPECT_EQ(visits[slice], slice < first ? 0 : 1) << slice;
  }
  ASSERT_EQ(fractions.size(), QuestionsFor(last - first));
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_LT(fractions.back(), 1);
  for (std::size_t question = 1; question < fractions.size(); ++question)
  {
    EXPECT_GT(fractions[question], fractions[question - 1]);
  }
}

TEST(SMPForSlices, StopsAtAnyReport)
{
  const std::ptrdiff_t slices = 5 * static_cast<std::ptrdiff_t>(NumberOfThreads());
  for (int stop = 1; stop <= 5; ++stop)
  {
    int asked = 0;
    std::atomic<std::ptrdiff_t> visited{ 0 };
    EXPECT_FALSE(SMPForSlices(
      0, slices, VoxelsOfSlice, [&](double) { return ++asked < stop; },
      [&visited](std::ptrdiff_t begin, std::ptrdiff_t end) { visited += end - begin; }));
    EXPECT_EQ(asked, stop);
    EXPECT_EQ(visited, (stop - 1) * NumberOfThreads());
  }
}

// With more voxels than are checked between two reports.
TEST(RequireFiniteAs, NamesTheFirstBadVoxelAndStops)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 256, 256, 80 } };
  std::vector<float> voxels(geometry.NumberOfVoxels(), 1.0F);
  const ImageView<float> image{ voxels.data(), geometry };
  const auto check = [&](const Monitor& monitor)
  {
    return RequireFiniteAs<float>(image, WholeBox(geometry), "it", "mend it", SMPThreading(),
      monitor);
  };
  EXPECT_TRUE(check(NeverStop));

  voxels[geometry.Offset(7, 9, 77)] = std::numeric_limits<float>::infinity();
  voxels[geometry.Offset(8, 9, 71)] = std::numeric_limits<float>::quiet_NaN();
  const std::string error = ErrorOf([&] { check(NeverStop); });
  EXPECT_NE(error.find("a voxel of it, at (8, 9, 71) mm"), std::string::npos) << error;
  int asked = 0;
  EXPECT_FALSE(check([&asked](double) { return ++asked < 2; })); // before the slices that are bad
  EXPECT_EQ(asked, 2);
}
