// The points that correct the result of vtkFlipFreeSegmentation.
#include "vtkFlipFreeSegmentation.h"

#include "ConstraintPoints.h"

#include "vtkInformationVector.h"
#include "vtkPointSet.h"

using FlipFree::ConstraintKind;

void vtkFlipFreeSegmentation::SetConstraintConnection(vtkAlgorithmOutput* output)
{
  const vtkMTimeType before = this->GetOwnTime();
  this->SetInputConnection(2, output);
  this->NoteConnection(before);
}

void vtkFlipFreeSegmentation::SetConstraintData(vtkPointSet* points)
{
  const vtkMTimeType before = this->GetOwnTime();
  this->SetInputDataObject(2, points);
  this->NoteConnection(before);
}

void vtkFlipFreeSegmentation::AddConstraintConnection(vtkAlgorithmOutput* output)
{
  const vtkMTimeType before = this->GetOwnTime();
  this->AddInputConnection(2, output);
  this->NoteConnection(before);
}

void vtkFlipFreeSegmentation::AddConstraintData(vtkPointSet* points)
{
  const vtkMTimeType before = this->GetOwnTime();
  this->AddInputDataObject(2, points);
  this->NoteConnection(before);
}

void vtkFlipFreeSegmentation::RemoveAllConstraintConnections()
{
  const vtkMTimeType before = this->GetOwnTime();
  this->RemoveAllInputConnections(2);
  this->NoteConnection(before);
}

// Connecting points modifies this filter, but not its parameters, which stay as old as they were,
// so that what constraints do not change can be kept.
void vtkFlipFreeSegmentation::NoteConnection(vtkMTimeType before)
{
  this->TimeBeforeConnection = before;
  this->ConnectionTime = this->Superclass::GetMTime();
}

vtkMTimeType vtkFlipFreeSegmentation::GetOwnTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return time == this->ConnectionTime ? this->TimeBeforeConnection : time;
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

FlipFree::ConstraintList vtkFlipFreeSegmentation::AllConstraints(vtkInformationVector* points) const
{
  FlipFree::ConstraintList constraints = *this->Constraints;
  const auto more = FlipFree::ConstraintsOf(points, 2);
  constraints.insert(constraints.end(), more.begin(), more.end());
  return constraints;
}
