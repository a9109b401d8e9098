/**
 * Headers of NIfTI-1, NIfTI-2 and Analyze 7.5 files, as nifti1.h and nifti2.h lay them out.
 */
#ifndef FlipFreeNiftiHeader_h
#define FlipFreeNiftiHeader_h

#include "Exchange/VolumeFileHeader.h"

#include <string>

namespace FlipFree
{

/// Whether a file that begins so is one of them.
bool IsNifti(const std::string& start);

/// Where both orientations of a file are set, the sform is taken if it can be inverted, as most
/// readers do; the qform, if that is all there is. A warning tells where they lie apart by more
/// than half a voxel, where the voxel size beside the sform is another, and where neither is set.
VolumeFileHeader ReadNiftiHeader(const std::string& name, const std::string& start);

/// The header of a NIfTI-1 file of one volume, in the byte order of the machine, and what stands
/// between it and the voxels. The sform holds every grid; a qform stands beside it if it puts the
/// voxels in the same places, which it cannot where axes are not at right angles. Throws a
/// FileProblem where the grid has more voxels along an axis than a header can number.
std::string NiftiHeaderOf(const std::string& name, const ImageGeometry& grid, VoxelType type);

} // namespace FlipFree

#endif
