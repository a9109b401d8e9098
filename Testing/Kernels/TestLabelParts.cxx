// What labels are joined where they touch, by independent counts, and which of their parts get no
// surface.
#include "LabelSurface/LabelParts.h"

#include "Error.h"
#include "ExampleLabelMaps.h"

#include <deque>
#include <set>

using namespace FlipFree;

namespace
{

LabelGrid GridOf(const LabelMap& map)
{
  return MakeLabelGrid(map.View(), {}, "the label map", SerialFor);
}

using Place = std::array<int, 3>;

Place Sum(const Place& a, const Place& b)
{
  return { { a[0] + b[0], a[1] + b[1], a[2] + b[2] } };
}

// A label's voxels and the cells that have the label, as the rule of LabelCells.h joins them.
class Solid
{
public:
  Solid(const LabelGrid& grid, const LabelCells& cells, int label)
    : Grid(grid)
    , Cells(cells)
    , Label(label)
  {
  }

  // Of voxels joined by faces: voxels, less pairs, plus squares of four, less cubes of eight. On
  // top of that, each cell that has the label makes a cone over what its corners have, and two such
  // cells side by side fill what is between them.
  int EulerNumber() const
  {
    int number = 0;
    this->ForEachPlace(
      [&](const Place& place)
      {
        number += this->Has(place) ? 1 : 0;
        for (int axis = 0; axis < 3; ++axis)
        {
          number -= this->HasAll(place, { Step(axis) }) ? 1 : 0;
          number += this->HasAll(place, this->Square((axis + 1) % 3, (axis + 2) % 3)) ? 1 : 0;
        }
        number -= this->HasAll(place, Corners()) ? 1 : 0;
        if (this->CellHas(place))
        {
          number += 1 - this->EulerOfCorners(place);
          for (int axis = 0; axis < 3; ++axis)
          {
            number -= this->CellHas(Sum(place, Step(axis))) ? this->GapAcross(place, axis) : 0;
          }
        }
      });
    return number;
  }

  int NumberOfParts() const
  {
    int parts = 0;
    std::set<Place> seen; // twice the index; odd ones are cells
    this->ForEachPlace(
      [&](const Place& place)
      {
        const Place start = Twice(place);
        if (!this->Has(place) || !seen.insert(start).second)
        {
          return;
        }
        ++parts;
        std::deque<Place> front{ start };
        while (!front.empty())
        {
          const Place node = front.front();
          front.pop_front();
          for (const Place& next : NeighborsOf(node))
          {
            if (this->HasNode(next) && seen.insert(next).second)
            {
              front.push_back(next);
            }
          }
        }
      });
    return parts;
  }

private:
  static Place Step(int axis)
  {
    Place step{ { 0, 0, 0 } };
    step[axis] = 1;
    return step;
  }
  static Place Twice(const Place& place) { return Sum(place, place); }
  static std::vector<Place> Corners()
  {
    std::vector<Place> corners;
    for (int corner = 1; corner < 8; ++corner)
    {
      corners.push_back({ { corner & 1, corner >> 1 & 1, corner >> 2 } });
    }
    return corners;
  }
  static std::vector<Place> Square(int one, int two)
  {
    return { Step(one), Step(two), Sum(Step(one), Step(two)) };
  }

  // Voxels and cells are next to their like by faces, and to each other by corners.
  static std::vector<Place> NeighborsOf(const Place& node)
  {
    std::vector<Place> neighbors;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Place step = Twice(Step(axis));
      neighbors.push_back(Sum(node, step));
      neighbors.push_back({ { node[0] - step[0], node[1] - step[1], node[2] - step[2] } });
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      neighbors.push_back(
        Sum(node, { { 2 * (corner & 1) - 1, 2 * (corner >> 1 & 1) - 1, 2 * (corner >> 2) - 1 } }));
    }
    return neighbors;
  }

  template <typename Visit>
  void ForEachPlace(const Visit& visit) const
  {
    for (int k = 0; k < this->Grid.Size[2]; ++k)
    {
      for (int j = 0; j < this->Grid.Size[1]; ++j)
      {
        for (int i = 0; i < this->Grid.Size[0]; ++i)
        {
          visit(Place{ { i, j, k } });
        }
      }
    }
  }

  bool Has(const Place& voxel) const
  {
    const auto& size = this->Grid.Size;
    return voxel[0] >= 0 && voxel[1] >= 0 && voxel[2] >= 0 && voxel[0] < size[0] &&
      voxel[1] < size[1] && voxel[2] < size[2] &&
      this->Grid.Labels[this->Grid.Offset(voxel[0], voxel[1], voxel[2])] == this->Label;
  }
  bool HasAll(const Place& voxel, const std::vector<Place>& steps) const
  {
    return this->Has(voxel) &&
      std::all_of(steps.begin(), steps.end(),
        [&](const Place& step) { return this->Has(Sum(voxel, step)); });
  }
  bool CellHas(const Place& cell) const
  {
    const int found = this->Cells.Grid.Find(cell[0], cell[1], cell[2]);
    return found >= 0 && this->Cells.Labels[found] == this->Label;
  }
  bool HasNode(const Place& node) const
  {
    const bool isCell = (node[0] & 1) != 0;
    const Place place{ { node[0] >> 1, node[1] >> 1, node[2] >> 1 } };
    return isCell ? this->CellHas(place) : this->Has(place);
  }

  // Of the corners, edges and sides of a cell that have the label.
  int EulerOfCorners(const Place& cell) const
  {
    int number = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Place at = Sum(cell, { { corner & 1, corner >> 1 & 1, corner >> 2 } });
      number += this->Has(at) ? 1 : 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int one = (axis + 1) % 3;
        const int two = (axis + 2) % 3;
        number -= (corner >> axis & 1) == 0 && this->HasAll(at, { Step(axis) }) ? 1 : 0;
        const bool isLow = (corner >> one & 1) == 0 && (corner >> two & 1) == 0;
        number += isLow && this->HasAll(at, Square(one, two)) ? 1 : 0;
      }
    }
    return number;
  }

  // Between the centers of this cell and the next one along an axis: one minus the Euler number of
  // the corners and edges of their side; none where the whole side has the label.
  int GapAcross(const Place& cell, int axis) const
  {
    const Place corner = Sum(cell, Step(axis));
    const int one = (axis + 1) % 3;
    const int two = (axis + 2) % 3;
    if (this->HasAll(corner, Square(one, two)))
    {
      return 0;
    }
    const Place far = Sum(Step(one), Step(two));
    int number = 0;
    for (const Place& step : { Place{ { 0, 0, 0 } }, Step(one), Step(two), far })
    {
      number += this->Has(Sum(corner, step)) ? 1 : 0;
    }
    number -= this->HasAll(corner, { Step(one) }) ? 1 : 0;
    number -= this->HasAll(corner, { Step(two) }) ? 1 : 0;
    number -= this->HasAll(Sum(corner, Step(one)), { Step(two) }) ? 1 : 0;
    number -= this->HasAll(Sum(corner, Step(two)), { Step(one) }) ? 1 : 0;
    return 1 - number;
  }

  const LabelGrid& Grid;
  const LabelCells& Cells;
  const int Label;
};

// A closed surface has twice the Euler number of what it encloses.
void ExpectEulerNumbersOfSolids(const LabelMap& map)
{
  const LabelGrid grid = GridOf(map);
  const LabelCells cells(grid, SerialFor);
  for (const LabelMeasures& measures : SurfacesOf(map, ExactSettings(0)).Measures)
  {
    const auto label = std::lower_bound(grid.Values.begin(), grid.Values.end(), measures.Label);
    const Solid solid(grid, cells, static_cast<int>(label - grid.Values.begin()));
    EXPECT_EQ(measures.EulerNumber, 2 * solid.EulerNumber()) << measures.Label;
  }
}

LabelSurfaceSettings KeepingSettings(double smallestPart, bool fillCavities)
{
  LabelSurfaceSettings settings = ExactSettings(10);
  settings.SmallestPart = smallestPart;
  settings.FillCavities = fillCavities;
  return settings;
}

int LabelAt(const LabelGrid& grid, int i, int j, int k)
{
  return grid.Values[grid.At(i - grid.First[0], j - grid.First[1], k - grid.First[2])];
}

// A block of label 7 with a cavity, in which there is a voxel of label 9; another voxel of 9 in its
// wall; two of label 4 apart from it; and a large piece of 9.
LabelMap BlockWithParts()
{
  LabelMap map(20, 12, 12);
  for (int k = 1; k < 11; ++k)
  {
    for (int j = 1; j < 11; ++j)
    {
      for (int i = 1; i < 11; ++i)
      {
        const bool isInCavity = std::min({ i, j, k }) > 4 && std::max({ i, j, k }) < 8;
        map.At(i, j, k) = isInCavity ? 0 : 7;
      }
    }
  }
  map.At(6, 6, 6) = 9;
  map.At(2, 2, 2) = 9;
  map.At(13, 3, 3) = 4;
  map.At(14, 3, 3) = 4;
  for (int i = 13; i < 19; ++i)
  {
    map.At(i, 8, 8) = 9;
  }
  return map;
}

} // namespace

TEST(LabelParts, EulerNumbersAreThoseOfTheSolidsInAllCells)
{
  for (int code = 1; code < 6561; ++code)
  {
    LabelMap map(2, 2, 2);
    int rest = code;
    for (int& voxel : map.Voxels)
    {
      voxel = rest % 3;
      rest /= 3;
    }
    SCOPED_TRACE(code);
    ExpectEulerNumbersOfSolids(map);
  }
}

TEST(LabelParts, EulerNumbersAreThoseOfTheSolidsInNoise)
{
  std::mt19937 random(4);
  for (int run = 0; run < 40; ++run)
  {
    SCOPED_TRACE(run);
    ExpectEulerNumbersOfSolids(RandomMap(random, 3 + run % 5, 1 + run % 5));
  }
}

// What is joined depends on where labels are, not on which.
TEST(LabelParts, JointsDoNotDependOnTheValuesOfLabels)
{
  std::mt19937 random(6);
  for (int run = 0; run < 20; ++run)
  {
    const LabelMap map = RandomMap(random, 6, 2 + run % 5);
    std::vector<int> values{ 3, 40, 500, 6000, 70000, 800000 };
    std::shuffle(values.begin(), values.end(), random);
    LabelMap other = map;
    for (int& voxel : other.Voxels)
    {
      voxel = voxel == 0 ? 0 : values[voxel - 1];
    }
    const LabelGrid grids[2] = { GridOf(map), GridOf(other) };
    const LabelCells cells(grids[0], SerialFor);
    const LabelCells otherCells(grids[1], SerialFor);
    ASSERT_EQ(cells.Labels.size(), otherCells.Labels.size());
    int joints = 0;
    for (std::size_t cell = 0; cell < cells.Labels.size(); ++cell)
    {
      const int label = cells.Labels[cell];
      ASSERT_EQ(label == LabelCells::OnWalls, otherCells.Labels[cell] == LabelCells::OnWalls);
      if (label != LabelCells::OnWalls)
      {
        const int value = grids[0].Values[label];
        EXPECT_EQ(grids[1].Values[otherCells.Labels[cell]], value == 0 ? 0 : values[value - 1]);
        ++joints;
      }
    }
    EXPECT_GT(joints, 50);
    const LabelSurfaces surfaces = SurfacesOf(map, ExactSettings(0));
    std::map<int, LabelMeasures> others;
    for (const LabelMeasures& measures : SurfacesOf(other, ExactSettings(0)).Measures)
    {
      others[measures.Label] = measures;
    }
    for (const LabelMeasures& measures : surfaces.Measures)
    {
      const LabelMeasures& same = others[values[measures.Label - 1]];
      EXPECT_EQ(same.EulerNumber, measures.EulerNumber);
      EXPECT_EQ(same.Triangles, measures.Triangles);
      EXPECT_NEAR(same.Volume, measures.Volume, 1e-9);
    }
  }
}

TEST(LabelParts, AreThoseOfASearch)
{
  std::mt19937 random(8);
  for (int run = 0; run < 30; ++run)
  {
    const LabelGrid grid = GridOf(RandomMap(random, 3 + run % 6, 1 + run % 4));
    const LabelCells cells(grid, SerialFor);
    const LabelParts parts(grid, cells);
    const std::vector<std::size_t> voxels = CountLabels(grid, SerialFor);
    for (int label = 0; label < static_cast<int>(grid.Values.size()); ++label)
    {
      int count = 0;
      std::size_t sum = 0;
      for (const LabelParts::Part& part : parts.Parts)
      {
        count += part.Label == label ? 1 : 0;
        sum += part.Label == label ? part.Voxels : 0;
      }
      EXPECT_EQ(count, Solid(grid, cells, label).NumberOfParts()) << label;
      EXPECT_EQ(sum, voxels[label]) << label;
    }
  }
}

TEST(LabelParts, TakeTheLabelThatMostOfTheirFacesBorder)
{
  const LabelMap map = BlockWithParts();
  const LabelGrid grid = GridOf(map);
  const LabelGrid large = KeepParts(grid, { 3, false }, SerialFor);
  EXPECT_EQ(LabelAt(large, 6, 6, 6), 0); // the cavity's
  EXPECT_EQ(LabelAt(large, 5, 5, 5), 0);
  EXPECT_EQ(LabelAt(large, 2, 2, 2), 7);
  EXPECT_EQ(LabelAt(large, 13, 3, 3), 0);
  EXPECT_EQ(LabelAt(large, 15, 8, 8), 9);
  EXPECT_EQ(large.Values, grid.Values);

  const LabelGrid filled = KeepParts(grid, { 0, true }, SerialFor);
  EXPECT_EQ(LabelAt(filled, 5, 5, 5), 7);
  EXPECT_EQ(LabelAt(filled, 6, 6, 6), 9);

  // The voxel in the cavity waits for the cavity's label.
  const LabelGrid both = KeepParts(grid, { 3, true }, SerialFor);
  EXPECT_EQ(LabelAt(both, 5, 5, 5), 7);
  EXPECT_EQ(LabelAt(both, 6, 6, 6), 7);
}

TEST(LabelParts, ThatWouldGoAreGone)
{
  std::mt19937 random(9);
  for (int run = 0; run < 20; ++run)
  {
    LabelPartSettings settings;
    settings.SmallestPart = 1 + run % 12;
    settings.FillCavities = run % 2 == 0;
    const LabelGrid kept = KeepParts(GridOf(RandomMap(random, 9, 2)), settings, SerialFor);
    const LabelParts parts(kept, LabelCells(kept, SerialFor));
    EXPECT_EQ(parts.Parts.front().Label, 0);
    for (std::size_t part = 1; part < parts.Parts.size(); ++part)
    {
      EXPECT_TRUE(parts.Parts[part].Label == 0 ? !settings.FillCavities
                                               : parts.Parts[part].Voxels >= settings.SmallestPart);
    }
  }
}

// Walls are shared as ever, and what has changed is counted.
TEST(LabelParts, GetSurfacesWithoutThoseThatGo)
{
  LabelMap map = BlockWithParts();
  map.Geometry.Spacing = { 1, 1, 2 };
  for (const bool exact : { true, false })
  {
    LabelSurfaceSettings settings = KeepingSettings(5, true); // of 3 voxels
    settings.Exact = exact;
    const LabelSurfaces surfaces = SurfacesOf(map, settings);
    ExpectEmbedded(surfaces);
    ASSERT_EQ(surfaces.Measures.size(), 3U);
    EXPECT_EQ(surfaces.Measures[0].Triangles, 0); // label 4
    EXPECT_EQ(surfaces.Measures[0].WrongVoxels, 2U);
    EXPECT_EQ(surfaces.Measures[1].EulerNumber, 2);
    EXPECT_EQ(surfaces.Measures[2].EulerNumber, 2);
    EXPECT_EQ(surfaces.Measures[2].Voxels, 8U);
    if (exact)
    {
      EXPECT_EQ(surfaces.WrongVoxels, 2U + 27U + 1U);
    }
  }
  const LabelSurfaces all = SurfacesOf(map, KeepingSettings(0, false));
  EXPECT_EQ(all.WrongVoxels, 0U);
  EXPECT_EQ(all.Measures[2].EulerNumber, 6);
}

TEST(LabelParts, OfWhichNoneIsLargeEnoughAreRefused)
{
  const LabelMap map = BlockWithParts();
  const auto expect = [&map](double smallest, ErrorCode code, const std::string& words)
  {
    try
    {
      SurfacesOf(map, KeepingSettings(smallest, false));
      FAIL();
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.GetCode(), code);
      EXPECT_NE(error.GetText().find(words), std::string::npos) << error.GetText();
    }
  };
  expect(1001, ErrorCode::EmptyMask, "no part of any label has 1001 mm3; lower {SmallestPart}");
  expect(-1, ErrorCode::OutOfRange, "{SmallestPart} is -1 mm3; choose 0, to keep all, to 1e");
  expect(std::numeric_limits<double>::quiet_NaN(), ErrorCode::OutOfRange, "{SmallestPart} is nan");
}
