/**
 * Private to the module: the grid and the voxel type of an image in VTK's terms, and the errors of
 * its reader and its writer.
 */
#ifndef FlipFreeVolumeHeader_h
#define FlipFreeVolumeHeader_h

#include "KernelTypes.h"

#include "Exchange/FileProblem.h"
#include "Exchange/VoxelType.h"

#include <stdexcept>
#include <string>

namespace FlipFree
{

/// Thrown with a message for the user and the vtkErrorCode that belongs to it.
struct ImageFileError : std::runtime_error
{
  ImageFileError(unsigned long code, const std::string& message)
    : std::runtime_error(message)
    , Code(code)
  {
  }
  unsigned long Code;
};

/// The grid in LPS millimeters and the type of a voxel, one of VTK_SHORT and so on.
struct VolumeHeader
{
  ImageGeometry Geometry;
  int ScalarType = 0;

  std::size_t NumberOfBytes() const;
};

/// Of a problem of a file that is read: one of vtkErrorCode's.
unsigned long ErrorCodeOf(FileProblem::Kind kind);

/// VTK's name for the type, and back; one and the same for all integers of 64 bits. An
/// ImageFileError for types that no file holds.
int ScalarTypeOf(VoxelType type);
VoxelType VoxelTypeOf(int scalarType);

} // namespace FlipFree

#endif
