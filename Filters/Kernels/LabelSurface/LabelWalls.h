/**
 * The walls between the labels of a label map: the dual mesh of its grid, known as surface nets
 * (S. Gibson, Constrained elastic surface nets, 1998), with the rule of LabelCells where labels
 * touch by an edge or a corner. Here is its connectivity; where vertices lie is up to others.
 *
 * Between two neighboring voxels of different labels there is a wall of four corners, the vertices
 * of the four cells around. Around the center of a cell that has a label of its own, walls are
 * those of marching tetrahedra: triangles with corners on the edges between nodes (voxel centers
 * and cells' centers) of different labels, and inside of triangles and tetrahedra of three and four
 * labels.
 */
#ifndef FlipFreeLabelWalls_h
#define FlipFreeLabelWalls_h

#include "LabelSurface/LabelCells.h"

namespace FlipFree
{

/// A voxel's center, or a cell's center.
struct LatticeNode
{
  std::array<int, 3> Place{ { 0, 0, 0 } };
  bool IsCell = false;

  /// In the grid's indices.
  Eigen::Vector3d AtRest() const
  {
    return Eigen::Vector3d(this->Place[0], this->Place[1], this->Place[2]).array() +
      (this->IsCell ? 0.5 : 0.0);
  }
};

struct LabelWalls
{
  LabelWalls(const LabelGrid& grid, const LabelCells& cells, const ParallelFor& parallelFor);

  /// A vertex in the mean of others, which are on edges.
  struct Mean
  {
    int Count = 0;
    std::array<int, 6> Of{};
  };

  /// The pair of voxels that a wall of four corners separates, on the two ends of an edge.
  struct VoxelPair
  {
    int Cell = 0; ///< the one whose first corner is the lower voxel
    signed char Axis = 0;
    bool IsReversed = false; ///< the first label is that of the upper voxel
  };

  /// The nodes of the two voxels of a wall, that of its first label first.
  std::array<LatticeNode, 2> NodesOf(const VoxelPair& pair, const LabelCells& cells) const;

  int NumberOfVertices() const
  {
    return static_cast<int>(this->Cells.size() + this->Edges.size() + this->Means.size());
  }
  int FirstEdge() const { return static_cast<int>(this->Cells.size()); }
  int FirstMean() const { return static_cast<int>(this->Cells.size() + this->Edges.size()); }

  // The vertices, in this order: in cells, on edges between nodes, and in means.
  std::vector<int> Cells;
  std::vector<std::array<LatticeNode, 2>> Edges;
  std::vector<Mean> Means;
  std::vector<int> VertexOfCell; ///< -1 for cells with a label

  // The walls, counter-clockwise seen from the second label, in the frame of the grid's indices.
  // Of the two labels, background is the second, or else the greater one.
  std::vector<std::array<int, 4>> Quads;
  std::vector<std::array<int, 2>> QuadLabels;
  std::vector<VoxelPair> QuadVoxels;
  std::vector<std::array<int, 3>> Triangles;
  std::vector<std::array<int, 2>> TriangleLabels;
};

} // namespace FlipFree

#endif
