#include "CorrectionWindow.h"

#include <vtkCommand.h>
#include <vtkMath.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace
{

constexpr int ClickPixels = 3;                    // a mouse that moves farther than this drags
constexpr double StrokeStep = 3;                  // mm between the points of a stroke
constexpr int Milliseconds = 30;                  // of a pause of the mouse
constexpr double Violet[3] = { 0.95, 0.45, 1.0 }; // of the question that keys answer
constexpr double Dim[3] = { 0.75, 0.5, 0.8 };     // of others

const Mode Modes[] = {
  { 'l', "the slices go there", nullptr },
  { 'o', Outside.Words, &Outside },
  { 'i', Inside.Words, &Inside },
  { 'b', Boundary.Words, &Boundary },
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

std::string TextOf(const Question& question)
{
  char text[200];
  std::snprintf(text, sizeof(text),
    "Is the part of %.0f ml at (%.0f, %.0f, %.0f) mm organ? It is %s.", question.Volume,
    question.Place[0], question.Place[1], question.Place[2],
    question.Included ? "included" : "left out");
  return text;
}

std::string TextOfPreview(double milliliters, bool adds)
{
  if (milliliters < 0)
  {
    return "a click here cannot be obeyed";
  }
  char text[80];
  std::snprintf(text, sizeof(text),
    milliliters > 0 ? "a click here %s %.*f ml" : "a click here %s nothing",
    adds ? "adds" : "takes", milliliters < 10 ? 1 : 0, milliliters);
  return text;
}

/// The radius of a ball of that volume.
double ReachOf(const Question& question)
{
  return std::cbrt(question.Volume * 1000 * 3 / (4 * vtkMath::Pi()));
}

/// Continues a stroke straight to a place, by whole steps.
void Extend(std::vector<Scene::Vector>& stroke, const Scene::Vector& place)
{
  const Scene::Vector start = stroke.back();
  const double length = std::sqrt(vtkMath::Distance2BetweenPoints(start.data(), place.data()));
  for (double done = StrokeStep; done <= length; done += StrokeStep)
  {
    const double part = done / length;
    stroke.push_back({ start[0] + part * (place[0] - start[0]),
      start[1] + part * (place[1] - start[1]), start[2] + part * (place[2] - start[2]) });
  }
}

} // namespace

CorrectionWindow::CorrectionWindow(const Inputs& inputs)
  : Organ(inputs)
  , Views(inputs.Image, this->Organ.GetSurface(), 0.5, 1.2)
  , Now(Modes)
  , Questions(this->Organ.GetQuestions())
{
  this->Interactor->SetRenderWindow(this->Views.GetWindow());
  this->Interactor->SetInteractorStyle(this->Style);
  this->Interactor->Initialize();
  // In place of what the style does by itself; it takes the mouse for itself while a button is
  // held.
  this->Style->AddObserver(vtkCommand::LeftButtonPressEvent, this, &CorrectionWindow::Press);
  this->Style->AddObserver(vtkCommand::MouseMoveEvent, this, &CorrectionWindow::Move);
  this->Style->AddObserver(vtkCommand::LeftButtonReleaseEvent, this, &CorrectionWindow::Release);
  for (const auto event :
    { vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent })
  {
    this->Style->AddObserver(event, this, &CorrectionWindow::TurnWheel);
  }
  this->Interactor->AddObserver(vtkCommand::KeyPressEvent, this, &CorrectionWindow::TakeKey);
  this->Interactor->AddObserver(vtkCommand::TimerEvent, this, &CorrectionWindow::ShowPreview);
  this->Interactor->CreateRepeatingTimer(Milliseconds);
  this->Views.ShowSlices(inputs.Seed);
  const std::string& error = this->Organ.GetError();
  this->Say(error.empty() ? "o, i or b, then click on what is wrong" : error);
}

void CorrectionWindow::Do(const Step& step)
{
  const bool isObeyed = this->Organ.Do(step);
  this->Say(isObeyed ? "obeyed: " + std::string(step.What->Words) : this->Organ.GetError());
}

void CorrectionWindow::Say(const std::string& words)
{
  this->Questions = this->Organ.GetQuestions();
  if (this->Asked >= this->Questions.size())
  {
    this->Asked = 0;
  }
  this->Words = words;
  this->Preview.clear();
  this->IsPreviewStale = true;
  this->Views.ShowMask(nullptr, nullptr);
  this->ShowWords();
  this->ShowMarks();
}

void CorrectionWindow::ShowWords()
{
  std::string text = "click: " + std::string(this->Now->Words) + " (o, i, b, l; u, a)";
  for (const std::string& line : { this->Preview, this->Words })
  {
    text += line.empty() ? "" : "\n" + Wrapped(line);
  }
  if (!this->Questions.empty())
  {
    text += "\n" + Wrapped(TextOf(this->Questions[this->Asked]));
    text += "\ny: yes, n: no, g: the slices go there";
  }
  this->Views.SetWords(text);
}

/// Of a click where the mouse has paused; on its way there, it would have to wait for others.
void CorrectionWindow::ShowPreview()
{
  const bool isMoving = std::exchange(this->HasMoved, false);
  if (!this->IsPreviewStale || isMoving || this->IsHeld || !this->Now->IsOfParts())
  {
    return;
  }
  this->IsPreviewStale = false;
  const int* const mouse = this->Interactor->GetEventPosition();
  Scene::Vector place;
  vtkNew<vtkImageData> changed;
  this->Preview.clear();
  const Meaning& what = *this->Now->What;
  if (this->Views.SliceAt(mouse) >= 0 && this->Views.Pick(mouse, place))
  {
    const double milliliters = this->Organ.Preview(what, place, changed);
    this->Preview = TextOfPreview(milliliters, &what == &Inside);
  }
  this->Views.ShowMask(changed->GetNumberOfPoints() > 0 ? changed.Get() : nullptr, what.Color);
  this->ShowWords();
  this->Views.GetWindow()->Render();
}

/// A ball at each point, a question mark at each question.
void CorrectionWindow::ShowMarks()
{
  std::vector<Mark> marks;
  const auto add = [&marks](const Meaning* what, const std::vector<Scene::Vector>& places)
  {
    for (const Scene::Vector& place : places)
    {
      marks.push_back({ place, what->Color, nullptr, 0 });
    }
  };
  for (const Step& step : this->Organ.GetDone())
  {
    add(step.What, step.Places);
  }
  add(this->Now->What, this->Stroke);
  for (const Question& question : this->Questions)
  {
    const bool isAsked = &question == &this->Questions[this->Asked];
    marks.push_back({ question.Place, isAsked ? Violet : Dim, "?", ReachOf(question) });
  }
  this->Views.ShowMarks(marks);
  this->Views.GetWindow()->Render();
}

/// The next one, where the slices are at one already.
void CorrectionWindow::GoToQuestion()
{
  if (this->HasGone)
  {
    this->Asked = (this->Asked + 1) % this->Questions.size();
  }
  this->HasGone = true;
  this->Views.ShowSlices(this->Questions[this->Asked].Place);
  this->Say("");
}

void CorrectionWindow::Answer(bool isPart)
{
  const Scene::Vector place = this->Questions[this->Asked].Place;
  this->Asked = 0;
  this->HasGone = false;
  this->Do({ isPart ? &Inside : &Outside, { place } });
}

void CorrectionWindow::Press()
{
  this->IsHeld = true;
  std::copy_n(this->Interactor->GetEventPosition(), 2, this->Pressed);
  this->PressedSlice = this->Views.SliceAt(this->Pressed);
  Scene::Vector place;
  if (this->PressedSlice < 0)
  {
    this->Style->OnLeftButtonDown();
  }
  else if (this->Now->IsOfParts() && this->Views.Pick(this->Pressed, place))
  {
    this->Stroke = { place };
  }
}

void CorrectionWindow::Move()
{
  if (this->Stroke.empty())
  {
    this->IsPreviewStale = true;
    this->HasMoved = true;
    this->Style->OnMouseMove();
    return;
  }
  const int* const mouse = this->Interactor->GetEventPosition();
  Scene::Vector place;
  if (this->Views.SliceAt(mouse) == this->PressedSlice && this->Views.Pick(mouse, place))
  {
    Extend(this->Stroke, place);
    this->ShowMarks();
  }
}

void CorrectionWindow::Release()
{
  this->IsHeld = false;
  this->Style->OnLeftButtonUp();
  const int* const mouse = this->Interactor->GetEventPosition();
  const bool isClick = std::abs(mouse[0] - this->Pressed[0]) <= ClickPixels &&
    std::abs(mouse[1] - this->Pressed[1]) <= ClickPixels;
  const std::vector<Scene::Vector> stroke = std::exchange(this->Stroke, {});
  Scene::Vector place;
  if (!isClick && !stroke.empty())
  {
    this->Do({ this->Now->What, stroke });
  }
  else if (isClick && this->Views.Pick(mouse, place))
  {
    this->Views.ShowSlices(place);
    this->HasGone = false;
    if (this->Now->What)
    {
      this->Do({ this->Now->What, { place } });
    }
    this->Views.GetWindow()->Render();
  }
}

/// Moves the slice under the mouse by a voxel, or the camera.
void CorrectionWindow::TurnWheel(vtkObject*, unsigned long event, void*)
{
  const bool isForward = event == vtkCommand::MouseWheelForwardEvent;
  const int view = this->Views.SliceAt(this->Interactor->GetEventPosition());
  if (view < 0)
  {
    isForward ? this->Style->OnMouseWheelForward() : this->Style->OnMouseWheelBackward();
    return;
  }
  this->Views.MoveSlice(view, isForward ? 1 : -1);
  this->Views.GetWindow()->Render();
}

void CorrectionWindow::TakeKey()
{
  const char key = this->Interactor->GetKeyCode();
  for (const Mode& mode : Modes)
  {
    if (mode.Key == key)
    {
      this->Now = &mode;
      this->Say("");
    }
  }
  switch (key)
  {
    case 'u':
      if (this->Organ.Undo())
      {
        this->Say("taken back; a brings it again");
      }
      break;
    case 'a':
      if (this->Organ.Redo())
      {
        this->Say("obeyed again: " + std::string(this->Organ.GetDone().back().What->Words));
      }
      break;
    case 'g':
    case 'y':
    case 'n':
      if (this->Questions.empty())
      {
        this->Say("there is no question");
      }
      else if (key == 'g')
      {
        this->GoToQuestion();
      }
      else
      {
        this->Answer(key == 'y');
      }
      break;
    default:
      break;
  }
}
