/**
 * A cube of samples of an implicit shape, for whoever makes a contour of them, and the way from the
 * contour, which is interpolated, onto the shape.
 */
#ifndef FlipFreeShapeCube_h
#define FlipFreeShapeCube_h

#include "KernelTypes.h"
#include "Phantom/ImplicitShape.h"
#include "Phantom/Phantom.h"

namespace FlipFree
{

struct ShapeCube
{
  static constexpr int Size = 129; ///< samples along an edge
  Eigen::Vector3d First;           ///< the sample with the least coordinates
  double Step;                     ///< between samples, in millimeters
};

/// Around a ball.
ShapeCube CubeAround(const Ball& ball);

/// Minus the shape's values at all samples, x fastest: positive inside.
void SampleInCube(const ImplicitShape& shape, const ShapeCube& cube, const ParallelFor& parallelFor,
  float* values);

/// Moves points, given in steps from the first sample, onto the surface, and to the physical
/// coordinates of the grid along whose axes the shape is.
PointList OntoSurface(const ImplicitShape& shape, const ShapeCube& cube, const PointList& points,
  const ImageGeometry& geometry);

} // namespace FlipFree

#endif
