/**
 * The grid of pixels that a frame is: frames of one volume have the same, up to their places along
 * the normal.
 */
#ifndef FlipFreeDicomGrid_h
#define FlipFreeDicomGrid_h

#include "Exchange/DicomFrame.h"

#include <string>

namespace FlipFree
{

/// Whether frames have as many pixels of one size along the same axes.
bool AreOnOneGrid(const DicomFrame& a, const DicomFrame& b);

/// What a frame has that the usual one has not, as "512 x 512 pixels, not 256 x 256"; empty where
/// they are on one grid.
std::string GridDifference(const DicomFrame& frame, const DicomFrame& usual);

} // namespace FlipFree

#endif
