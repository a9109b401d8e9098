// The points that correct the result of vtkFlipFreeSegmentation.
#include "vtkFlipFreeSegmentation.h"

#include "ConstraintPoints.h"

#include "vtkPointSet.h"

using FlipFree::ConstraintKind;

void vtkFlipFreeSegmentation::SetConstraintData(vtkPointSet* points)
{
  this->SetInputDataObject(2, points);
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

// The time of the parameters stays, so that what constraints do not change can be kept.
void vtkFlipFreeSegmentation::AddConstraint(const FlipFree::PointConstraint& constraint)
{
  this->Constraints->push_back(constraint);
  this->ConstraintTime.Modified();
}

int vtkFlipFreeSegmentation::GetNumberOfAddedPoints() const
{
  return static_cast<int>(this->Constraints->size());
}

void vtkFlipFreeSegmentation::RemoveLastPoint()
{
  if (!this->Constraints->empty())
  {
    this->Constraints->pop_back();
    this->ConstraintTime.Modified();
  }
}

void vtkFlipFreeSegmentation::RemoveAllPoints()
{
  if (!this->Constraints->empty())
  {
    this->Constraints->clear();
    this->ConstraintTime.Modified();
  }
}

FlipFree::ConstraintList vtkFlipFreeSegmentation::AllConstraints(vtkPointSet* points) const
{
  FlipFree::ConstraintList constraints = *this->Constraints;
  if (points)
  {
    const auto more = FlipFree::ConstraintsOf(points, "the point set on port 2");
    constraints.insert(constraints.end(), more.begin(), more.end());
  }
  return constraints;
}
