#include "ThreeViews.h"

#include <vtkCellPicker.h>
#include <vtkCoordinate.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace
{

constexpr double BallRadius = 4; // mm
const Scene::Plane* const Planes[2] = { &Scene::Axial, &Scene::Coronal };

/// Across a slice.
constexpr int AxisOf(int view)
{
  return view == 0 ? 2 : 1;
}

vtkSmartPointer<vtkProp> PropOf(const Mark& mark)
{
  if (mark.Letter)
  {
    const auto letter = Scene::TextActor(mark.Letter, 26);
    letter->GetPositionCoordinate()->SetCoordinateSystemToWorld();
    letter->GetPositionCoordinate()->SetValue(mark.Place[0], mark.Place[1], mark.Place[2]);
    vtkTextProperty* look = letter->GetTextProperty();
    look->SetColor(mark.Color[0], mark.Color[1], mark.Color[2]);
    look->SetJustificationToCentered();
    look->SetVerticalJustificationToCentered();
    look->BoldOn();
    look->ShadowOn();
    look->SetBackgroundOpacity(0); // the tissue there is what one judges
    return letter;
  }
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(mark.Place[0], mark.Place[1], mark.Place[2]);
  ball->SetRadius(BallRadius);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(mark.Color[0], mark.Color[1], mark.Color[2]);
  return actor;
}

} // namespace

ThreeViews::ThreeViews(vtkImageData* image, vtkPolyData* surface, double share, double zoom)
  : Image(image)
  , Surface(surface)
{
  const double* bounds = image->GetBounds();
  this->SurfaceShown = Scene::SurfaceActor(surface);
  this->Space = Scene::SpaceView({ this->SurfaceShown }, bounds, "", zoom);
  this->Words = Scene::TextActor("", 15);
  this->Space->AddViewProp(this->Words);
  this->Space->SetViewport(0, 0, share, 1);
  this->Window->AddRenderer(this->Space);
  for (int view = 0; view < 2; ++view)
  {
    this->Slices[view] = Scene::SliceView({}, bounds, *Planes[view], "", 1.05);
    this->Slices[view]->SetViewport(share, view == 0 ? 0.5 : 0, 1, view == 0 ? 1 : 0.5);
    this->Slices[view]->InteractiveOff();
    this->Window->AddRenderer(this->Slices[view]);
  }
  this->Window->SetWindowName("FlipFree");
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(1200, 800);
}

void ThreeViews::SetWords(const std::string& words)
{
  this->Words->SetInput(words.c_str());
}

void ThreeViews::Show(PropsIn& shown, vtkRenderer* view, vtkProp* prop)
{
  shown.emplace_back(view, prop);
  view->AddViewProp(prop);
  view->ResetCameraClippingRange();
}

void ThreeViews::Clear(PropsIn& shown)
{
  for (const auto& [view, prop] : shown)
  {
    view->RemoveViewProp(prop);
  }
  shown.clear();
}

void ThreeViews::ShowSlices(const Scene::Vector& place)
{
  this->Place = place;
  Clear(this->OfSlices);
  Clear(this->OfMask);
  for (int view = 0; view < 2; ++view)
  {
    this->Pictures[view] = Scene::SliceActor(this->Image, place, *Planes[view], 200);
    Show(this->OfSlices, this->Slices[view], this->Pictures[view]);
    Show(this->OfSlices, this->Space, this->Pictures[view]);
    Show(this->OfSlices, this->Slices[view],
      Scene::ContourActor(this->Surface, place, *Planes[view], Scene::Yellow, 2));
  }
  this->ShowMarks(this->Marks);
}

void ThreeViews::MoveSlice(int view, double voxels)
{
  const int axis = AxisOf(view);
  const double* bounds = this->Image->GetBounds();
  Scene::Vector place = this->Place;
  const double moved = place[axis] + voxels * this->Image->GetSpacing()[axis];
  place[axis] = std::min(std::max(moved, bounds[2 * axis]), bounds[2 * axis + 1]);
  this->ShowSlices(place);
}

void ThreeViews::ShowMarks(const std::vector<Mark>& marks)
{
  this->Marks = marks;
  Clear(this->OfMarks);
  for (const Mark& mark : marks)
  {
    // A letter knows only one view's coordinates.
    Show(this->OfMarks, this->Space, PropOf(mark));
    for (int view = 0; view < 2; ++view)
    {
      const int axis = AxisOf(view);
      if (std::abs(mark.Place[axis] - this->Place[axis]) < std::max(mark.Reach, BallRadius))
      {
        Show(this->OfMarks, this->Slices[view], PropOf(mark));
      }
    }
  }
}

void ThreeViews::ShowMask(vtkImageData* mask, const double color[3])
{
  Clear(this->OfMask);
  for (int view = 0; mask && view < 2; ++view)
  {
    Show(this->OfMask, this->Slices[view],
      Scene::MaskActor(mask, this->Place, *Planes[view], color));
  }
}

int ThreeViews::SliceAt(const int pixel[2]) const
{
  for (int view = 0; view < 2; ++view)
  {
    if (this->Slices[view]->IsInViewport(pixel[0], pixel[1]))
    {
      return view;
    }
  }
  return -1;
}

bool ThreeViews::Pick(const int pixel[2], Scene::Vector& place) const
{
  const int view = this->SliceAt(pixel);
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
  if (!picker->Pick(pixel[0], pixel[1], 0, view >= 0 ? this->Slices[view] : this->Space))
  {
    return false;
  }
  picker->GetPickPosition(place.data());
  return true;
}
