/**
 * The voxels inside a closed surface, by scan conversion in the image's index space.
 *
 * A voxel is inside if its center is: if the surface winds around it (a non-zero winding number, so
 * that where a self-intersecting surface overlaps itself, the overlap is inside). Working in index
 * space makes the result exact for any origin, spacing and direction matrix.
 *
 * Each plane of voxels cuts the surface in closed polygons, whose corners are one crossing per
 * edge of the mesh; each row of voxels cuts these polygons in as many entries as exits. Lower
 * bounds belong to the inside, upper ones do not, and a crossing depends on the edge's two end
 * points alone: adjoining triangles never count a crossing twice or not at all, and of two organs
 * that share a wall each voxel belongs to exactly one.
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

/// The voxels of the image inside the surface, as maximal runs ordered by K, J, Begin: memory
/// follows the organ's surface, not the image. Empty when the surface holds no voxel center, or
/// when the monitor stops it. Throws std::invalid_argument when the surface is not closed and
/// consistently oriented (either way round), a point is not finite or lies more than 1e15 voxels
/// away from the image, or the geometry is singular.
std::vector<VoxelRun> VoxelizeSurface(const PointList& points, const TriangleList& triangles,
  const ImageGeometry& geometry, const ParallelFor& parallelFor = SerialFor,
  const Monitor& monitor = NeverStop);

std::size_t CountVoxels(const std::vector<VoxelRun>& runs);

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
