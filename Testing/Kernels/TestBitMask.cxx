#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

TEST(BitMask, HoldsWhatIsInsertedAndNothingElse)
{
  std::mt19937 random(1);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    const std::vector<unsigned char> bytes = RandomMask(geometry, 0.3, random);
    BitMask mask(geometry);
    EXPECT_EQ(mask.Count(), 0U);
    std::size_t voxel = 0;
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        if (bytes[voxel++])
        {
          mask.Insert(i, j, k);
        }
        ASSERT_EQ(mask(i, j, k), bytes[voxel - 1] != 0);
      });
    EXPECT_EQ(BytesOf(mask), bytes);
    EXPECT_EQ(mask, BitsOf(bytes, geometry));
    BitMask byOffset(geometry);
    for (std::size_t offset = 0; offset < bytes.size(); ++offset)
    {
      ASSERT_EQ(mask(offset), bytes[offset] != 0);
      if (bytes[offset])
      {
        byOffset.Insert(offset);
      }
    }
    EXPECT_EQ(byOffset, mask);
    EXPECT_EQ(mask.Count(), static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), 1)));
  }
}

TEST(BitMask, RunsAreOfAllVoxelsInTheirOrder)
{
  std::mt19937 random(4);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    for (const double part : { 0.0, 0.1, 0.5, 0.97, 1.0 })
    {
      const BitMask mask = BitsOf(RandomMask(geometry, part, random), geometry);
      std::vector<std::size_t> expected;
      mask.ForEach([&expected](std::size_t voxel) { expected.push_back(voxel); });
      ASSERT_TRUE(std::is_sorted(expected.begin(), expected.end()));
      std::vector<std::size_t> visited;
      const int middle = geometry.Dimensions[2] / 2;
      for (const auto& slices : { std::pair(0, middle), std::pair(middle, geometry.Dimensions[2]) })
      {
        mask.ForEachRun(slices.first, slices.second,
          [&](int begin, int end, int j, int k)
          {
            ASSERT_LT(begin, end);
            ASSERT_TRUE(slices.first <= k && k < slices.second);
            ASSERT_EQ(begin / BitMask::BitsOfWord, (end - 1) / BitMask::BitsOfWord);
            for (int i = begin; i < end; ++i)
            {
              visited.push_back(geometry.Offset(i, j, k));
            }
          });
      }
      ASSERT_EQ(visited, expected);
    }
  }
}

TEST(BitMask, RunsOfEveryPlaceAndLength)
{
  const ImageGeometry geometry = Grid({ { 130, 2, 2 } }, { 1, 1, 1 });
  for (int begin = 0; begin < 130; ++begin)
  {
    for (int end = begin; end <= 130; ++end)
    {
      BitMask run(geometry);
      run.InsertRun(begin, end, 1, 0);
      BitMask expected(geometry);
      for (int i = begin; i < end; ++i)
      {
        expected.Insert(i, 1, 0);
      }
      ASSERT_EQ(run, expected) << begin << " to " << end;
      const auto length = static_cast<std::size_t>(end - begin);
      ASSERT_EQ(run.CountRun(0, 130, 1, 0), length);
      ASSERT_EQ(run.CountRun(begin, end, 1, 0), length);
      ASSERT_EQ(run.CountRun(0, begin, 1, 0) + run.CountRun(end, 130, 1, 0), 0U);
      BitMask rest(geometry);
      rest.Complement();
      rest.RemoveRun(begin, end, 1, 0);
      expected.Complement();
      ASSERT_EQ(rest, expected) << begin << " to " << end;
    }
  }
}

TEST(BitMask, TakesRunsOfALargerGrid)
{
  struct Run
  {
    int J, K, Begin, End;
  };
  const std::vector<Run> runs{ { 3, 4, 5, 75 }, { 4, 4, 9, 10 }, { 6, 7, 70, 79 } };
  const ImageGeometry geometry = Grid({ { 90, 10, 9 } }, { 1, 1, 1 });
  BitMask all(geometry);
  all.InsertRuns(runs);
  EXPECT_EQ(all.Count(), 80U);
  const VoxelBox box{ { { 5, 3, 4 } }, { { 80, 8, 8 } } };
  BitMask part(CropGeometry(geometry, box));
  part.InsertRuns(runs, box.Begin);
  EXPECT_EQ(part, all.Cropped(box));
}

TEST(BitMask, PaddingIsCleared)
{
  std::mt19937 random(6);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    const BitMask mask = BitsOf(RandomMask(geometry, 0.5, random), geometry);
    BitMask beyond = mask;
    for (int k = 0; k < geometry.Dimensions[2]; ++k)
    {
      for (int j = 0; j < geometry.Dimensions[1]; ++j)
      {
        beyond.Row(j, k)[mask.GetWordsPerRow() - 1] |= ~mask.GetLastWord();
      }
    }
    EXPECT_EQ(beyond == mask, mask.GetLastWord() == ~BitMask::Word(0));
    beyond.ClearPadding();
    EXPECT_EQ(beyond, mask);
  }
}

TEST(BitMask, ComplementAndRemovalStayWithinTheRows)
{
  std::mt19937 random(3);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    const std::vector<unsigned char> a = RandomMask(geometry, 0.5, random);
    const std::vector<unsigned char> b = RandomMask(geometry, 0.5, random);
    std::vector<unsigned char> notA = a;
    std::vector<unsigned char> onlyA = a;
    for (std::size_t voxel = 0; voxel < a.size(); ++voxel)
    {
      notA[voxel] = !a[voxel];
      onlyA[voxel] = a[voxel] && !b[voxel];
    }
    BitMask complement = BitsOf(a, geometry);
    complement.Complement();
    EXPECT_EQ(complement, BitsOf(notA, geometry));
    EXPECT_EQ(complement.Count() + BitsOf(a, geometry).Count(), geometry.NumberOfVoxels());
    BitMask difference = BitsOf(a, geometry);
    difference.Remove(BitsOf(b, geometry));
    EXPECT_EQ(difference, BitsOf(onlyA, geometry));
    BitMask onlyB = BitsOf(b, geometry);
    onlyB.Remove(BitsOf(a, geometry));
    difference.Unite(onlyB);
    EXPECT_EQ(DifferenceOf(BitsOf(a, geometry), BitsOf(b, geometry)), difference);
    EXPECT_EQ(BitMask(geometry, difference.GetWords()), difference);
  }
}
