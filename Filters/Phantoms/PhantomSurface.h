/**
 * Private to the module, never installed: the surface of an implicit shape as triangles.
 */
#ifndef PhantomSurface_h
#define PhantomSurface_h

#include "Phantom/Phantom.h"

#include "vtkSmartPointer.h"

class vtkPolyData;

namespace FlipFree
{

/// Triangles whose points lie on the surface of the shape within `ball`, both in millimeters along
/// the grid's axes; in physical coordinates, counter-clockwise seen from outside. Their edges are
/// about a sixty-fourth of the ball's radius long.
vtkSmartPointer<vtkPolyData> MakePhantomSurface(const ImplicitShape& shape, const Ball& ball,
  const ImageGeometry& geometry);

} // namespace FlipFree

#endif
