/**
 * A window in which one clicks on what is wrong with a segmentation, and answers its questions.
 *
 *   CorrectByClicking                                      the built-in phantom
 *   CorrectByClicking ct.nii.gz --seed 83 -154 321 --radius 26
 *
 * A key says what the next clicks mean: o, the organ does not reach that place; i, it holds it; b,
 * its boundary is there; l, look, the slices only go there. Click on a slice or on the surface, and
 * the surface obeys; after o and i, a slice shows in color what a click under the mouse would take
 * or add, and a drag over it paints a stroke of such points. Where the result has a question, there
 * is a question mark: g, the slices go there, and again to the next one; y, yes, that part is
 * organ; n, no. u takes the last step back, a brings it again. The wheel over a slice moves it;
 * drag beside the slices to turn the view; q ends. With --picture, the program plays the user
 * itself, and ends.
 */
#include "CorrectionWindow.h"
#include "Display.h"
#include "Inputs.h"
#include "Scene.h"

#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkDataArray.h>
#include <vtkMath.h>
#include <vtkPointData.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace
{

bool IsInside(CorrectionWindow& window, Scene::Vector place)
{
  vtkImageData* labels = window.GetCorrections().GetFilter()->GetLabelMap();
  const vtkIdType voxel = labels->FindPoint(place.data());
  return voxel >= 0 && labels->GetPointData()->GetScalars()->GetTuple1(voxel) != 0;
}

std::size_t NumberOfPoints(CorrectionWindow& window)
{
  std::size_t number = 0;
  for (const Step& step : window.GetCorrections().GetDone())
  {
    number += step.Places.size();
  }
  return number;
}

void Press(CorrectionWindow& window, char key)
{
  window.GetInteractor()->SetKeyCode(key);
  window.GetInteractor()->InvokeEvent(vtkCommand::KeyPressEvent);
}

/// To where a slice shows a place.
void MoveTo(CorrectionWindow& window, int view, const Scene::Vector& place)
{
  vtkNew<vtkCoordinate> coordinate;
  coordinate->SetCoordinateSystemToWorld();
  coordinate->SetValue(place[0], place[1], place[2]);
  const int* pixel = coordinate->GetComputedDisplayValue(window.GetViews().GetSlice(view));
  window.GetInteractor()->SetEventInformation(pixel[0], pixel[1]);
  window.GetInteractor()->InvokeEvent(vtkCommand::MouseMoveEvent);
}

/// Presses the left button at the first place, and lets it go at the last.
void Drag(CorrectionWindow& window, int view, const std::vector<Scene::Vector>& places)
{
  MoveTo(window, view, places.front());
  window.GetInteractor()->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  for (const Scene::Vector& place : places)
  {
    MoveTo(window, view, place);
  }
  window.GetInteractor()->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
}

void ClickOn(CorrectionWindow& window, int view, const Scene::Vector& place)
{
  Drag(window, view, { place });
}

/// Toward the vertex of the axial slice that is farthest from the seed, most of the way.
Scene::Vector PlaceToCorrect(CorrectionWindow& window, const Scene::Vector& seed)
{
  Scene::Vector farthest = seed;
  for (vtkIdType index = 0; index < window.GetCorrections().GetSurface()->GetNumberOfPoints();
       ++index)
  {
    Scene::Vector point;
    window.GetCorrections().GetSurface()->GetPoint(index, point.data());
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

/// Rests over a place that is to lie outside, clicks there, takes that back, brings it again, and
/// clicks within the seed, which cannot be outside; paints a stroke; and answers a question.
void PlayUser(CorrectionWindow& window, const Scene::Vector& seed)
{
  const Scene::Vector place = PlaceToCorrect(window, seed);
  Corrections& organ = window.GetCorrections();
  const auto tell = [&](const char* what)
  {
    std::cout << what << ": " << organ.GetDone().size() << " steps, " << NumberOfPoints(window)
              << " points, the place is " << (IsInside(window, place) ? "inside" : "outside")
              << ", " << organ.GetFilter()->GetNumberOfSelfIntersections()
              << " self-intersections, " << organ.GetQuestions().size() << " questions\n";
  };
  tell("at first");
  ClickOn(window, 0, place); // means nothing yet
  tell("looked");
  Press(window, 'o');
  MoveTo(window, 0, place);
  window.GetInteractor()->InvokeEvent(vtkCommand::TimerEvent); // the mouse has moved until then
  window.GetInteractor()->InvokeEvent(vtkCommand::TimerEvent);
  std::cout << window.GetPreview() << "\n";
  ClickOn(window, 0, place);
  tell("clicked");
  Press(window, 'u');
  tell("taken back");
  Press(window, 'a');
  tell("brought again");
  ClickOn(window, 0, seed);
  tell("refused");
  Press(window, 'i');
  const Scene::Vector beside{ seed[0], seed[1] + 20, seed[2] };
  Drag(window, 0, { seed, beside });
  tell("painted");
  Press(window, 'u');
  Press(window, 'u');
  Press(window, 'g');
  Press(window, 'y');
  tell("answered");
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
