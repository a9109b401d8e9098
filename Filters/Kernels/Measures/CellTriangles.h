/**
 * How the boundary of a set of voxels runs through a cell, the cube between the centers of eight
 * voxels: marching cubes (W. Lorensen and H. Cline, 1987) without joining voxels across the
 * diagonal of a face, so that the boundaries of neighboring cells fit together. The cuts into
 * triangles are those that VTK makes, found by giving it each of the 256 cells, so that measures
 * agree.
 */
#ifndef FlipFreeCellTriangles_h
#define FlipFreeCellTriangles_h

#include <array>
#include <string_view>

namespace FlipFree
{

/// An edge of a cell; a triangle's corner lies in its middle.
struct CellEdge
{
  int Axis;                 ///< along which it runs
  std::array<int, 3> Begin; ///< the corner where it begins, 0 or 1 along each axis
};

/// The edges by their digits, 0 to 9, a and b.
inline const CellEdge& EdgeOfDigit(char digit)
{
  static constexpr std::array<CellEdge, 12> edges{ {
    { 0, { { 0, 0, 0 } } },
    { 0, { { 0, 1, 0 } } },
    { 0, { { 0, 0, 1 } } },
    { 0, { { 0, 1, 1 } } },
    { 1, { { 0, 0, 0 } } },
    { 1, { { 1, 0, 0 } } },
    { 1, { { 0, 0, 1 } } },
    { 1, { { 1, 0, 1 } } },
    { 2, { { 0, 0, 0 } } },
    { 2, { { 1, 0, 0 } } },
    { 2, { { 0, 1, 0 } } },
    { 2, { { 1, 1, 0 } } },
  } };
  return edges[digit <= '9' ? digit - '0' : digit - 'a' + 10];
}

/// Three digits of edges per triangle, counter-clockwise seen from outside. Bit x + 2 y + 4 z of
/// `inside` says whether the voxel at that corner is in the set.
std::string_view TrianglesOfCell(unsigned int inside);

} // namespace FlipFree

#endif
