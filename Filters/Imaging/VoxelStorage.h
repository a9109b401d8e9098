/**
 * Private to the module: where the header of a file says that its voxels are. The header is checked
 * here before ITK sees it, because ITK's libraries abort, loop forever or overrun buffers on
 * some damaged ones.
 */
#ifndef FlipFreeVoxelStorage_h
#define FlipFreeVoxelStorage_h

#include <cstdint>
#include <string>
#include <vector>

namespace FlipFree
{

struct VoxelStorage
{
  enum class Form
  {
    Plain,
    Deflated, ///< by gzip or zlib, from the offset on
    Other     ///< numbers as text, or bytes counted from the end of the file: ITK checks them
  };

  std::vector<std::string> Files; ///< one after the other
  std::uint64_t Offset = 0;       ///< of the first byte in the first file, as it is stored
  double NumberOfBytes = 0;       ///< from there on, inflated
  Form Encoding = Form::Plain;
};

/// Judges the header of a NIfTI, NRRD or MetaImage file, recognized as ITK does. An ImageFileError
/// names the field that cannot be as it is, and is thrown too where the files are missing or too
/// small for the voxels. A file of none of these formats has no storage: no files.
VoxelStorage StorageOf(const std::string& name);

} // namespace FlipFree

#endif
