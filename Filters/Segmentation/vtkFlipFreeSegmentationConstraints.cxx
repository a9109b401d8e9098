// The run of vtkFlipFreeSegmentation with the points that correct it.
#include "vtkFlipFreeSegmentation.h"

#include "ConstraintPoints.h"
#include "ContourMeshAdapter.h"
#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "SegmentationResult.h"
#include "SegmentationState.h"

#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <optional>
#include <utility>

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

FlipFree::VolumeSegmentation vtkFlipFreeSegmentation::Run(vtkImageData* image, vtkPolyData* start,
  vtkPointSet* points)
{
  this->RequireProperties();
  const std::string name = "the image on port 0";
  FlipFree::RequireGrayImage(image, name);
  FlipFree::SegmentationState::Key key;
  key.Image = image;
  key.ImageTime = image->GetMTime();
  key.Start = start;
  key.StartTime = start ? start->GetMTime() : 0;
  key.ParameterTime = this->GetParameterTime();
  key.Seed = { Eigen::Vector3d(this->SeedCenter), this->SeedRadius };
  FlipFree::ConstraintList constraints = *this->Constraints;
  if (points)
  {
    const auto more = FlipFree::ConstraintsOf(points, "the point set on port 2");
    constraints.insert(constraints.end(), more.begin(), more.end());
  }
  FlipFree::TakeLargestSeed(key.Seed, constraints);
  if (!this->State || !this->State->IsOf(key))
  {
    this->State.reset(); // what follows needs the memory
    FlipFree::RequireSeed(FlipFree::GeometryOf(image), key.Seed, name);
    std::optional<FlipFree::DeformableSurface> surface;
    if (start)
    {
      surface =
        FlipFree::DeformableSurfaceOf(start, "the start surface on port 1", this->GetGuard());
    }
    this->State =
      std::make_unique<FlipFree::SegmentationState>(key, image->GetPointData()->GetScalars(),
        std::make_unique<FlipFree::VolumeSegmenter>(FlipFree::GrayVolumeOf(image, name), name,
          key.Seed, surface ? &*surface : nullptr, this->GetSettings(), FlipFree::SMPThreading()));
  }
  FlipFree::VolumeSegmentation result =
    this->State->Segmenter().Segment(constraints, FlipFree::MonitorOf(this, 0, 0.95),
      [this](const FlipFree::ContourMesh& mesh, const FlipFree::PointList& surface,
        const FlipFree::CorrespondenceField& field, const FlipFree::IterationRecord&)
      {
        if (this->KeepHistory)
        {
          this->Cache->History.Add(mesh, surface, field);
        }
      });
  if (!this->KeepForCorrections || result.Organ.Reason == FlipFree::StopReason::Aborted)
  {
    this->State.reset();
  }
  return result;
}
