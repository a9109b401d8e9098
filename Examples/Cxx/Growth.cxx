#include "Growth.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFlipFreeRefinement.h>
#include <vtkImageData.h>
#include <vtkQuadSphereSource.h>

#include <algorithm>

namespace
{

constexpr int Levels = 4;             // of the first run; the second, after carving, has as many
constexpr int FirstResolution = 4;    // vertices along the side of the cube, doubled level by level
constexpr int MaximumIterations = 40; // at each level
constexpr int Span = 5;               // iterations over which a level has to get on

/// A filter's output changes with its next update; this one stays.
vtkSmartPointer<vtkPolyData> Detached(vtkPolyData* surface)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(surface);
  return copy;
}

double NumberIn(vtkDataObject* data, const char* name)
{
  return data->GetFieldData()->GetArray(name)->GetTuple1(0);
}

} // namespace

Growth::Growth(vtkImageData* image, const std::array<double, 3>& seed, double radius)
{
  double spacing[3];
  image->GetSpacing(spacing);
  this->Voxel = *std::max_element(spacing, spacing + 3);

  // The image, smoothed where the surface can get to.
  this->Smooth->SetInputData(image);
  this->Smooth->SetSeedCenter(seed.data());
  this->Smooth->SetSeedRadius(radius);

  // How well each voxel fits the organ, from 0 to 1: first by the seed sphere's intensities.
  this->Feature->SetInputConnection(this->Smooth->GetOutputPort());
  this->Feature->SetSeedCenter(seed.data());
  this->Feature->SetSeedRadius(radius);
  this->Feature->CarvingOff(); // until there is a surface to carve

  // From each vertex along its normal to the boundary of the foreground.
  this->Search->SetFeatureConnection(this->Feature->GetOutputPort());

  // Towards these targets, but never so that a face flips or the surface meets itself.
  this->Deform->SetInputConnection(this->Search->GetOutputPort());

  vtkNew<vtkQuadSphereSource> sphere;
  sphere->SetCenter(seed.data());
  sphere->SetRadius(radius);
  sphere->SetResolution(FirstResolution);
  sphere->Update();
  this->Start = sphere->GetOutput();
  this->Surface = this->Start;
}

bool Growth::HasConverged() const
{
  return this->Level == 2 * Levels - 1 && this->IsLevelDone();
}

bool Growth::Step()
{
  if (this->IsLevelDone() && !this->NextLevel())
  {
    return false;
  }
  this->Search->SetInputData(this->Surface);
  this->Deform->Update();
  if (this->Deform->GetOutput()->GetNumberOfPoints() == 0)
  {
    return false;
  }
  this->Surface = Detached(this->Deform->GetOutput());
  this->MeanDistance = NumberIn(this->Search->GetOutput(), "MeanDistance");
  this->FlippingVertices = static_cast<int>(NumberIn(this->Surface, "FlippingVertices"));
  this->GuardedVertices = static_cast<int>(NumberIn(this->Surface, "GuardedVertices"));
  this->Distances.push_back(this->MeanDistance);
  return true;
}

bool Growth::IsLevelDone() const
{
  const std::size_t done = this->Distances.size();
  return this->Level < 0 || done == MaximumIterations ||
    (done > Span && this->Distances[done - 1 - Span] - this->Distances.back() < 0.02 * this->Voxel);
}

bool Growth::NextLevel()
{
  ++this->Level;
  this->Distances.clear();
  if (this->Level == Levels)
  {
    // What has leaked is carved off, and the surface grows again within what remains.
    this->Feature->CarvingOn();
    this->Feature->SetSurfaceData(this->Surface);
    this->Surface = this->Start;
  }
  else if (this->Level > 0)
  {
    vtkNew<vtkFlipFreeRefinement> refine;
    refine->SetInputData(this->Surface);
    refine->Update();
    this->Surface = refine->GetOutput();
    if (this->Level < Levels)
    {
      // By now the surface knows the organ better than the seed did.
      this->Feature->SetSurfaceData(this->Surface);
    }
  }
  // The last millimeter: to the strongest edge. What is carved ends there of itself.
  this->Search->SetEdgeConnection(
    this->Level == Levels - 1 ? this->Smooth->GetOutputPort() : nullptr);
  this->Feature->Update();
  return this->Surface->GetNumberOfPoints() > 0 &&
    this->Feature->GetOutput()->GetNumberOfPoints() > 0;
}
