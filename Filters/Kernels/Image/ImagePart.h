/**
 * A part of an image, read by the places of the part.
 */
#ifndef FlipFreeImagePart_h
#define FlipFreeImagePart_h

#include "Image/VoxelBox.h"

namespace FlipFree
{

/// Refers to the voxels only.
struct ImagePart
{
  ImageView<float> Image;
  std::array<int, 3> First{ { 0, 0, 0 } }; ///< voxel of the image

  /// The values of a row of the part.
  const float* Row(int j, int k) const
  {
    return &this->Image(this->First[0], this->First[1] + j, this->First[2] + k);
  }

  /// A part of the part.
  ImagePart Cropped(const VoxelBox& box) const
  {
    ImagePart part = *this;
    for (int axis = 0; axis < 3; ++axis)
    {
      part.First[axis] += box.Begin[axis];
    }
    return part;
  }
};

} // namespace FlipFree

#endif
