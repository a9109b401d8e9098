#include "LabelSurface/SimpleVoxel.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace FlipFree
{
namespace
{

// The 27 voxels around one, and which are next to each other by a face, or by an edge or corner
// too.
struct Neighborhood
{
  Neighborhood()
  {
    for (int one = 0; one < 27; ++one)
    {
      for (int two = 0; two < 27; ++two)
      {
        const int steps[3] = { std::abs(one % 3 - two % 3), std::abs(one / 3 % 3 - two / 3 % 3),
          std::abs(one / 9 - two / 9) };
        const int sum = steps[0] + steps[1] + steps[2];
        const bool isNear = std::max({ steps[0], steps[1], steps[2] }) == 1;
        this->ByFace[one] |= static_cast<unsigned int>(sum == 1) << two;
        this->ByCorner[one] |= static_cast<unsigned int>(isNear) << two;
        if (one == 13 && isNear && sum <= 2)
        {
          this->WithoutCorners |= 1U << two;
        }
      }
    }
  }

  std::array<unsigned int, 27> ByFace{};
  std::array<unsigned int, 27> ByCorner{};
  unsigned int WithoutCorners = 0;
};

// Whether all voxels of `seeds`, some of `set`, are connected within the set, and there is one.
bool AreOnePiece(unsigned int seeds, unsigned int set, const std::array<unsigned int, 27>& adjacent)
{
  unsigned int reached = seeds & (~seeds + 1);
  unsigned int front = reached;
  while (front != 0)
  {
    unsigned int next = 0;
    for (int voxel = 0; voxel < 27; ++voxel)
    {
      if ((front >> voxel & 1) != 0)
      {
        next |= adjacent[voxel];
      }
    }
    front = next & set & ~reached;
    reached |= front;
  }
  return seeds != 0 && (seeds & ~reached) == 0;
}

unsigned int OthersThan(unsigned int neighbors)
{
  return ~neighbors & ((1U << 27) - 1) & ~CenterVoxel;
}

// With `set` connected across faces.
bool IsSimple(unsigned int set, unsigned int rest)
{
  static const Neighborhood around;
  const unsigned int sides = around.ByFace[13];
  return AreOnePiece(rest, rest, around.ByCorner) &&
    AreOnePiece(set & sides, set & around.WithoutCorners, around.ByFace);
}

} // namespace

bool IsSimpleAcrossFaces(unsigned int neighbors)
{
  return IsSimple(neighbors, OthersThan(neighbors));
}

bool IsSimpleVoxel(unsigned int neighbors)
{
  const unsigned int others = OthersThan(neighbors);
  return IsSimple(neighbors, others) && IsSimple(others, neighbors);
}

} // namespace FlipFree
