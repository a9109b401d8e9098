/**
 * Pictures of images and surfaces for the examples: plain VTK, nothing of FlipFree's own.
 *
 * Slices are shown as radiologists look at them: the patient's right on the left, the back at the
 * bottom of an axial slice, the head at the top of a coronal one.
 */
#ifndef Scene_h
#define Scene_h

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>
#include <string>
#include <vector>

class vtkRenderWindow;

namespace Scene
{

using Vector = std::array<double, 3>;
using Actors = std::vector<vtkSmartPointer<vtkActor>>;

constexpr double Yellow[3] = { 1.0, 0.76, 0.2 };
constexpr double Blue[3] = { 0.35, 0.65, 1.0 };
constexpr double Liver[3] = { 0.86, 0.42, 0.33 };

/// A slice's directions, along the axes; the viewer is where Right x Up points.
struct Plane
{
  Vector Right;
  Vector Up;
};

const Plane Axial{ { 1, 0, 0 }, { 0, -1, 0 } };
const Plane Coronal{ { 1, 0, 0 }, { 0, 0, 1 } };

/// A surface with the edges of its mesh.
vtkSmartPointer<vtkActor> SurfaceActor(vtkPolyData* surface, const double color[3] = Liver);

/// A slice through a point, over the whole image, in the gray values of an abdomen's CT.
vtkSmartPointer<vtkActor> SliceActor(vtkImageData* image, const Vector& center, const Plane& plane,
  int samples = 500);

/// The voxels of a mask in the slice through a point; the image shows through.
vtkSmartPointer<vtkActor> MaskActor(vtkImageData* mask, const Vector& center, const Plane& plane,
  const double color[3]);

/// Where a surface crosses the slice through a point.
vtkSmartPointer<vtkActor> ContourActor(vtkPolyData* surface, const Vector& center,
  const Plane& plane, const double color[3] = Yellow, double width = 4);

/// Words at the lower left.
vtkSmartPointer<vtkTextActor> TextActor(const std::string& words, int size = 30);

/// A view onto a slice that shows what the bounds span, and a margin.
vtkSmartPointer<vtkRenderer> SliceView(const Actors& actors, const double bounds[6],
  const Plane& plane, const std::string& caption = "", double margin = 1.4);

/// A view into space, from the front, a little from the right and from above.
vtkSmartPointer<vtkRenderer> SpaceView(const Actors& actors, const double bounds[6],
  const std::string& caption = "", double zoom = 1.3);

/// Draws rows of views, each a square of this many pixels, and writes them as PNG.
void WritePicture(const std::string& name,
  const std::vector<std::vector<vtkSmartPointer<vtkRenderer>>>& rows, int size = 480);

/// Writes what a window shows as PNG.
void SaveWindow(vtkRenderWindow* window, const std::string& name);

} // namespace Scene

#endif
