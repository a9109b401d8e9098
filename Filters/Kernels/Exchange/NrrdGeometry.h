/**
 * Where the voxels of a NRRD file lie.
 */
#ifndef FlipFreeNrrdGeometry_h
#define FlipFreeNrrdGeometry_h

#include "Exchange/HeaderField.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// The axes of the array, by what they count.
struct NrrdAxes
{
  std::vector<std::size_t> OfSpace;
  std::vector<std::size_t> Others; ///< components, layers, time
};

NrrdAxes FindNrrdAxes(const TextFields& fields, std::size_t dimension);

/// The grid of the axes of space in LPS millimeters, and warnings of what was taken in the place of
/// what the file does not say.
ImageGeometry NrrdGrid(const std::string& name, const TextFields& fields, const NrrdAxes& axes,
  const std::vector<double>& sizes, std::vector<std::string>& warnings);

} // namespace FlipFree

#endif
