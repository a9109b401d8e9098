/**
 * Shared by the image tests: small pictures that do not depend on the machine (no multisampling, no
 * text), a few colors, surfaces drawn in them, and the comparison with the baseline. Pictures are
 * drawn at three times their size and scaled down, so that lines are smooth.
 */
#ifndef FlipFreeImageTest_h
#define FlipFreeImageTest_h

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkImageShrink3D.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTesting.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

namespace ImageTest
{

using Color = std::array<double, 3>;

constexpr Color White{ { 1, 1, 1 } };
constexpr Color Ink{ { 0.16, 0.20, 0.26 } };
constexpr Color Sand{ { 0.97, 0.92, 0.82 } };
constexpr Color Blue{ { 0.22, 0.45, 0.69 } };
constexpr Color Red{ { 0.80, 0.29, 0.22 } };

constexpr int Finer = 3; // drawn so many times as large

inline vtkSmartPointer<vtkRenderWindow> MakeWindow(int width = 300, int height = 300)
{
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetMultiSamples(0);
  window->SetOffScreenRendering(1); // it may be larger than the screen
  window->SetSize(Finer * width, Finer * height);
  return window;
}

/// A white view on a part of the window, from (0, 0) at its lower left to (1, 1). Its camera looks
/// along `direction` with z upwards, in parallel projection; call Fit() once the view is filled.
inline vtkSmartPointer<vtkRenderer> AddView(vtkRenderWindow* window,
  const std::array<double, 3>& direction, const std::array<double, 4>& part = { { 0, 0, 1, 1 } })
{
  auto view = vtkSmartPointer<vtkRenderer>::New();
  view->SetBackground(White.data());
  view->SetViewport(part[0], part[1], part[2], part[3]);
  vtkCamera* camera = view->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(-direction[0], -direction[1], -direction[2]);
  camera->SetViewUp(0, 0, 1);
  window->AddRenderer(view);
  return view;
}

/// Moves the camera so that a surface fills the view but for a small margin.
inline void Fit(vtkRenderer* view, vtkPolyData* surface)
{
  vtkCamera* camera = view->GetActiveCamera();
  vtkMatrix4x4* toCamera = camera->GetViewTransformMatrix();
  vtkBoundingBox box;
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    double point[4] = { 0, 0, 0, 1 };
    surface->GetPoint(vertex, point);
    toCamera->MultiplyPoint(point, point);
    box.AddPoint(point);
  }
  double middle[4] = { 0, 0, 0, 1 };
  box.GetCenter(middle);
  vtkNew<vtkMatrix4x4> toWorld;
  vtkMatrix4x4::Invert(toCamera, toWorld);
  toWorld->MultiplyPoint(middle, middle);
  double direction[3];
  camera->GetDirectionOfProjection(direction);
  vtkMath::MultiplyScalar(direction, box.GetDiagonalLength()); // nothing is behind the camera
  camera->SetFocalPoint(middle);
  camera->SetPosition(middle[0] - direction[0], middle[1] - direction[1], middle[2] - direction[2]);
  camera->SetParallelScale(
    0.53 * std::max(box.GetLength(1), box.GetLength(0) / view->GetTiledAspectRatio()));
  view->ResetCameraClippingRange();
}

/// A surface in one color; facets are shaded flat, to be seen as they are.
inline vtkSmartPointer<vtkActor> AddSurface(vtkRenderer* view, vtkPolyData* surface,
  const Color& color)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(color[0], color[1], color[2]);
  property->SetInterpolationToFlat();
  property->SetAmbient(0.6);
  property->SetDiffuse(0.5);
  view->AddActor(actor);
  return actor;
}

/// A surface in one color as an object in the light: its shape counts, not its facets.
inline void AddSmoothSurface(vtkRenderer* view, vtkPolyData* surface, const Color& color)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SplittingOff();
  normals->Update();
  vtkProperty* property = AddSurface(view, normals->GetOutput(), color)->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(0.1);
  property->SetDiffuse(0.9);
}

/// The edges of a surface, in one color whatever the light; they may be drawn over its faces.
inline vtkSmartPointer<vtkActor> AddLines(vtkRenderer* view, vtkPolyData* surface,
  const Color& color)
{
  const auto actor = AddSurface(view, surface, color);
  // Nearer to the eye than the faces they lie in.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-2, -8);
  actor->GetProperty()->SetRepresentationToWireframe();
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(Finer);
  return actor;
}

/// Compares what the window shows with the test's baseline; the test's exit status. Of VTK's report
/// only the measurements are shown, not the driver's hundreds of extensions. The threshold is the
/// sum over pixels of what differs more than a shift by a pixel explains, 1 being black for white.
inline int Compare(vtkRenderWindow* window, int argc, char* argv[], double threshold = 0.15)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection(picture->GetOutputPort());
  shrink->SetShrinkFactors(Finer, Finer, 1);
  shrink->MeanOn();
  vtkNew<vtkTesting> testing;
  testing->AddArguments(argc, argv);
  std::stringstream report;
  const int result = testing->RegressionTest(shrink, threshold, report);
  for (std::string line; std::getline(report, line);)
  {
    if (line.find("Dart") != std::string::npos || line.find("Image Test") != std::string::npos)
    {
      std::cout << line << '\n';
    }
  }
  return result == vtkTesting::PASSED ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace ImageTest

#endif
