/**
 * The surface of an organ that is given voxel by voxel.
 */
#ifndef FlipFreeFieldSurface_h
#define FlipFreeFieldSurface_h

#include "Image/BitMask.h"
#include "Mesh/SurfaceVoxelization.h"

namespace FlipFree
{

struct FieldSurface
{
  PointList Points;
  TriangleList Triangles;
};

/// The closed surface on which a field changes its sign, by VTK's flying edges, in physical
/// millimeters under any direction matrix, counter-clockwise seen from where it is negative. The
/// field counts as negative outside the grid. Empty if it is positive nowhere.
FieldSurface SurfaceOfField(const ImageView<float>& field);

/// The voxels of the grid's positive field as runs in the image that the grid, a crop of it, is
/// part of; `first` is the image's index of the grid's first voxel.
std::vector<VoxelRun> RunsOfField(const ImageView<float>& field, const std::array<int, 3>& first);

/// 1 in the mask, -1 elsewhere.
std::vector<float> FieldOfMask(const BitMask& mask);

} // namespace FlipFree

#endif
