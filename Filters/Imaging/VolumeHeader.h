/**
 * Private to the module: what the header of a medical image says, taken from one of ITK's image
 * readers, and the error that explains why an image cannot be read or written.
 */
#ifndef FlipFreeVolumeHeader_h
#define FlipFreeVolumeHeader_h

#include "KernelTypes.h"

#include "Exchange/FileProblem.h"
#include "Exchange/VoxelType.h"

#include "itkImageIOBase.h"

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

  std::size_t ScalarSize() const;
  std::size_t NumberOfBytes() const;
};

/// The header that `io` has read from the file called `name`. Refuses what is not a volume of one
/// number per voxel: 2D and 4D images, several components, a grid that is not invertible.
VolumeHeader HeaderOf(const itk::ImageIOBase* io, const std::string& name);

/// Of a problem of a file that is read: one of vtkErrorCode's.
unsigned long ErrorCodeOf(FileProblem::Kind kind);

/// VTK's name for the type.
int ScalarTypeOf(VoxelType type);

/// The VTK scalar type for ITK's; one and the same for all integers of 64 bits.
int ScalarTypeOf(itk::ImageIOBase::IOComponentEnum component);

/// ITK's name for a VTK scalar type; an ImageFileError for types that no file holds.
itk::ImageIOBase::IOComponentEnum ComponentOf(int scalarType);

/// Tells `io` that the whole image is meant, and reads it into `voxels`.
void ReadVoxels(itk::ImageIOBase* io, const std::string& name, void* voxels);

/// ITK's warnings go to the terminal, past VTK's; within a scope that holds one of these they are
/// off. What matters among them is checked, and reported, here.
class ItkWarningsOff
{
public:
  ItkWarningsOff()
    : WasOn(itk::Object::GetGlobalWarningDisplay())
  {
    itk::Object::SetGlobalWarningDisplay(false);
  }
  ~ItkWarningsOff() { itk::Object::SetGlobalWarningDisplay(this->WasOn); }
  ItkWarningsOff(const ItkWarningsOff&) = delete;
  void operator=(const ItkWarningsOff&) = delete;

private:
  bool WasOn;
};

} // namespace FlipFree

#endif
