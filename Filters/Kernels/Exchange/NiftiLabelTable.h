/**
 * What the labels of a NIfTI file are called, by an extension of its header: the label table of
 * Caret and the Connectome Workbench, an XML text, in which TotalSegmentator too writes its names.
 */
#ifndef FlipFreeNiftiLabelTable_h
#define FlipFreeNiftiLabelTable_h

#include <cstdint>
#include <map>
#include <string>

namespace FlipFree
{

/// The names by their labels in the extensions between the header and the voxels, which begin at
/// `begin` with four bytes that say whether there are any. None where there is no label table, or
/// none that makes sense; 0 has none.
std::map<int, std::string> NiftiLabelNames(const std::string& start, std::size_t begin,
  std::uint64_t voxelOffset, bool isBigEndian);

} // namespace FlipFree

#endif
