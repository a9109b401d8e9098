/**
 * Headers of MetaImage files, as MetaIO's documentation of their fields has it.
 */
#ifndef FlipFreeMetaImageHeader_h
#define FlipFreeMetaImageHeader_h

#include "Exchange/VolumeFileHeader.h"

#include <string>

namespace FlipFree
{

/// Whether a file of this name that begins so is one.
bool IsMetaImage(const std::string& name, const std::string& start);

VolumeFileHeader ReadMetaImageHeader(const std::string& name, const std::string& start);

} // namespace FlipFree

#endif
