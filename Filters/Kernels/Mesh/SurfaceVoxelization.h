/**
 * The voxels inside a closed surface, by scan conversion in the image's index space.
 *
 * A voxel is inside if the winding number of the surface about its center is not zero; the overlap
 * of a self-intersecting surface is thus inside. Any origin, spacing and direction matrix will do.
 *
 * Each plane of voxels cuts the surface in closed polygons, whose corners are its crossings with
 * the edges of the mesh; each row of voxels enters and leaves these polygons equally often. A
 * crossing depends on the edge's end points only, and intervals include their lower bounds but not
 * their upper ones. So adjacent triangles count a crossing exactly once, and each voxel of two
 * organs that share a wall belongs to exactly one of them.
 */
#ifndef FlipFreeSurfaceVoxelization_h
#define FlipFreeSurfaceVoxelization_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

/// The voxels (i, J, K) with Begin <= i < End.
struct VoxelRun
{
  int J = 0;
  int K = 0;
  int Begin = 0;
  int End = 0;
};

/// The voxels of the image inside the surface, as maximal runs ordered by K, J, Begin; none when
/// the surface contains no voxel center. Returns false if the monitor stopped it; the runs are then
/// as they were. Throws Error when the surface is not closed and consistently oriented (either way
/// round), a point is not finite or lies more than 1e15 voxels away from the image, or the geometry
/// is singular.
bool VoxelizeSurface(const PointList& points, const TriangleList& triangles,
  const ImageGeometry& geometry, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<VoxelRun>& runs);

/// The same, without a stop.
std::vector<VoxelRun> VoxelizeSurface(const PointList& points, const TriangleList& triangles,
  const ImageGeometry& geometry, const ParallelFor& parallelFor = SerialFor);

std::size_t CountVoxels(const std::vector<VoxelRun>& runs);

bool HasVoxel(const std::vector<VoxelRun>& runs, const std::array<int, 3>& voxel);

/// Writes the label into the runs' voxels and leaves all others as they are.
template <typename T>
void FillRuns(const std::vector<VoxelRun>& runs, T label, const ImageGeometry& geometry, T* voxels)
{
  for (const VoxelRun& run : runs)
  {
    T* row = voxels + geometry.Offset(0, run.J, run.K);
    for (int i = run.Begin; i < run.End; ++i)
    {
      row[i] = label;
    }
  }
}

} // namespace FlipFree

#endif
