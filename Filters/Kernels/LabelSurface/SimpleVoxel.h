/**
 * Whether a voxel may join or leave a set of voxels without a change of their topology (A.
 * Rosenfeld, Three-dimensional digital topology, 1981; G. Bertrand and G. Malandain, A new
 * characterization of three-dimensional simple points, 1994).
 *
 * Neighbors are bits: bit 9 (k + 1) + 3 (j + 1) + i + 1 is the neighbor at (i, j, k), and the voxel
 * itself has none.
 */
#ifndef FlipFreeSimpleVoxel_h
#define FlipFreeSimpleVoxel_h

namespace FlipFree
{

constexpr unsigned int CenterVoxel = 1U << 13;

/// For a set whose voxels are connected across faces, with others that are connected across edges
/// and corners, too.
bool IsSimpleAcrossFaces(unsigned int neighbors);

/// For both: whether the set or the others are connected across edges and corners.
bool IsSimpleVoxel(unsigned int neighbors);

} // namespace FlipFree

#endif
