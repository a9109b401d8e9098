#include "LabelSurface/LabelCells.h"

namespace FlipFree
{
namespace
{

using CornerLabels = std::array<int, 8>;

// The corners that are reached from the first one in the mask, along edges between such.
bool IsConnected(unsigned int corners)
{
  unsigned int reached = corners & (~corners + 1);
  for (int step = 0; step < 8; ++step)
  {
    const unsigned int along = (reached & 0x55) << 1 | (reached & 0xaa) >> 1 |
      (reached & 0x33) << 2 | (reached & 0xcc) >> 2 | (reached & 0x0f) << 4 | (reached & 0xf0) >> 4;
    reached |= along & corners;
  }
  return reached == corners;
}

std::array<bool, 256> ListSimple()
{
  std::array<bool, 256> simple{};
  for (unsigned int corners = 0; corners < 256; ++corners)
  {
    simple[corners] = IsConnected(corners) && IsConnected(~corners & 0xff);
  }
  return simple;
}

CornerLabels CornersOf(const LabelGrid& grid, const std::array<int, 3>& cell)
{
  CornerLabels labels;
  for (int corner = 0; corner < 8; ++corner)
  {
    labels[corner] = grid.Labels[grid.Offset(cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1),
      cell[2] + (corner >> 2))];
  }
  return labels;
}

unsigned char MaskOf(const CornerLabels& labels, int label)
{
  unsigned int mask = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    mask |= static_cast<unsigned int>(labels[corner] == label) << corner;
  }
  return static_cast<unsigned char>(mask);
}

bool HasOneVertex(const CornerLabels& labels)
{
  unsigned int done = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    if ((done >> corner & 1) == 0)
    {
      const unsigned char mask = MaskOf(labels, labels[corner]);
      if (!IsSimple(mask))
      {
        return false;
      }
      done |= mask;
    }
  }
  return true;
}

int MostFrequent(const CornerLabels& labels)
{
  int best = labels[0];
  std::ptrdiff_t most = 0;
  for (const int label : labels)
  {
    const std::ptrdiff_t count = std::count(labels.begin(), labels.end(), label);
    if (count > most || (count == most && label == 0))
    {
      best = label;
      most = count;
    }
  }
  return best;
}

bool HasLabelOnSide(const CornerLabels& labels, int side, int label)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    if ((corner >> side / 2 & 1) == side % 2 && labels[corner] == label)
    {
      return true;
    }
  }
  return false;
}

void ListCells(const LabelGrid& grid, int j, int k, std::vector<int>& cells)
{
  const LabelGrid::Index* const rows[4] = { &grid.Labels[grid.Offset(0, j, k)],
    &grid.Labels[grid.Offset(0, j + 1, k)], &grid.Labels[grid.Offset(0, j, k + 1)],
    &grid.Labels[grid.Offset(0, j + 1, k + 1)] };
  // Blocks in which nothing differs, which are most, are passed over by code without branches.
  constexpr int Block = 32;
  const int count = grid.Size[0] - 1;
  for (int begin = 0; begin < count; begin += Block)
  {
    const int end = std::min(begin + Block, count);
    const int label = rows[0][begin];
    int different = 0;
    for (const LabelGrid::Index* row : rows)
    {
      for (int i = begin; i <= end; ++i)
      {
        different |= row[i] ^ label;
      }
    }
    if (different == 0)
    {
      continue;
    }
    for (int i = begin; i < end; ++i)
    {
      const int first = rows[0][i];
      if (first != rows[0][i + 1] || first != rows[1][i] || first != rows[1][i + 1] ||
        first != rows[2][i] || first != rows[2][i + 1] || first != rows[3][i] ||
        first != rows[3][i + 1])
      {
        cells.push_back(i);
      }
    }
  }
}

} // namespace

bool IsSimple(unsigned char corners)
{
  static const std::array<bool, 256> simple = ListSimple();
  return simple[corners];
}

LabelCells::LabelCells(const LabelGrid& grid, const ParallelFor& parallelFor)
{
  this->Grid.Build(
    { { grid.Size[0] - 1, grid.Size[1] - 1, grid.Size[2] - 1 } },
    [&grid](int j, int k, std::vector<int>& cells) { ListCells(grid, j, k, cells); }, parallelFor);
  this->Labels.resize(this->Grid.NumberOfPlaces());
  parallelFor(0, this->Grid.NumberOfPlaces(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t cell = first; cell < last; ++cell)
      {
        const auto labels = CornersOf(grid, this->Grid.PlaceOf(static_cast<int>(cell)));
        this->Labels[cell] = HasOneVertex(labels) ? OnWalls : MostFrequent(labels);
      }
    });

  std::vector<int> queue;
  for (int cell = 0; cell < this->Grid.NumberOfPlaces(); ++cell)
  {
    if (this->Labels[cell] != OnWalls)
    {
      queue.push_back(cell);
    }
  }
  for (std::size_t head = 0; head < queue.size(); ++head)
  {
    const auto labels = CornersOf(grid, this->Grid.PlaceOf(queue[head]));
    for (int side = 0; side < 6; ++side)
    {
      const int neighbor = this->Neighbor(queue[head], side);
      if (neighbor >= 0 && this->Labels[neighbor] == OnWalls &&
        !HasLabelOnSide(labels, side, this->Labels[queue[head]]))
      {
        this->Labels[neighbor] = MostFrequent(CornersOf(grid, this->Grid.PlaceOf(neighbor)));
        queue.push_back(neighbor);
      }
    }
  }
}

} // namespace FlipFree
