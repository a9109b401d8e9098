/**
 * A window of three views: space with a surface, and an axial and a coronal slice with its contour.
 */
#ifndef ThreeViews_h
#define ThreeViews_h

#include "Scene.h"

#include <vtkRenderWindow.h>

#include <utility>
#include <vector>

/// A ball, or a letter that nothing hides.
struct Mark
{
  Scene::Vector Place;
  const double* Color;
  const char* Letter; ///< null for a ball
  double Reach;       ///< mm; slices farther from the place do not show it
};

class ThreeViews
{
public:
  /// The view into space has that share of the window's width.
  ThreeViews(vtkImageData* image, vtkPolyData* surface, double share, double zoom);

  void SetWords(const std::string& words);

  /// Moves both slices to a place.
  void ShowSlices(const Scene::Vector& place);

  /// Moves one slice by so many voxels.
  void MoveSlice(int view, double voxels);

  /// In place of those shown before.
  void ShowMarks(const std::vector<Mark>& marks);

  /// Voxels in the slices, in place of those shown before; null for none.
  void ShowMask(vtkImageData* mask, const double color[3]);

  /// The slice that a pixel is in; -1 for none.
  int SliceAt(const int pixel[2]) const;

  /// The place on a slice or, in space, on the surface that a pixel shows; false for none.
  bool Pick(const int pixel[2], Scene::Vector& place) const;

  vtkRenderWindow* GetWindow() { return this->Window; }
  vtkRenderer* GetSpace() { return this->Space; }
  vtkRenderer* GetSlice(int view) { return this->Slices[view]; }

private:
  using PropsIn = std::vector<std::pair<vtkRenderer*, vtkSmartPointer<vtkProp>>>;
  static void Show(PropsIn& shown, vtkRenderer* view, vtkProp* prop);
  static void Clear(PropsIn& shown);

  vtkSmartPointer<vtkImageData> Image;
  vtkSmartPointer<vtkPolyData> Surface;
  vtkNew<vtkRenderWindow> Window;
  vtkSmartPointer<vtkRenderer> Space;
  vtkSmartPointer<vtkRenderer> Slices[2];
  vtkSmartPointer<vtkTextActor> Words;
  vtkSmartPointer<vtkActor> SurfaceShown;
  vtkSmartPointer<vtkActor> Pictures[2]; // the slices' gray values
  Scene::Vector Place{};                 // that the slices go through
  std::vector<Mark> Marks;
  PropsIn OfSlices;
  PropsIn OfMarks;
  PropsIn OfMask;
};

#endif
