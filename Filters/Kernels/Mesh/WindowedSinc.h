/**
 * Smoothing of a surface by a low-pass filter, a windowed sinc (G. Taubin, T. Zhang and G. Golub,
 * Optimal surface smoothing as filter design, 1996): unlike averaging, it does not shrink.
 */
#ifndef FlipFreeWindowedSinc_h
#define FlipFreeWindowedSinc_h

#include "KernelTypes.h"

namespace FlipFree
{

/// Moves the points of a closed surface. The pass band, in (0, 2), is the highest eigenvalue of the
/// surface's Laplacian that passes; each iteration makes the filter steeper.
void SmoothByWindowedSinc(const TriangleList& triangles, int iterations, double passBand,
  PointList& points);

} // namespace FlipFree

#endif
