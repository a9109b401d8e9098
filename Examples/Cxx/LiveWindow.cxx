/**
 * A window in which one drags a sphere into an organ and watches the surface grow.
 *
 *   LiveWindow                                      the built-in phantom
 *   LiveWindow ct.nii.gz --seed 83 -154 321 --radius 26
 *
 * Drag the sphere with the left button, size it with the right one; when it is let go, the surface
 * grows from it. Drag beside it to turn the view; q ends. With --picture, the program plays the
 * user itself: it drags the sphere with the mouse, waits until the surface has converged, and ends.
 */
#include "Display.h"
#include "Growth.h"
#include "Inputs.h"
#include "Scene.h"
#include "ThreeViews.h"

#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkMath.h>
#include <vtkProperty.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSphereRepresentation.h>
#include <vtkSphereWidget2.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>

namespace
{

constexpr int Milliseconds = 30; // between iterations, in which the window listens to the mouse

/// Three views: space with the sphere, and two slices through its center.
class LiveWindow
{
public:
  explicit LiveWindow(const Inputs& inputs);

  void Stop();
  void Begin();
  void Step();

  vtkRenderWindowInteractor* GetInteractor() { return this->Interactor; }
  vtkRenderer* GetSpace() { return this->Views.GetSpace(); }
  vtkSphereRepresentation* GetSphere() { return this->Sphere; }
  vtkPolyData* GetSurface() { return this->Surface; }
  bool IsGrowing() const { return this->Growing && !this->Growing->HasConverged(); }

private:
  void PlaceSphere(const Inputs& inputs);
  void ShowSlices();

  vtkSmartPointer<vtkImageData> Image;
  // All views show this one object; a new iterate gets to them by being copied into it.
  vtkNew<vtkPolyData> Surface;
  ThreeViews Views;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  vtkNew<vtkSphereRepresentation> Sphere;
  vtkNew<vtkSphereWidget2> Widget;
  std::unique_ptr<Growth> Growing;
};

LiveWindow::LiveWindow(const Inputs& inputs)
  : Image(inputs.Image)
  , Views(inputs.Image, this->Surface, 0.66, 1.5)
{
  this->Views.SetWords("drag the sphere into an organ");
  this->Interactor->SetRenderWindow(this->Views.GetWindow());
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  this->Interactor->SetInteractorStyle(style);
  this->Interactor->Initialize();
  this->PlaceSphere(inputs);
  this->ShowSlices();
  this->Views.GetWindow()->Render();

  this->Widget->AddObserver(vtkCommand::StartInteractionEvent, this, &LiveWindow::Stop);
  this->Widget->AddObserver(vtkCommand::EndInteractionEvent, this, &LiveWindow::Begin);
  this->Interactor->AddObserver(vtkCommand::TimerEvent, this, &LiveWindow::Step);
  this->Interactor->CreateRepeatingTimer(Milliseconds);
}

void LiveWindow::PlaceSphere(const Inputs& inputs)
{
  double box[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] = inputs.Seed[axis] - inputs.Radius;
    box[2 * axis + 1] = inputs.Seed[axis] + inputs.Radius;
  }
  this->Sphere->SetPlaceFactor(1);
  this->Sphere->PlaceWidget(box);
  this->Sphere->SetRepresentationToWireframe();
  this->Sphere->GetSphereProperty()->SetColor(Scene::Yellow[0], Scene::Yellow[1], Scene::Yellow[2]);
  this->Sphere->GetSphereProperty()->SetOpacity(0.5);
  this->Sphere->HandleVisibilityOff();
  this->Sphere->HandleTextOff();
  this->Sphere->RadialLineOff();
  this->Widget->SetInteractor(this->Interactor);
  this->Widget->SetDefaultRenderer(this->Views.GetSpace());
  this->Widget->SetRepresentation(this->Sphere);
  this->Widget->On();
}

/// Nothing grows while the sphere is dragged.
void LiveWindow::Stop()
{
  this->Growing.reset();
  this->Surface->Initialize();
}

/// Starts from where the sphere has been let go.
void LiveWindow::Begin()
{
  this->ShowSlices();
  std::array<double, 3> seed;
  this->Sphere->GetCenter(seed.data());
  this->Growing = std::make_unique<Growth>(this->Image, seed, this->Sphere->GetRadius());
}

/// One iteration, each time the timer rings.
void LiveWindow::Step()
{
  if (!this->IsGrowing())
  {
    return;
  }
  if (this->Growing->Step())
  {
    this->Surface->ShallowCopy(this->Growing->GetSurface());
    std::ostringstream words;
    words.precision(2);
    words << this->Surface->GetNumberOfPoints() << " vertices, on average "
          << this->Growing->MeanDistance << " mm from their targets";
    this->Views.SetWords(words.str());
  }
  else
  {
    this->Stop();
    this->Views.SetWords("there is no organ to be found from here");
  }
  this->Views.GetWindow()->Render();
}

void LiveWindow::ShowSlices()
{
  Scene::Vector center;
  this->Sphere->GetCenter(center.data());
  this->Views.ShowSlices(center);
}

/// How far the sphere is from a point.
double DistanceFrom(const double point[3], LiveWindow& live)
{
  double center[3];
  live.GetSphere()->GetCenter(center);
  return std::sqrt(vtkMath::Distance2BetweenPoints(point, center));
}

/// Drags the sphere out of the organ and back with the mouse, and waits.
void PlayUser(LiveWindow& live)
{
  double start[3];
  live.GetSphere()->GetCenter(start);
  vtkNew<vtkCoordinate> place;
  place->SetCoordinateSystemToWorld();
  place->SetValue(start);
  const int* pixel = place->GetComputedDisplayValue(live.GetSpace());
  const int home[2] = { pixel[0], pixel[1] };

  vtkRenderWindowInteractor* mouse = live.GetInteractor();
  mouse->SetEventInformation(home[0], home[1]);
  mouse->InvokeEvent(vtkCommand::MouseMoveEvent);
  mouse->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  double farthest = 0;
  for (const int right : { 60, 120, 60, 0 })
  {
    mouse->SetEventInformation(home[0] + right, home[1] + right / 3);
    mouse->InvokeEvent(vtkCommand::MouseMoveEvent);
    farthest = std::max(farthest, DistanceFrom(start, live));
  }
  mouse->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
  int iterations = 0;
  for (; live.IsGrowing(); ++iterations)
  {
    mouse->InvokeEvent(vtkCommand::TimerEvent);
  }
  std::cout << "dragged by " << std::lround(farthest) << " mm and back to within "
            << std::lround(DistanceFrom(start, live)) << " mm; then " << iterations
            << " iterations to " << live.GetSurface()->GetNumberOfPoints() << " vertices\n";
}

} // namespace

int main(int argc, char* argv[])
{
  const Inputs inputs = ReadInputs(argc, argv);
  RequireDisplay();
  LiveWindow live(inputs);
  if (inputs.Picture.empty())
  {
    live.Begin();
    live.GetInteractor()->Start();
  }
  else
  {
    PlayUser(live);
    Scene::SaveWindow(live.GetInteractor()->GetRenderWindow(), inputs.Picture);
  }
  return EXIT_SUCCESS;
}
