/**
 * Whether a surface lies outside or inside a reference, on average.
 */
#ifndef SurfaceOffset_h
#define SurfaceOffset_h

class vtkImageData;
class vtkPolyData;

/// The mean signed distance of the surface's vertices from the reference's boundary, in
/// millimeters, positive outside. Vertices more than 5 mm away are left out: they show leaks and
/// missed parts, which do not tell where the boundary is drawn.
double MeanSignedOffset(vtkPolyData* surface, vtkImageData* reference, int label);

#endif
