// The points that correct the result of vtkFlipFreeSegmentation.
#include "vtkFlipFreeSegmentation.h"

#include "ConstraintPoints.h"
#include "Error.h"
#include "LabelAdapter.h"
#include "SegmentationState.h"

#include "vtkImageData.h"
#include "vtkInformationVector.h"
#include "vtkPointSet.h"

#include <optional>

using FlipFree::ConstraintKind;

void vtkFlipFreeSegmentation::SetConstraintData(vtkPointSet* points)
{
  this->SetInputDataObject(2, points);
}

void vtkFlipFreeSegmentation::AddConstraintData(vtkPointSet* points)
{
  this->AddInputDataObject(2, points);
}

void vtkFlipFreeSegmentation::AddInsidePoint(double x, double y, double z)
{
  this->AddConstraint({ ConstraintKind::Inside, { x, y, z }, 0 });
}

void vtkFlipFreeSegmentation::AddOutsidePoint(double x, double y, double z)
{
  this->AddConstraint({ ConstraintKind::Outside, { x, y, z }, 0 });
}

void vtkFlipFreeSegmentation::AddBoundaryPoint(double x, double y, double z)
{
  this->AddConstraint({ ConstraintKind::Boundary, { x, y, z }, 0 });
}

void vtkFlipFreeSegmentation::AddSeed(double x, double y, double z, double radius)
{
  this->AddConstraint({ ConstraintKind::Seed, { x, y, z }, radius });
}

void vtkFlipFreeSegmentation::AddConstraint(const FlipFree::PointConstraint& constraint)
{
  this->Constraints->push_back(constraint);
  this->Modified();
}

int vtkFlipFreeSegmentation::GetNumberOfCorrections() const
{
  return static_cast<int>(this->Constraints->size());
}

void vtkFlipFreeSegmentation::RemoveLastCorrection()
{
  if (!this->Constraints->empty())
  {
    this->Constraints->pop_back();
    this->Modified();
  }
}

void vtkFlipFreeSegmentation::RemoveAllCorrections()
{
  if (!this->Constraints->empty())
  {
    this->Constraints->clear();
    this->Modified();
  }
}

double vtkFlipFreeSegmentation::PreviewInsidePoint(double x, double y, double z,
  vtkImageData* changed)
{
  return this->Preview({ ConstraintKind::Inside, { x, y, z }, 0 }, changed);
}

double vtkFlipFreeSegmentation::PreviewOutsidePoint(double x, double y, double z,
  vtkImageData* changed)
{
  return this->Preview({ ConstraintKind::Outside, { x, y, z }, 0 }, changed);
}

double vtkFlipFreeSegmentation::Preview(const FlipFree::PointConstraint& constraint,
  vtkImageData* changed)
{
  std::optional<std::vector<FlipFree::VoxelRun>> runs;
  try
  {
    if (this->State)
    {
      runs = this->State->Session.Preview(constraint, FlipFree::NeverStop);
    }
  }
  catch (const FlipFree::Error&)
  {
    // Update() would report it.
  }
  if (changed)
  {
    changed->Initialize();
  }
  if (!runs)
  {
    return -1;
  }
  const FlipFree::ImageGeometry& geometry = this->State->Session.GetGeometry();
  if (changed && !runs->empty())
  {
    FlipFree::MakeCroppedMap(*runs, "Changed", geometry, changed);
  }
  return static_cast<double>(FlipFree::CountVoxels(*runs)) * geometry.VoxelVolume() / 1000;
}

FlipFree::ConstraintList vtkFlipFreeSegmentation::AllConstraints(vtkInformationVector* points) const
{
  FlipFree::ConstraintList constraints = *this->Constraints;
  const auto more = FlipFree::ConstraintsOf(points, 2);
  constraints.insert(constraints.end(), more.begin(), more.end());
  return constraints;
}
