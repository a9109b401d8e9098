/**
 * The gradient vector flow of an edge map in the plane (C. Xu and J. Prince, Snakes, shapes, and
 * gradient vector flow, 1998), by ITK.
 */
#ifndef FlipFreeGradientVectorFlow_h
#define FlipFreeGradientVectorFlow_h

#include "PlaneSnake.h"

#include "itkImage.h"

namespace FlipFree
{

using PlaneImage = itk::Image<float, 2>;

/// Unit vectors toward the edges, into a field of the size of the edge map. Returns false if the
/// monitor stopped it.
bool FindVectorFlow(const PlaneImage::Pointer& edges, double smoothness, int iterations,
  const Monitor& monitor, PlaneField& field);

} // namespace FlipFree

#endif
