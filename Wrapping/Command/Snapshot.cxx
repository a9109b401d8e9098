#include "Snapshot.h"

#include "Failure.h"
#include "Image/DisplayWindow.h"
#include "ImageAdapter.h"
#include "OutputFile.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCoordinate.h"
#include "vtkCutter.h"
#include "vtkImageActor.h"
#include "vtkImageData.h"
#include "vtkImageMapper3D.h"
#include "vtkImageProperty.h"
#include "vtkImageReslice.h"
#include "vtkImageShrink3D.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStripper.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#ifdef FLIPFREE_VTK_ON_X11
#include <X11/Xlib.h>
#endif

#include <algorithm>
#include <array>

namespace Command
{
namespace
{

using Vector = std::array<double, 3>;

constexpr int Size = 1200; // pixels
constexpr int ViewSize = Size / 2;
constexpr int Supersampling = 3;   // for smooth lines
constexpr double Gap = 3.0 / Size; // between the views
constexpr double Ink[3] = { 0.045, 0.05, 0.06 };
constexpr double Frame[3] = { 0.16, 0.17, 0.2 };
constexpr double ContourColor[3] = { 1.0, 0.76, 0.2 };
constexpr double DoubtColor[3] = { 0.25, 0.6,
  1.0 }; // of the contour where the image does not support it
constexpr double DoubtfulConfidence = 0.5;
constexpr double LetterColor[3] = { 0.85, 0.86, 0.88 };
constexpr double OrganColor[3] = { 0.86, 0.42, 0.33 };

/// The orientation of a slice; the viewer is in the direction of `Right` x `Up`.
struct View
{
  Vector Right;
  Vector Up;
  std::array<double, 2> Corner; // lower left, in fractions of the picture
  const char* LeftLetter;       // the patient's side at the left edge
  const char* TopLetter;
};

const View Axial{ { { 1, 0, 0 } }, { { 0, -1, 0 } }, { { 0, 0.5 } }, "R", "A" };
const View Sagittal{ { { 0, 1, 0 } }, { { 0, 0, 1 } }, { { 0.5, 0.5 } }, "A", "S" };
const View Coronal{ { { 1, 0, 0 } }, { { 0, 0, 1 } }, { { 0, 0 } }, "R", "S" };

/// What the slices show: a cube around the surface, shifted into the image as far as possible.
struct Region
{
  Vector Center; // of the surface
  Vector Middle; // of what is shown
  double Side;
  std::array<double, 2> Window;
};

vtkBoundingBox BoundsOf(vtkImageData* image)
{
  vtkBoundingBox box;
  int extent[6];
  image->GetExtent(extent);
  for (int corner = 0; corner < 8; ++corner)
  {
    const double index[3] = { extent[corner & 1] + 0.0, extent[2 + (corner >> 1 & 1)] + 0.0,
      extent[4 + (corner >> 2 & 1)] + 0.0 };
    double point[3];
    image->TransformContinuousIndexToPhysicalPoint(index, point);
    box.AddPoint(point);
  }
  return box;
}

Region ChooseRegion(vtkImageData* image, vtkPolyData* surface)
{
  Region region;
  vtkBoundingBox organ(surface->GetBounds());
  const vtkBoundingBox whole = BoundsOf(image);
  organ.GetCenter(region.Center.data());
  region.Side = std::min(std::max(1.8 * organ.GetMaxLength(), 60.0), 1.02 * whole.GetMaxLength());
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = whole.GetBound(2 * axis) + region.Side / 2;
    const double high = whole.GetBound(2 * axis + 1) - region.Side / 2;
    region.Middle[axis] =
      low < high ? std::clamp(region.Center[axis], low, high) : (low + high) / 2;
  }
  region.Window = FlipFree::VisitVoxels(image, "the image",
    [](const auto& view) { return FlipFree::DisplayWindowOf(view); });
  return region;
}

/// The view's axes as the columns of a matrix, the surface's center as its origin.
void AxesOf(const View& view, const Region& region, vtkMatrix4x4* axes)
{
  Vector normal;
  vtkMath::Cross(view.Right.data(), view.Up.data(), normal.data());
  for (int row = 0; row < 3; ++row)
  {
    axes->SetElement(row, 0, view.Right[row]);
    axes->SetElement(row, 1, view.Up[row]);
    axes->SetElement(row, 2, normal[row]);
    axes->SetElement(row, 3, region.Center[row]);
  }
}

/// vtkImageReslice ignores direction matrices, so it gets the image in index space.
vtkSmartPointer<vtkImageData> SliceOf(vtkImageData* image, vtkMatrix4x4* axes, const Region& region)
{
  vtkNew<vtkImageData> grid;
  grid->ShallowCopy(image);
  grid->SetOrigin(0, 0, 0);
  grid->SetSpacing(1, 1, 1);
  vtkNew<vtkMatrix3x3> identity;
  grid->SetDirectionMatrix(identity);
  vtkNew<vtkMatrixToLinearTransform> toIndex;
  toIndex->SetInput(image->GetPhysicalToIndexMatrix());

  // The middle of the region in the view's axes.
  double shift[2] = { 0, 0 };
  for (int row = 0; row < 3; ++row)
  {
    shift[0] += axes->GetElement(row, 0) * (region.Middle[row] - region.Center[row]);
    shift[1] += axes->GetElement(row, 1) * (region.Middle[row] - region.Center[row]);
  }
  const double pixel = region.Side / ViewSize;
  vtkNew<vtkImageReslice> reslice;
  reslice->SetInputData(grid);
  reslice->SetResliceAxes(axes);
  reslice->SetResliceTransform(toIndex);
  reslice->SetInterpolationModeToCubic();
  reslice->SetBackgroundLevel(region.Window[0] - 1);
  reslice->SetOutputDimensionality(2);
  reslice->SetOutputExtent(0, ViewSize - 1, 0, ViewSize - 1, 0, 0);
  reslice->SetOutputSpacing(pixel, pixel, 1);
  reslice->SetOutputOrigin(shift[0] - 0.5 * (region.Side - pixel),
    shift[1] - 0.5 * (region.Side - pixel), 0);
  reslice->SetOutputScalarType(VTK_FLOAT); // can hold a background below the window
  reslice->Update();
  return reslice->GetOutput();
}

vtkSmartPointer<vtkRenderer> AddRenderer(vtkRenderWindow* window,
  const std::array<double, 2>& corner)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(corner[0] + (corner[0] > 0 ? Gap / 2 : 0),
    corner[1] + (corner[1] > 0 ? Gap / 2 : 0), corner[0] + 0.5 - (corner[0] > 0 ? 0 : Gap / 2),
    corner[1] + 0.5 - (corner[1] > 0 ? 0 : Gap / 2));
  renderer->SetBackground(Ink[0], Ink[1], Ink[2]);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  window->AddRenderer(renderer);
  return renderer;
}

/// Two colors: below the doubtful confidence, and above.
void ColorByConfidence(vtkPolyDataMapper* mapper)
{
  vtkNew<vtkLookupTable> colors;
  colors->SetNumberOfTableValues(2);
  colors->SetTableValue(0, DoubtColor[0], DoubtColor[1], DoubtColor[2]);
  colors->SetTableValue(1, ContourColor[0], ContourColor[1], ContourColor[2]);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("Confidence");
  mapper->SetLookupTable(colors);
  mapper->SetScalarRange(0, 2 * DoubtfulConfidence);
  mapper->InterpolateScalarsBeforeMappingOn(); // no mixed colors
}

void AddContour(vtkRenderer* renderer, vtkPolyData* contour, const double* towardsViewer,
  const double color[3], double width)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(contour);
  mapper->ScalarVisibilityOff();
  if (color == ContourColor && contour->GetPointData()->HasArray("Confidence"))
  {
    mapper->ScalarVisibilityOn();
    ColorByConfidence(mapper);
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(towardsViewer[0], towardsViewer[1], towardsViewer[2]);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer->AddActor(actor);
}

void AddLetter(vtkRenderer* renderer, const char* letter, double x, double y)
{
  vtkNew<vtkTextActor> text;
  text->SetInput(letter);
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(x, y);
  vtkTextProperty* property = text->GetTextProperty();
  property->SetFontSize(18 * Supersampling);
  property->SetColor(LetterColor[0], LetterColor[1], LetterColor[2]);
  property->ShadowOn(); // for contrast with bright tissue
  property->SetShadowOffset(Supersampling, -Supersampling);
  property->SetJustificationToCentered();
  property->SetVerticalJustificationToCentered();
  renderer->AddViewProp(text);
}

void AddSlice(vtkRenderWindow* window, const View& view, vtkImageData* image, vtkPolyData* surface,
  const Region& region)
{
  vtkNew<vtkMatrix4x4> axes;
  AxesOf(view, region, axes);
  const Vector normal{ { axes->GetElement(0, 2), axes->GetElement(1, 2), axes->GetElement(2, 2) } };
  vtkRenderer* renderer = AddRenderer(window, view.Corner);

  vtkNew<vtkImageActor> slice;
  slice->SetInputData(SliceOf(image, axes, region));
  slice->SetUserMatrix(axes);
  slice->GetProperty()->SetColorLevel((region.Window[0] + region.Window[1]) / 2);
  slice->GetProperty()->SetColorWindow(region.Window[1] - region.Window[0]);
  slice->GetProperty()->SetInterpolationTypeToLinear();
  renderer->AddActor(slice);

  vtkNew<vtkPlane> plane;
  plane->SetOrigin(region.Center.data());
  plane->SetNormal(normal.data());
  vtkNew<vtkCutter> cut;
  cut->SetInputData(surface);
  cut->SetCutFunction(plane);
  vtkNew<vtkStripper> lines; // joins the segments, which would leave gaps at their ends
  lines->SetInputConnection(cut->GetOutputPort());
  lines->Update();
  for (int layer = 1; layer <= 2; ++layer) // a dark rim for contrast with bright tissue
  {
    const double front[3] = { layer * normal[0], layer * normal[1], layer * normal[2] };
    AddContour(renderer, lines->GetOutput(), front, layer == 1 ? Ink : ContourColor,
      layer == 1 ? 14 : 8);
  }
  AddLetter(renderer, view.LeftLetter, 0.035, 0.5);
  AddLetter(renderer, view.TopLetter, 0.5, 0.965);

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(region.Middle.data());
  camera->SetPosition(region.Middle[0] + 1000 * normal[0], region.Middle[1] + 1000 * normal[1],
    region.Middle[2] + 1000 * normal[2]);
  camera->SetViewUp(view.Up.data());
  camera->SetParallelScale(region.Side / 2);
  renderer->ResetCameraClippingRange();
}

void AddSurface(vtkRenderWindow* window, vtkPolyData* surface)
{
  vtkRenderer* renderer = AddRenderer(window, { { 0.5, 0 } });
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(OrganColor[0], OrganColor[1], OrganColor[2]);
  property->SetInterpolationToPhong();
  property->SetAmbient(0.08);
  property->SetDiffuse(0.85);
  property->SetSpecular(0.25);
  property->SetSpecularPower(25);
  property->EdgeVisibilityOn();
  property->SetEdgeColor(0.45, 0.18, 0.13);
  property->SetLineWidth(1.5);
  renderer->AddActor(actor);

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(-0.35, -1, 0.3); // from the front, a little from the right and from above
  camera->SetViewUp(0, 0, 1);
  renderer->ResetCamera();
  camera->Zoom(1.22);
  renderer->ResetCameraClippingRange();
}

} // namespace

void RequireDisplay()
{
#ifdef FLIPFREE_VTK_ON_X11
  Display* display = XOpenDisplay(nullptr);
  if (!display)
  {
    throw Failure("--snapshot: there is no display to draw the picture with. Run the command under "
                  "'xvfb-run -a', or omit the option.");
  }
  XCloseDisplay(display);
#endif
}

void WriteSnapshot(const std::string& name, vtkImageData* image, vtkPolyData* surface)
{
  const Region region = ChooseRegion(image, surface);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Supersampling * Size, Supersampling * Size);
  vtkNew<vtkRenderer> frame; // shows in the gaps
  frame->SetBackground(Frame[0], Frame[1], Frame[2]);
  window->AddRenderer(frame);
  for (const View* view : { &Axial, &Sagittal, &Coronal })
  {
    AddSlice(window, *view, image, surface, region);
  }
  AddSurface(window, surface);
  window->Render();

  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->SetInputBufferTypeToRGB();
  picture->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection(picture->GetOutputPort());
  shrink->SetShrinkFactors(Supersampling, Supersampling, 1);
  shrink->MeanOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(shrink->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  WriteBytes(name, reinterpret_cast<const char*>(bytes->GetPointer(0)),
    static_cast<std::size_t>(bytes->GetNumberOfValues()));
}

} // namespace Command
