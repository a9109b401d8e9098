/**
 * A window in which one clicks on what is wrong with a segmentation.
 *
 *   CorrectByClicking                                      the built-in phantom
 *   CorrectByClicking ct.nii.gz --seed 83 -154 321 --radius 26
 *
 * A key says what the next clicks mean: o, the organ does not reach that place; i, it holds it; b,
 * its boundary is there; n, nothing, the slices only go there. Click on a slice or on the surface,
 * and the surface obeys. u takes the last point back, y brings it again. The wheel over a slice
 * moves it; drag beside the slices to turn the view; q ends. With --picture, the program plays the
 * user itself: it clicks, takes back, brings again, and ends.
 */
#include "Display.h"
#include "Inputs.h"
#include "Scene.h"

#include <vtkCamera.h>
#include <vtkCellPicker.h>
#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFlipFreeSegmentation.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace
{

constexpr int ClickPixels = 3;   // a mouse that moves farther than this turns the view
constexpr double MarkRadius = 4; // mm
constexpr double Red[3] = { 0.9, 0.1, 0.1 };
constexpr double Green[3] = { 0.3, 0.8, 0.35 };
const Scene::Plane* const Planes[2] = { &Scene::Axial, &Scene::Coronal };

/// What a click means, by the key that says so.
struct Meaning
{
  char Key;
  const char* Words;
  const double* Color;
  void (vtkFlipFreeSegmentation::*Add)(double, double, double);
};

const Meaning Meanings[] = {
  { 'n', "the slices go there", nullptr, nullptr },
  { 'o', "outside the organ", Red, &vtkFlipFreeSegmentation::AddOutsidePoint },
  { 'i', "inside the organ", Green, &vtkFlipFreeSegmentation::AddInsidePoint },
  { 'b', "on its boundary", Scene::Blue, &vtkFlipFreeSegmentation::AddBoundaryPoint },
};

struct Correction
{
  const Meaning* What;
  Scene::Vector Place;
};

/// In lines that fit into the view.
std::string Wrapped(std::string words)
{
  constexpr std::size_t width = 72;
  for (std::size_t start = 0; words.size() - start > width;)
  {
    const std::size_t space = words.rfind(' ', start + width);
    if (space == std::string::npos || space <= start)
    {
      break;
    }
    words[space] = '\n';
    start = space + 1;
  }
  return words;
}

/// Across a slice.
constexpr int AxisOf(int view)
{
  return view == 0 ? 2 : 1;
}

/// Three views: space with the surface, and two slices.
class CorrectionWindow
{
public:
  explicit CorrectionWindow(const Inputs& inputs);

  bool IsInside(const Scene::Vector& place);

  vtkFlipFreeSegmentation* GetFilter() { return this->Filter; }
  vtkRenderWindowInteractor* GetInteractor() { return this->Interactor; }
  vtkRenderer* GetSlice(int view) { return this->Slices[view]; }
  vtkPolyData* GetSurface() { return this->Surface; }
  std::size_t GetNumberOfPoints() const { return this->NumberDone; }

private:
  void ShowSlices();
  void ShowMarks();
  void ShowIn(vtkRenderer* view, const vtkSmartPointer<vtkActor>& actor);
  void Press();
  void Release();
  void TurnWheel(vtkObject* sender, unsigned long event, void*);
  void TakeKey();
  void NoteError(vtkObject* sender, unsigned long event, void* words);
  int SliceUnderMouse();
  bool Pick(Scene::Vector& place);
  void Add(const Correction& correction);
  void Undo();
  void Redo();
  bool Segment();
  void Say(const std::string& words);

  vtkSmartPointer<vtkImageData> Image;
  vtkNew<vtkFlipFreeSegmentation> Filter;
  vtkNew<vtkPolyData> Surface; // what all views show
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> Style;
  vtkSmartPointer<vtkRenderer> Space;
  vtkSmartPointer<vtkRenderer> Slices[2];
  vtkSmartPointer<vtkTextActor> Words;
  vtkSmartPointer<vtkActor> SurfaceShown;
  vtkSmartPointer<vtkActor> Pictures[2];                                 // the slices' gray values
  std::vector<std::pair<vtkRenderer*, vtkSmartPointer<vtkActor>>> Shown; // what follows the slices
  std::vector<std::pair<vtkRenderer*, vtkSmartPointer<vtkActor>>> Marks; // of the points
  Scene::Vector Place;
  const Meaning* Mode = Meanings;
  std::vector<Correction> Corrections; // those beyond NumberDone have been taken back
  std::size_t NumberDone = 0;
  std::string Error; // of the last run, if any
  int Pressed[2] = { 0, 0 };
};

CorrectionWindow::CorrectionWindow(const Inputs& inputs)
  : Image(inputs.Image)
  , Place(inputs.Seed)
{
  const double* bounds = this->Image->GetBounds();
  this->SurfaceShown = Scene::SurfaceActor(this->Surface);
  this->Space = Scene::SpaceView({ this->SurfaceShown }, bounds, "", 1.2);
  this->Words = Scene::TextActor("", 15);
  this->Space->AddViewProp(this->Words);
  this->Space->SetViewport(0, 0, 0.5, 1);
  this->Window->AddRenderer(this->Space);
  for (int view = 0; view < 2; ++view)
  {
    this->Slices[view] = Scene::SliceView({}, bounds, *Planes[view], "", 1.05);
    this->Slices[view]->SetViewport(0.5, view == 0 ? 0.5 : 0, 1, view == 0 ? 1 : 0.5);
    this->Slices[view]->InteractiveOff();
    this->Window->AddRenderer(this->Slices[view]);
  }
  this->Window->SetWindowName("FlipFree");
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(1200, 800);

  this->Filter->SetInputData(this->Image);
  this->Filter->SetSeedCenter(inputs.Seed.data());
  this->Filter->SetSeedRadius(inputs.Radius);
  this->Filter->KeepForCorrectionsOn(); // a correction then takes a third of the time
  this->Filter->AddObserver(vtkCommand::ErrorEvent, this, &CorrectionWindow::NoteError);
  this->Filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this,
    &CorrectionWindow::NoteError);
  this->Segment();

  this->Interactor->SetRenderWindow(this->Window);
  this->Interactor->SetInteractorStyle(this->Style);
  this->Interactor->Initialize();
  // In place of what the style does by itself; it takes the mouse for itself while a button is
  // held.
  this->Style->AddObserver(vtkCommand::LeftButtonPressEvent, this, &CorrectionWindow::Press);
  this->Style->AddObserver(vtkCommand::LeftButtonReleaseEvent, this, &CorrectionWindow::Release);
  for (const auto event :
    { vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent })
  {
    this->Style->AddObserver(event, this, &CorrectionWindow::TurnWheel);
  }
  this->Interactor->AddObserver(vtkCommand::KeyPressEvent, this, &CorrectionWindow::TakeKey);
  this->ShowSlices();
  if (this->Error.empty())
  {
    this->Say("o, i or b, then click on what is wrong");
  }
}

/// Runs the method with the points there are; false, with words, where they cannot be obeyed.
bool CorrectionWindow::Segment()
{
  this->Error.clear();
  this->Filter->Update();
  this->Surface->ShallowCopy(this->Filter->GetSurface());
  if (!this->Error.empty())
  {
    this->Say(this->Error);
  }
  return this->Error.empty();
}

/// The filter's own words, without the place in the source that VTK puts before them. The pipeline
/// says a second time that the filter has failed.
void CorrectionWindow::NoteError(vtkObject*, unsigned long, void* words)
{
  if (!this->Error.empty())
  {
    return;
  }
  const std::string text = static_cast<const char*>(words);
  const std::size_t start = text.find("): ");
  this->Error = start == std::string::npos ? text : text.substr(start + 3);
  this->Error.erase(this->Error.find_last_not_of('\n') + 1);
}

/// A point that cannot be obeyed is none: the result stays.
void CorrectionWindow::Add(const Correction& correction)
{
  const Scene::Vector& place = correction.Place;
  (this->Filter->*correction.What->Add)(place[0], place[1], place[2]);
  if (this->Segment())
  {
    this->Corrections.resize(this->NumberDone); // what was taken back before is gone
    this->Corrections.push_back(correction);
    ++this->NumberDone;
    this->Say("obeyed: " + std::string(correction.What->Words));
    return;
  }
  const std::string why = this->Error;
  this->Filter->RemoveLastPoint();
  this->Segment();
  this->Say(why);
}

void CorrectionWindow::Undo()
{
  if (this->NumberDone > 0)
  {
    --this->NumberDone;
    this->Filter->RemoveLastPoint();
    this->Segment();
    this->Say("taken back; y brings it again");
  }
}

void CorrectionWindow::Redo()
{
  if (this->NumberDone < this->Corrections.size())
  {
    const Correction& correction = this->Corrections[this->NumberDone++];
    const Scene::Vector& place = correction.Place;
    (this->Filter->*correction.What->Add)(place[0], place[1], place[2]);
    this->Segment();
    this->Say("obeyed again: " + std::string(correction.What->Words));
  }
}

void CorrectionWindow::Say(const std::string& words)
{
  this->Words->SetInput(
    ("click: " + std::string(this->Mode->Words) + " (o, i, b, n; u, y)\n" + Wrapped(words))
      .c_str());
  this->ShowMarks();
  this->Window->Render();
}

bool CorrectionWindow::IsInside(const Scene::Vector& place)
{
  vtkImageData* labels = this->Filter->GetLabelMap();
  Scene::Vector point = place;
  const vtkIdType voxel = labels->FindPoint(point.data());
  return voxel >= 0 && labels->GetPointData()->GetScalars()->GetTuple1(voxel) != 0;
}

/// The slice view that the mouse is in; -1 for none.
int CorrectionWindow::SliceUnderMouse()
{
  const int* mouse = this->Interactor->GetEventPosition();
  for (int view = 0; view < 2; ++view)
  {
    if (this->Slices[view]->IsInViewport(mouse[0], mouse[1]))
    {
      return view;
    }
  }
  return -1;
}

/// The place on a slice or, in space, on the surface that the mouse points at.
bool CorrectionWindow::Pick(Scene::Vector& place)
{
  const int view = this->SliceUnderMouse();
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0);
  picker->PickFromListOn();
  if (view >= 0)
  {
    picker->AddPickList(this->Pictures[view]);
  }
  else
  {
    picker->AddPickList(this->SurfaceShown);
    picker->AddPickList(this->Pictures[0]);
    picker->AddPickList(this->Pictures[1]);
  }
  const int* mouse = this->Interactor->GetEventPosition();
  if (!picker->Pick(mouse[0], mouse[1], 0, view >= 0 ? this->Slices[view] : this->Space))
  {
    return false;
  }
  picker->GetPickPosition(place.data());
  return true;
}

void CorrectionWindow::Press()
{
  std::copy_n(this->Interactor->GetEventPosition(), 2, this->Pressed);
  if (this->SliceUnderMouse() < 0)
  {
    this->Style->OnLeftButtonDown();
  }
}

/// A click, unless the mouse has been dragged.
void CorrectionWindow::Release()
{
  this->Style->OnLeftButtonUp();
  const int* mouse = this->Interactor->GetEventPosition();
  Scene::Vector place;
  if (std::abs(mouse[0] - this->Pressed[0]) > ClickPixels ||
    std::abs(mouse[1] - this->Pressed[1]) > ClickPixels || !this->Pick(place))
  {
    return;
  }
  this->Place = place;
  if (this->Mode->Add)
  {
    this->Add({ this->Mode, place });
  }
  this->ShowSlices();
}

/// Moves the slice under the mouse by a voxel, or the camera.
void CorrectionWindow::TurnWheel(vtkObject*, unsigned long event, void*)
{
  const int view = this->SliceUnderMouse();
  if (view < 0)
  {
    event == vtkCommand::MouseWheelForwardEvent ? this->Style->OnMouseWheelForward()
                                                : this->Style->OnMouseWheelBackward();
    return;
  }
  const int axis = AxisOf(view);
  const double* bounds = this->Image->GetBounds();
  const double step = event == vtkCommand::MouseWheelForwardEvent ? 1 : -1;
  const double moved = this->Place[axis] + step * this->Image->GetSpacing()[axis];
  this->Place[axis] = std::min(std::max(moved, bounds[2 * axis]), bounds[2 * axis + 1]);
  this->ShowSlices();
}

void CorrectionWindow::TakeKey()
{
  const char key = this->Interactor->GetKeyCode();
  for (const Meaning& meaning : Meanings)
  {
    if (meaning.Key == key)
    {
      this->Mode = &meaning;
      this->Say("");
    }
  }
  if (key == 'u')
  {
    this->Undo();
  }
  else if (key == 'y')
  {
    this->Redo();
  }
}

void CorrectionWindow::ShowIn(vtkRenderer* view, const vtkSmartPointer<vtkActor>& actor)
{
  this->Shown.emplace_back(view, actor);
  view->AddActor(actor);
  view->ResetCameraClippingRange();
}

void CorrectionWindow::ShowSlices()
{
  for (const auto& shown : this->Shown)
  {
    shown.first->RemoveActor(shown.second);
  }
  this->Shown.clear();
  for (int view = 0; view < 2; ++view)
  {
    this->Pictures[view] = Scene::SliceActor(this->Image, this->Place, *Planes[view], 200);
    this->ShowIn(this->Slices[view], this->Pictures[view]);
    this->ShowIn(this->Space, this->Pictures[view]);
    this->ShowIn(this->Slices[view],
      Scene::ContourActor(this->Surface, this->Place, *Planes[view], Scene::Yellow, 2));
  }
  this->ShowMarks();
  this->Window->Render();
}

/// A ball at each point, in a slice if it lies there.
void CorrectionWindow::ShowMarks()
{
  for (const auto& mark : this->Marks)
  {
    mark.first->RemoveActor(mark.second);
  }
  this->Marks.clear();
  for (std::size_t index = 0; index < this->NumberDone; ++index)
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetCenter(this->Corrections[index].Place.data());
    ball->SetRadius(MarkRadius);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(ball->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    const double* color = this->Corrections[index].What->Color;
    actor->GetProperty()->SetColor(color[0], color[1], color[2]);
    const Scene::Vector& place = this->Corrections[index].Place;
    const auto mark = [&](vtkRenderer* view)
    {
      view->AddActor(actor);
      this->Marks.emplace_back(view, actor);
    };
    mark(this->Space);
    for (int view = 0; view < 2; ++view)
    {
      if (std::abs(place[AxisOf(view)] - this->Place[AxisOf(view)]) < MarkRadius)
      {
        mark(this->Slices[view]);
      }
    }
  }
}

void Press(CorrectionWindow& window, char key)
{
  window.GetInteractor()->SetKeyCode(key);
  window.GetInteractor()->InvokeEvent(vtkCommand::KeyPressEvent);
}

/// With the left button, where a slice shows a place.
void ClickOn(CorrectionWindow& window, int view, const Scene::Vector& place)
{
  vtkNew<vtkCoordinate> coordinate;
  coordinate->SetCoordinateSystemToWorld();
  coordinate->SetValue(place[0], place[1], place[2]);
  const int* pixel = coordinate->GetComputedDisplayValue(window.GetSlice(view));
  vtkRenderWindowInteractor* mouse = window.GetInteractor();
  mouse->SetEventInformation(pixel[0], pixel[1]);
  mouse->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  mouse->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
}

/// Toward the vertex of the axial slice that is farthest from the seed, most of the way.
Scene::Vector PlaceToCorrect(CorrectionWindow& window, const Scene::Vector& seed)
{
  Scene::Vector farthest = seed;
  for (vtkIdType index = 0; index < window.GetSurface()->GetNumberOfPoints(); ++index)
  {
    Scene::Vector point;
    window.GetSurface()->GetPoint(index, point.data());
    if (std::abs(point[2] - seed[2]) < 2 &&
      vtkMath::Distance2BetweenPoints(point.data(), seed.data()) >
        vtkMath::Distance2BetweenPoints(farthest.data(), seed.data()))
    {
      farthest = { point[0], point[1], seed[2] };
    }
  }
  return { seed[0] + 0.8 * (farthest[0] - seed[0]), seed[1] + 0.8 * (farthest[1] - seed[1]),
    seed[2] };
}

/// Clicks on a place that is to lie outside, takes that back, brings it again, and clicks within
/// the seed, which cannot be outside.
void PlayUser(CorrectionWindow& window, const Scene::Vector& seed)
{
  const Scene::Vector place = PlaceToCorrect(window, seed);
  const auto tell = [&](const char* what)
  {
    std::cout << what << ": " << window.GetNumberOfPoints() << " points, the place is "
              << (window.IsInside(place) ? "inside" : "outside") << ", "
              << window.GetFilter()->GetNumberOfSelfIntersections() << " self-intersections\n";
  };
  tell("at first");
  ClickOn(window, 0, place); // means nothing yet
  tell("looked");
  Press(window, 'o');
  ClickOn(window, 0, place);
  tell("clicked");
  Press(window, 'u');
  tell("taken back");
  Press(window, 'y');
  tell("brought again");
  ClickOn(window, 0, seed);
  tell("refused");
}

} // namespace

int main(int argc, char* argv[])
{
  const Inputs inputs = ReadInputs(argc, argv);
  RequireDisplay();
  CorrectionWindow window(inputs);
  if (inputs.Picture.empty())
  {
    window.GetInteractor()->Start();
  }
  else
  {
    PlayUser(window, inputs.Seed);
    Scene::SaveWindow(window.GetInteractor()->GetRenderWindow(), inputs.Picture);
  }
  return EXIT_SUCCESS;
}
