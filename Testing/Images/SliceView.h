/**
 * Slices of an image as radiologists look at them, with contours of surfaces on top.
 */
#ifndef FlipFreeSliceView_h
#define FlipFreeSliceView_h

#include "ImageTest.h"

#include "vtkCutter.h"
#include "vtkImageActor.h"
#include "vtkImageData.h"
#include "vtkImageMapper3D.h"
#include "vtkImageProperty.h"
#include "vtkPlane.h"
#include "vtkStripper.h"

namespace ImageTest
{

constexpr Color Night{ { 0.05, 0.05, 0.07 } };
constexpr Color Amber{ { 1.00, 0.70, 0.10 } };
constexpr Color Cyan{ { 0.25, 0.80, 0.95 } };

/// A slice of an image whose axes are those of LPS, seen from the feet, the patient's left, or the
/// front: so that the front, or else the head, is up, and the patient's right on the left.
class SliceView
{
public:
  /// The slice across `axis` at a voxel, on a part of the window.
  SliceView(vtkRenderWindow* window, const std::array<double, 4>& part, int axis,
    const std::array<int, 3>& voxel)
  {
    constexpr double directions[3][3] = { { -1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    std::copy_n(directions[axis], 3, this->Direction.begin());
    this->Axis = axis;
    this->Voxel = voxel;
    this->View = AddView(window, this->Direction, part);
    this->View->SetBackground(Night.data());
    if (axis == 2)
    {
      this->View->GetActiveCamera()->SetViewUp(0, -1, 0);
    }
  }

  /// The slice in gray, and the camera on the whole of it, `height` millimeters high.
  void Show(vtkImageData* image, double low, double high, double height)
  {
    image->TransformIndexToPhysicalPoint(this->Voxel.data(), this->Point.data());
    int extent[6];
    image->GetExtent(extent);
    extent[2 * this->Axis] = extent[2 * this->Axis + 1] = this->Voxel[this->Axis];
    vtkNew<vtkImageActor> slice;
    slice->SetInputData(image);
    slice->SetDisplayExtent(extent);
    slice->GetProperty()->SetColorWindow(high - low);
    slice->GetProperty()->SetColorLevel((high + low) / 2);
    this->View->AddActor(slice);
    this->View->ResetCamera();
    this->View->GetActiveCamera()->SetParallelScale(height / 2);
  }

  /// Where a surface meets the slice.
  void AddContour(vtkPolyData* surface, const Color& color, float width)
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(this->Point.data());
    plane->SetNormal(this->Direction.data());
    vtkNew<vtkCutter> cut;
    cut->SetInputData(surface);
    cut->SetCutFunction(plane);
    vtkNew<vtkStripper> lines; // whole, so that there are no gaps at the ends of segments
    lines->SetInputConnection(cut->GetOutputPort());
    lines->Update();
    const auto actor = AddSurface(this->View, lines->GetOutput(), color);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetLineWidth(Finer * width);
    ++this->Contours; // each in front of the last
    actor->SetPosition(-this->Contours * this->Direction[0], -this->Contours * this->Direction[1],
      -this->Contours * this->Direction[2]);
    this->View->ResetCameraClippingRange();
  }

private:
  vtkSmartPointer<vtkRenderer> View;
  std::array<double, 3> Direction;
  std::array<double, 3> Point;
  std::array<int, 3> Voxel;
  int Axis;
  int Contours = 0;
};

} // namespace ImageTest

#endif
