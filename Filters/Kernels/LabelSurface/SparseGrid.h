/**
 * Some places of a grid, by rows: numbered in the order of the grid, and found by their indices.
 */
#ifndef FlipFreeSparseGrid_h
#define FlipFreeSparseGrid_h

#include "Error.h"
#include "KernelTypes.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace FlipFree
{

class SparseGrid
{
public:
  /// fill(j, k, places) appends the places of a row in ascending order. It is called from several
  /// threads.
  template <typename FillRow>
  void Build(const std::array<int, 3>& size, const FillRow& fill, const ParallelFor& parallelFor)
  {
    this->Size = size;
    const std::ptrdiff_t rows = static_cast<std::ptrdiff_t>(size[1]) * size[2];
    std::vector<std::vector<int>> slices(size[2]);
    this->RowBegin.assign(rows + 1, 0);
    parallelFor(0, size[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (int k = static_cast<int>(first); k < last; ++k)
        {
          for (int j = 0; j < size[1]; ++j)
          {
            const std::size_t before = slices[k].size();
            fill(j, k, slices[k]);
            this->RowBegin[static_cast<std::ptrdiff_t>(k) * size[1] + j + 1] =
              static_cast<int>(slices[k].size() - before);
          }
        }
      });
    std::size_t total = 0;
    for (const auto& slice : slices)
    {
      total += slice.size();
    }
    if (total > MaximumPlaces)
    {
      throw Error(ErrorCode::TooLarge,
        "labels differ at " + std::to_string(total) +
          " places, more than can be numbered; this is noise rather than a label map");
    }
    for (std::ptrdiff_t row = 0; row < rows; ++row)
    {
      this->RowBegin[row + 1] += this->RowBegin[row];
    }
    this->Places.resize(this->RowBegin.back());
    this->Rows.resize(this->RowBegin.back());
    parallelFor(0, size[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t k = first; k < last; ++k)
        {
          std::copy(slices[k].begin(), slices[k].end(),
            this->Places.begin() + this->RowBegin[k * size[1]]);
          for (std::ptrdiff_t row = k * size[1]; row < (k + 1) * size[1]; ++row)
          {
            std::fill(this->Rows.begin() + this->RowBegin[row],
              this->Rows.begin() + this->RowBegin[row + 1], static_cast<int>(row));
          }
        }
      });
  }

  const std::array<int, 3>& GetSize() const { return this->Size; }
  int NumberOfPlaces() const { return static_cast<int>(this->Places.size()); }
  std::array<int, 3> PlaceOf(int index) const
  {
    const int row = this->Rows[index];
    return { { this->Places[index], row % this->Size[1], row / this->Size[1] } };
  }
  /// -1 where there is none.
  int Find(int i, int j, int k) const
  {
    if (j < 0 || k < 0 || j >= this->Size[1] || k >= this->Size[2])
    {
      return -1;
    }
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(k) * this->Size[1] + j;
    const auto begin = this->Places.begin() + this->RowBegin[row];
    const auto end = this->Places.begin() + this->RowBegin[row + 1];
    const auto found = std::lower_bound(begin, end, i);
    return found != end && *found == i ? static_cast<int>(found - this->Places.begin()) : -1;
  }
  /// The places of a row, ascending.
  const int* Begin(int j, int k) const { return this->Places.data() + this->First(j, k); }
  const int* End(int j, int k) const { return this->Places.data() + this->First(j + 1, k); }
  /// The number of the first place of a row.
  int First(int j, int k) const
  {
    return this->RowBegin[static_cast<std::ptrdiff_t>(k) * this->Size[1] + j];
  }

private:
  // What is made of a place, up to a dozen faces of three corners, is to be numbered as well.
  static constexpr std::size_t MaximumPlaces = 50000000;

  std::array<int, 3> Size{ { 0, 0, 0 } };
  std::vector<int> RowBegin; // the last one is the number of places
  std::vector<int> Places;
  std::vector<int> Rows;
};

} // namespace FlipFree

#endif
