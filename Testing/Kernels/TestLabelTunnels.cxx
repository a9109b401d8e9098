// Which tunnels through labels are closed, and that nothing else changes.
#include "LabelSurface/LabelParts.h"
#include "LabelSurface/LabelTunnels.h"

#include "Error.h"
#include "ExampleLabelMaps.h"

#include <algorithm>
#include <deque>
#include <random>

using namespace FlipFree;

namespace
{

LabelGrid GridOf(const LabelMap& map)
{
  return MakeLabelGrid(map.View(), {}, "the label map", SerialFor);
}

LabelGrid Closed(const LabelMap& map, double width,
  const Eigen::Vector3d& spacing = Eigen::Vector3d::Ones())
{
  LabelGrid grid = GridOf(map);
  EXPECT_TRUE(CloseTunnels(grid, spacing, width, SerialFor, NeverStop));
  return grid;
}

// The voxels that changed, by their places in the map.
std::vector<std::array<int, 3>> Changes(const LabelMap& map, const LabelGrid& after)
{
  const LabelGrid before = GridOf(map);
  std::vector<std::array<int, 3>> changes;
  for (int k = 0; k < before.Size[2]; ++k)
  {
    for (int j = 0; j < before.Size[1]; ++j)
    {
      for (int i = 0; i < before.Size[0]; ++i)
      {
        if (before.At(i, j, k) != after.At(i, j, k))
        {
          changes.push_back({ { i + before.First[0], j + before.First[1], k + before.First[2] } });
        }
      }
    }
  }
  return changes;
}

// A block of label 1 with a tunnel along z, of which radius(k) says how wide it is: what lies
// nearer to the axis, in the greatest coordinate, is free.
template <typename Radius>
LabelMap BlockWithTunnel(const Radius& radius)
{
  LabelMap map(15, 15, 11);
  for (int k = 1; k < 10; ++k)
  {
    for (int j = 1; j < 14; ++j)
    {
      for (int i = 1; i < 14; ++i)
      {
        map.At(i, j, k) = std::max(std::abs(i - 7), std::abs(j - 7)) > radius(k) ? 1 : 0;
      }
    }
  }
  return map;
}

// Through the surface of the label 1: of its pieces and cavities, each but one of which would be a
// sphere, what the Euler number lacks.
int TunnelsOf(const LabelGrid& grid)
{
  const LabelParts parts(grid, LabelCells(grid, SerialFor));
  ImageGeometry geometry;
  geometry.Dimensions = grid.Size;
  const LabelSurfaces surfaces = MakeLabelSurfaces(grid, geometry, ExactSettings(0));
  return static_cast<int>(parts.Parts.size()) - 1 - surfaces.Measures.front().EulerNumber / 2;
}

// How many pieces the voxels are in that have a label, across faces, or that have none, across
// edges and corners, too.
int Pieces(const LabelGrid& grid, bool labeled)
{
  std::vector<bool> seen(grid.Labels.size());
  int pieces = 0;
  const auto take = [&](std::deque<std::array<int, 3>>& front, int i, int j, int k)
  {
    const bool isInside =
      i >= 0 && j >= 0 && k >= 0 && i < grid.Size[0] && j < grid.Size[1] && k < grid.Size[2];
    if (isInside && (grid.At(i, j, k) != 0) == labeled && !seen[grid.Offset(i, j, k)])
    {
      seen[grid.Offset(i, j, k)] = true;
      front.push_back({ { i, j, k } });
    }
  };
  for (std::size_t voxel = 0; voxel < seen.size(); ++voxel)
  {
    std::deque<std::array<int, 3>> front;
    const auto row = static_cast<int>(voxel / grid.Size[0]);
    take(front, static_cast<int>(voxel % grid.Size[0]), row % grid.Size[1], row / grid.Size[1]);
    pieces += front.empty() ? 0 : 1;
    while (!front.empty())
    {
      const auto [i, j, k] = front.front();
      front.pop_front();
      for (int code = 0; code < 27; ++code)
      {
        const std::array<int, 3> step{ { code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1 } };
        if (!labeled || std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) == 1)
        {
          take(front, i + step[0], j + step[1], k + step[2]);
        }
      }
    }
  }
  return pieces;
}

} // namespace

TEST(LabelTunnels, ATunnelIsClosedByASheetIfNoBallOfTheDiameterPasses)
{
  const LabelMap map = BlockWithTunnel([](int) { return 1; }); // 3 wide
  EXPECT_TRUE(Changes(map, Closed(map, 0)).empty());
  EXPECT_TRUE(Changes(map, Closed(map, 3)).empty());
  const auto sheet = Changes(map, Closed(map, 3.5));
  ASSERT_EQ(sheet.size(), 9);
  for (const std::array<int, 3>& voxel : sheet)
  {
    EXPECT_EQ(voxel[2], sheet.front()[2]);
    EXPECT_LE(std::max(std::abs(voxel[0] - 7), std::abs(voxel[1] - 7)), 1);
  }
}

TEST(LabelTunnels, WidthsAreMillimeters)
{
  const LabelMap map = BlockWithTunnel([](int) { return 1; });
  const Eigen::Vector3d spacing(0.5, 0.5, 2);
  EXPECT_TRUE(Changes(map, Closed(map, 1.5, spacing)).empty());
  EXPECT_EQ(Changes(map, Closed(map, 1.8, spacing)).size(), 9);
}

TEST(LabelTunnels, TheSheetLiesWhereTheTunnelIsNarrow)
{
  const LabelMap map = BlockWithTunnel([](int k) { return k == 6 ? 0 : 3; });
  const auto sheet = Changes(map, Closed(map, 2));
  ASSERT_EQ(sheet.size(), 1);
  EXPECT_EQ(sheet.front(), (std::array<int, 3>{ { 7, 7, 6 } }));
}

TEST(LabelTunnels, PitsCavitiesAndGapsAreNone)
{
  const LabelMap pit = BlockWithTunnel([](int k) { return k < 3 ? -1 : k > 7 ? 0 : 3; });
  EXPECT_TRUE(Changes(pit, Closed(pit, 100)).empty());
  const LabelMap cavity = BlockWithTunnel([](int k) { return k < 3 || k > 7 ? -1 : 3; });
  EXPECT_TRUE(Changes(cavity, Closed(cavity, 100)).empty());
  LabelMap gap = BlockWithTunnel([](int) { return 3; });
  for (int k = 1; k < 10; ++k)
  {
    for (int j = 8; j < 14; ++j)
    {
      gap.At(7, j, k) = 0;
    }
  }
  EXPECT_TRUE(Changes(gap, Closed(gap, 100)).empty());
}

TEST(LabelTunnels, WithAnotherLabelInTheirSheetStayOpen)
{
  LabelMap map = BlockWithTunnel([](int) { return 1; });
  for (int k = 0; k < 11; ++k)
  {
    map.At(7, 7, k) = 2;
  }
  EXPECT_TRUE(Changes(map, Closed(map, 100)).empty());
}

// A ring of another label in the tunnel, with a tunnel of its own.
TEST(LabelTunnels, OfSeveralLabelsAreClosedByTheirOwn)
{
  LabelMap map = BlockWithTunnel([](int k) { return k < 5 ? 2 : 0; });
  for (int j = 6; j < 9; ++j)
  {
    for (int i = 6; i < 9; ++i)
    {
      map.At(i, j, 2) = i == 7 && j == 7 ? 0 : 2;
    }
  }
  const LabelGrid closed = Closed(map, 1.5);
  const auto changes = Changes(map, closed);
  ASSERT_EQ(changes.size(), 2);
  for (const std::array<int, 3>& voxel : changes)
  {
    EXPECT_EQ(voxel[0], 7);
    EXPECT_EQ(voxel[1], 7);
    EXPECT_EQ(closed.At(7 - closed.First[0], 7 - closed.First[1], voxel[2] - closed.First[2]),
      voxel[2] == 2 ? 2 : 1);
  }
}

TEST(LabelTunnels, StayOpenWhereTheirSheetWouldJoinTwoPartsOfALabel)
{
  LabelMap map = BlockWithTunnel([](int k) { return k == 9 ? 0 : 3; });
  EXPECT_EQ(Changes(map, Closed(map, 1.5)).size(), 1);
  map.At(7, 7, 7) = 1;
  EXPECT_EQ(Changes(map, Closed(map, 1.5)).size(), 1);
  map.At(7, 7, 8) = 1;
  EXPECT_TRUE(Changes(map, Closed(map, 1.5)).empty());
}

// Six voxels around an axis of their cube: they touch by edges, too, where the surface joins them
// (LabelCells.h).
TEST(LabelTunnels, ThatTheSurfaceHasNotAreNone)
{
  LabelMap map(4, 4, 4);
  for (int code = 1; code < 7; ++code)
  {
    map.At(1 + (code & 1), 1 + (code >> 1 & 1), 1 + (code >> 2)) = 1;
  }
  EXPECT_EQ(SurfacesOf(map, ExactSettings(0)).Measures.front().EulerNumber, 2);
  EXPECT_TRUE(Changes(map, Closed(map, 100)).empty());
}

// Five of eight voxels join the last one with the others for the surfaces (LabelCells.h).
TEST(LabelTunnels, OfWhatIsJoinedByEdgesAloneAreNone)
{
  LabelMap map(6, 6, 6);
  for (int k = 1; k < 5; ++k)
  {
    for (int j = 1; j < 5; ++j)
    {
      for (int i = 1; i < 5; ++i)
      {
        map.At(i, j, k) = 1;
      }
    }
  }
  map.At(3, 4, 4) = map.At(4, 3, 4) = map.At(4, 4, 3) = 0;
  EXPECT_TRUE(Changes(map, Closed(map, 100)).empty());
}

TEST(LabelTunnels, AtTheBorderOfTheImageAreClosed)
{
  const LabelMap map = BlockWithTunnel([](int) { return 1; });
  LabelMap cropped(13, 13, 9);
  for (int k = 0; k < 9; ++k)
  {
    for (int j = 0; j < 13; ++j)
    {
      for (int i = 0; i < 13; ++i)
      {
        cropped.At(i, j, k) = LabelMap(map).At(i + 1, j + 1, k + 1);
      }
    }
  }
  EXPECT_EQ(Changes(cropped, Closed(cropped, 3.5)).size(), 9);
}

// Label 2 covers one mouth of the tunnel.
TEST(LabelTunnels, AreClosedBeforeCavitiesAreFilled)
{
  LabelMap map = BlockWithTunnel([](int k) { return k == 9 ? 0 : 2; });
  for (int j = 1; j < 14; ++j)
  {
    for (int i = 1; i < 14; ++i)
    {
      map.At(i, j, 0) = 2;
    }
  }
  LabelSurfaceSettings settings = ExactSettings(0);
  settings.FillTunnels = 1.5;
  settings.FillCavities = true;
  for (const LabelMeasures& measures : SurfacesOf(map, settings).Measures)
  {
    EXPECT_EQ(measures.EulerNumber, 2) << measures.Label;
  }
}

TEST(LabelTunnels, WithoutALimitHardlyAnyOfNoiseIsLeft)
{
  std::mt19937 random(7);
  int tunnelsBefore = 0;
  int tunnelsAfter = 0;
  for (int run = 0; run < 60; ++run)
  {
    LabelMap map(12, 11, 10);
    for (int& voxel : map.Voxels)
    {
      voxel = random() % 100 < 45 + static_cast<unsigned int>(run) ? 1 : 0;
    }
    // Of what is joined across faces, the piece around the middle.
    LabelMap piece(12, 11, 10);
    std::deque<std::array<int, 3>> front{ { { 6, 5, 5 } } };
    while (!front.empty())
    {
      const auto [i, j, k] = front.front();
      front.pop_front();
      if (std::min({ i, j, k }) < 0 || i > 11 || j > 10 || k > 9 || map.At(i, j, k) == 0)
      {
        continue;
      }
      map.At(i, j, k) = 0;
      piece.At(i, j, k) = 1;
      for (int side = 0; side < 6; ++side)
      {
        std::array<int, 3> next{ { i, j, k } };
        next[side / 2] += side % 2 == 0 ? 1 : -1;
        front.push_back(next);
      }
    }
    if (piece.At(6, 5, 5) == 0)
    {
      continue;
    }
    const LabelGrid before = GridOf(piece);
    const LabelGrid after = Closed(piece, 100);
    SCOPED_TRACE(run);
    EXPECT_EQ(Pieces(after, true), 1);
    EXPECT_EQ(Pieces(after, false), Pieces(before, false));
    tunnelsBefore += TunnelsOf(before);
    tunnelsAfter += TunnelsOf(after);
    EXPECT_LE(TunnelsOf(after), TunnelsOf(before));
  }
  EXPECT_GT(tunnelsBefore, 500);
  EXPECT_LT(tunnelsAfter, 0.05 * tunnelsBefore);
}

TEST(LabelTunnels, TellHowFarTheyAreAndStopAtAnyQuestion)
{
  LabelMap map(40, 40, 40);
  std::fill(map.Voxels.begin(), map.Voxels.end(), 1);
  for (int k = 0; k < 40; ++k)
  {
    for (int j = 10; j < 30; ++j)
    {
      std::fill_n(&map.At(10, j, k), 20, 0);
    }
  }
  const LabelGrid start = GridOf(map);
  const auto close = [&](const Monitor& monitor)
  {
    LabelGrid grid = start;
    return CloseTunnels(grid, Eigen::Vector3d::Ones(), 3.5, SerialFor, monitor);
  };
  std::vector<double> told;
  EXPECT_TRUE(close(
    [&](double fraction)
    {
      told.push_back(fraction);
      return true;
    }));
  ASSERT_GT(told.size(), 4);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_LE(told.back(), 1);
  for (std::size_t refused = 0; refused < told.size(); ++refused)
  {
    std::size_t questions = 0;
    EXPECT_FALSE(close([&](double) { return questions++ != refused; })) << refused;
  }
}

TEST(LabelTunnels, SurfacesHaveNoneThatAreNarrower)
{
  const LabelMap map = BlockWithTunnel([](int) { return 1; });
  LabelSurfaceSettings settings = ExactSettings(10);
  EXPECT_EQ(SurfacesOf(map, settings).Measures.front().EulerNumber, 0);
  settings.FillTunnels = 3.5;
  const LabelSurfaces closed = SurfacesOf(map, settings);
  EXPECT_EQ(closed.Measures.front().EulerNumber, 2);
  EXPECT_EQ(closed.WrongVoxels, 9);
  for (const double wrong : { -1.0, 1e7, std::numeric_limits<double>::quiet_NaN() })
  {
    settings.FillTunnels = wrong;
    EXPECT_THROW(SurfacesOf(map, settings), Error);
  }
}
