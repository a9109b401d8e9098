#include "Scene.h"

#include <vtkCamera.h>
#include <vtkClipPolyData.h>
#include <vtkCutter.h>
#include <vtkImageConstantPad.h>
#include <vtkImageShrink3D.h>
#include <vtkLogger.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProbeFilter.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkStripper.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <iostream>

namespace Scene
{
namespace
{

constexpr int Finer = 2; // drawn this many times as large and scaled down, for smooth lines
constexpr double Ink[3] = { 0.045, 0.05, 0.06 };
constexpr double Frame[3] = { 0.2, 0.21, 0.24 };

Vector NormalOf(const Plane& plane)
{
  Vector normal;
  vtkMath::Cross(plane.Right.data(), plane.Up.data(), normal.data());
  return normal;
}

Vector CenterOf(const double bounds[6])
{
  return { (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, (bounds[4] + bounds[5]) / 2 };
}

/// The corner of the bounds' box, in the plane through the center, at the ends of both directions.
Vector CornerOf(const double bounds[6], const Vector& center, const Plane& plane, bool isRight,
  bool isUp)
{
  Vector corner = center;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (plane.Right[axis] != 0)
    {
      corner[axis] = bounds[2 * axis + ((plane.Right[axis] > 0) == isRight)];
    }
    if (plane.Up[axis] != 0)
    {
      corner[axis] = bounds[2 * axis + ((plane.Up[axis] > 0) == isUp)];
    }
  }
  return corner;
}

vtkSmartPointer<vtkRenderer> MakeView(const Actors& actors, const std::string& caption)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(Ink[0], Ink[1], Ink[2]);
  for (const auto& actor : actors)
  {
    renderer->AddActor(actor);
  }
  if (!caption.empty())
  {
    renderer->AddViewProp(TextActor(caption));
  }
  return renderer;
}

/// An image's values in the slice through a point, over its bounds.
vtkSmartPointer<vtkProbeFilter> Sampled(vtkImageData* image, const Vector& center,
  const Plane& plane, int samples)
{
  const double* bounds = image->GetBounds();
  vtkNew<vtkPlaneSource> grid;
  grid->SetOrigin(CornerOf(bounds, center, plane, false, false).data());
  grid->SetPoint1(CornerOf(bounds, center, plane, true, false).data());
  grid->SetPoint2(CornerOf(bounds, center, plane, false, true).data());
  grid->SetResolution(samples, samples);
  auto probe = vtkSmartPointer<vtkProbeFilter>::New(); // knows direction matrices
  probe->SetInputConnection(grid->GetOutputPort());
  probe->SetSourceData(image);
  return probe;
}

} // namespace

vtkSmartPointer<vtkActor> SurfaceActor(vtkPolyData* surface, const double color[3])
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  look->SetColor(color[0], color[1], color[2]);
  look->SetInterpolationToPhong();
  look->SetAmbient(0.1);
  look->SetDiffuse(0.85);
  look->SetSpecular(0.2);
  look->SetSpecularPower(25);
  look->EdgeVisibilityOn();
  look->SetEdgeColor(color[0] / 2, color[1] / 2, color[2] / 2);
  return actor;
}

vtkSmartPointer<vtkActor> SliceActor(vtkImageData* image, const Vector& center, const Plane& plane,
  int samples)
{
  vtkNew<vtkLookupTable> gray;
  gray->SetSaturationRange(0, 0);
  gray->SetValueRange(0, 1);
  gray->SetRampToLinear();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(Sampled(image, center, plane, samples)->GetOutputPort());
  mapper->SetLookupTable(gray);
  mapper->SetScalarRange(-150, 250);
  mapper->InterpolateScalarsBeforeMappingOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> MaskActor(vtkImageData* mask, const Vector& center, const Plane& plane,
  const double color[3])
{
  int extent[6];
  mask->GetExtent(extent);
  for (int side = 0; side < 6; ++side)
  {
    extent[side] += side % 2 == 0 ? -1 : 1; // a rim around a single voxel, too
  }
  vtkNew<vtkImageConstantPad> rim;
  rim->SetInputData(mask);
  rim->SetOutputWholeExtent(extent);
  rim->Update();
  vtkImageData* const padded = rim->GetOutput();
  padded->SetDirectionMatrix(mask->GetDirectionMatrix()); // which VTK 9.1 drops
  vtkNew<vtkClipPolyData> part;
  part->SetInputConnection(Sampled(padded, center, plane, 150)->GetOutputPort());
  part->SetValue(0.5);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(part->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  const Vector normal = NormalOf(plane);
  actor->SetPosition(normal[0] / 2, normal[1] / 2, normal[2] / 2); // in front of the slice
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor->GetProperty()->SetOpacity(0.5);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> ContourActor(vtkPolyData* surface, const Vector& center,
  const Plane& plane, const double color[3], double width)
{
  Vector normal = NormalOf(plane);
  vtkNew<vtkPlane> cutting;
  cutting->SetOrigin(center.data());
  cutting->SetNormal(normal.data());
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_WARNING); // VTK 9.3's cutter says that it runs
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(surface);
  cutter->SetCutFunction(cutting);
  vtkNew<vtkStripper> lines; // joined, so that there are no gaps between their ends
  lines->SetInputConnection(cutter->GetOutputPort());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(lines->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetPosition(normal.data()); // in front of the slice
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  return actor;
}

vtkSmartPointer<vtkTextActor> TextActor(const std::string& words, int size)
{
  auto text = vtkSmartPointer<vtkTextActor>::New();
  text->SetInput(words.c_str());
  text->SetPosition(0.5 * size, 0.5 * size);
  vtkTextProperty* look = text->GetTextProperty();
  look->SetFontSize(size);
  look->SetColor(0.92, 0.92, 0.92);
  look->SetBackgroundColor(Ink[0], Ink[1], Ink[2]);
  look->SetBackgroundOpacity(0.6);
  return text;
}

vtkSmartPointer<vtkRenderer> SliceView(const Actors& actors, const double bounds[6],
  const Plane& plane, const std::string& caption, double margin)
{
  auto renderer = MakeView(actors, caption);
  const Vector center = CenterOf(bounds);
  const Vector normal = NormalOf(plane);
  const double side =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(center.data());
  camera->SetPosition(center[0] + 1000 * normal[0], center[1] + 1000 * normal[1],
    center[2] + 1000 * normal[2]);
  camera->SetViewUp(plane.Up.data());
  camera->SetParallelScale(margin * side / 2);
  renderer->ResetCameraClippingRange();
  return renderer;
}

vtkSmartPointer<vtkRenderer> SpaceView(const Actors& actors, const double bounds[6],
  const std::string& caption, double zoom)
{
  auto renderer = MakeView(actors, caption);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(-0.35, -1, 0.3);
  camera->SetViewUp(0, 0, 1);
  renderer->ResetCamera(bounds);
  camera->Zoom(zoom);
  renderer->ResetCameraClippingRange();
  return renderer;
}

void WritePicture(const std::string& name,
  const std::vector<std::vector<vtkSmartPointer<vtkRenderer>>>& rows, int size)
{
  const double height = static_cast<double>(rows.size());
  const double width = static_cast<double>(rows.front().size());
  const double gap = 1.5 / size; // through which the frame shows
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(static_cast<int>(Finer * size * width), static_cast<int>(Finer * size * height));
  vtkNew<vtkRenderer> frame;
  frame->SetBackground(Frame[0], Frame[1], Frame[2]);
  window->AddRenderer(frame);
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    const double bottom = height - 1 - static_cast<double>(row);
    for (std::size_t column = 0; column < rows[row].size(); ++column)
    {
      const double left = static_cast<double>(column);
      rows[row][column]->SetViewport((left + gap) / width, (bottom + gap) / height,
        (left + 1 - gap) / width, (bottom + 1 - gap) / height);
      window->AddRenderer(rows[row][column]);
    }
  }
  window->Render();

  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection(picture->GetOutputPort());
  shrink->SetShrinkFactors(Finer, Finer, 1);
  shrink->MeanOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(shrink->GetOutputPort());
  writer->SetFileName(name.c_str());
  writer->Write();
  std::cout << "picture: " << name << "\n";
}

void SaveWindow(vtkRenderWindow* window, const std::string& name)
{
  vtkNew<vtkWindowToImageFilter> shot;
  shot->SetInput(window);
  shot->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(shot->GetOutputPort());
  writer->SetFileName(name.c_str());
  writer->Write();
}

} // namespace Scene
