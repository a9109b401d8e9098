/**
 * Voxels as they are stored in a file, inflated, to the values that they mean: byte order, digits,
 * and scale. For 3D Slicer's segmentations, see VoxelLayers.
 */
#ifndef FlipFreeVoxelDecoding_h
#define FlipFreeVoxelDecoding_h

#include "Exchange/VolumeFileHeader.h"

#include <cstddef>
#include <string>

namespace FlipFree
{

/// Of `count` voxels that are stored as bytes; `values` are of the header's ValueType(). They may
/// stand where the stored ones stand if both types are of one size.
void DecodeVoxels(const VolumeFileHeader& header, const void* stored, std::size_t count,
  void* values);

/// Of all voxels, which are stored as digits. Throws a FileProblem where these are no numbers, do
/// not fit the type, or are too few.
void DecodeDigits(const VolumeFileHeader& header, const std::string& stored, void* values);

} // namespace FlipFree

#endif
