#include "vtkSimplexMeshSegmentation.h"

#include "BaselineTask.h"
#include "ItkRegion.h"
#include "SeedStatistics.h"
#include "SimplexBalloon.h"

#include "Image/ImageInterpolation.h"
#include "Image/VoxelTraversal.h"
#include "PropertyCheck.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSimplexMeshSegmentation);

namespace
{

// The balloon force in space. It owns what it reads: after an abort the mesh moves on for a moment.
FlipFree::SimplexBalloon::Force BalloonForce(const FlipFree::BaselineTask& task, double width,
  double step)
{
  const FlipFree::IntensityInterval interval = FlipFree::IntervalOf(task, width);
  const FlipFree::VoxelGrid grid(task.Region.Geometry);
  const auto voxels = std::make_shared<const std::vector<float>>(task.Region.Voxels);
  return [interval, grid, voxels, step](const Eigen::Vector3d& point)
  {
    const auto speed = [&interval](const Eigen::Array4d& values) -> Eigen::Array4d
    { return values.unaryExpr([&interval](double value) { return interval.Speed(value); }); };
    const Eigen::Vector3d index = grid.ToIndex(point);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (index[axis] < -0.5 || index[axis] > grid.Geometry.Dimensions[axis] - 0.5)
      {
        return -step;
      }
    }
    return step *
      FlipFree::InterpolateClamped(FlipFree::ImageView<float>{ voxels->data(), grid.Geometry },
        index, speed);
  };
}

} // namespace

bool vtkSimplexMeshSegmentation::Segment(const FlipFree::BaselineTask& task,
  const std::function<bool(double)>& monitor, FlipFree::BaselineResult& result)
{
  const FlipFree::SeedSphere& seed = FlipFree::OnlySeedOf(task);
  const FlipFree::SimplexMesh start =
    FlipFree::MakeSimplexSphere(this->Resolution, seed.Center, seed.Radius);
  auto filter = FlipFree::SimplexBalloon::New();
  filter->SetStart(start);
  filter->SetForce(BalloonForce(task, this->IntensityWidth, this->BalloonStep));
  filter->SetAlpha(this->Stiffness);
  filter->SetRigidity(static_cast<unsigned int>(this->Rigidity));
  filter->SetIterations(this->MaximumIterations);
  filter->SetVolumeTolerance(this->VolumeTolerance);
  if (!FlipFree::UpdateMonitored<FlipFree::SimplexBalloon>(filter,
        FlipFree::ReportedProgress<FlipFree::SimplexBalloon>, monitor))
  {
    return false;
  }
  result.Points = filter->GetSurfacePoints();
  result.Triangles = start.Triangles;
  result.Iterations = filter->GetElapsedIterations();
  return true;
}

void vtkSimplexMeshSegmentation::RequireProperties()
{
  this->Superclass::RequireProperties();
  FlipFree::RequireNumbers(
    { { "IntensityWidth", this->IntensityWidth }, { "BalloonStep", this->BalloonStep },
      { "Stiffness", this->Stiffness }, { "VolumeTolerance", this->VolumeTolerance } });
}
