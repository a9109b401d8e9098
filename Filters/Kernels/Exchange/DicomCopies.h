/**
 * Slices that are there twice, such as files that were copied or sent again.
 */
#ifndef FlipFreeDicomCopies_h
#define FlipFreeDicomCopies_h

#include "Exchange/DicomFrame.h"

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace FlipFree
{

/// Removes from ordered frames of one grid those that are there already, in another file: at one
/// place, with the same pixels and rescale, and of one instance or nothing that tells them apart.
/// Returns their files. Asks for the bytes in which pixels are stored only where frames may be the
/// same, and no more often than in proportion to the frames.
std::set<std::size_t> RemoveDicomCopies(std::vector<DicomFrame>& frames,
  const std::function<std::string(const DicomFrame&)>& bytesOf);

} // namespace FlipFree

#endif
