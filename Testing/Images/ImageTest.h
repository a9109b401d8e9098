/**
 * What image tests share: a small window without anything that depends on the machine (300 x 300
 * pixels, no multisampling, no text), a few colours, surfaces in them, and the comparison with the
 * baseline.
 */
#ifndef FlipFreeImageTest_h
#define FlipFreeImageTest_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSSAAPass.h"
#include "vtkSmartPointer.h"
#include "vtkTesting.h"

#include <array>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

namespace ImageTest
{

using Colour = std::array<double, 3>;

constexpr Colour White{ { 1, 1, 1 } };
constexpr Colour Ink{ { 0.16, 0.20, 0.26 } };
constexpr Colour Sand{ { 0.97, 0.92, 0.82 } };
constexpr Colour Blue{ { 0.22, 0.45, 0.69 } };
constexpr Colour Red{ { 0.80, 0.29, 0.22 } };

inline vtkSmartPointer<vtkRenderWindow> MakeWindow()
{
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetMultiSamples(0);
  window->SetSize(300, 300);
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
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAAPass> smooth;
  smooth->SetDelegatePass(steps);
  view->SetPass(smooth);
  window->AddRenderer(view);
  return view;
}

/// Moves the camera so that everything is in view; beyond 1, `zoom` trims the margin.
inline void Fit(vtkRenderer* view, double zoom = 1.6)
{
  view->ResetCamera();
  view->GetActiveCamera()->Zoom(zoom);
  view->ResetCameraClippingRange();
}

/// A surface in one colour; facets are shaded flat, to be seen as they are.
inline vtkSmartPointer<vtkActor> AddSurface(vtkRenderer* view, vtkPolyData* surface,
  const Colour& colour)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetInterpolationToFlat();
  property->SetAmbient(0.6);
  property->SetDiffuse(0.5);
  view->AddActor(actor);
  return actor;
}

/// The edges of a surface, in one colour whatever the light; they may be drawn over its faces.
inline vtkSmartPointer<vtkActor> AddLines(vtkRenderer* view, vtkPolyData* surface,
  const Colour& colour)
{
  const auto actor = AddSurface(view, surface, colour);
  // Nearer to the eye than the faces they lie in.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-2, -8);
  actor->GetProperty()->SetRepresentationToWireframe();
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(3);
  return actor;
}

/// Compares what the window shows with the test's baseline; the test's exit status. Of VTK's report
/// only the measurements are shown, not the driver's hundreds of extensions.
inline int Compare(vtkRenderWindow* window, int argc, char* argv[])
{
  window->Render();
  vtkNew<vtkTesting> testing;
  testing->AddArguments(argc, argv);
  testing->SetRenderWindow(window);
  std::stringstream report;
  const int result = testing->RegressionTest(0.15, report);
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
