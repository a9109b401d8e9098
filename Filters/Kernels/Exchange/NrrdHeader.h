/**
 * Headers of NRRD files, as Teem's definition of the format has them.
 */
#ifndef FlipFreeNrrdHeader_h
#define FlipFreeNrrdHeader_h

#include "Exchange/VolumeFileHeader.h"

#include <string>

namespace FlipFree
{

/// Whether a file that begins so is one.
bool IsNrrd(const std::string& start);

/// A fourth axis of more than one value is read of segmentations of 3D Slicer alone, as their
/// layers.
VolumeFileHeader ReadNrrdHeader(const std::string& name, const std::string& start);

} // namespace FlipFree

#endif
