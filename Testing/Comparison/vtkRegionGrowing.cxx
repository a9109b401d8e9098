#include "vtkRegionGrowing.h"

#include "BaselineTask.h"
#include "FieldSurface.h"
#include "Intensity/LeakControl.h"
#include "ItkRegion.h"
#include "SeedStatistics.h"

#include "ExecutionAdapter.h"
#include "PropertyCheck.h"

#include "vtkObjectFactory.h"

#include "itkConfidenceConnectedImageFilter.h"

#include <cmath>

vtkStandardNewMacro(vtkRegionGrowing);

namespace
{

using ItkMask = itk::Image<unsigned char, 3>;
using Filter = itk::ConfidenceConnectedImageFilter<FlipFree::ItkImage, ItkMask>;

constexpr double SeedStandardDeviations = 2; // more is a vessel, or noise
constexpr double GrowingEnds = 0.7;

// ITK widens the interval until it holds all the seeds, so outlying voxels are not made seeds.
void AddSeeds(const FlipFree::BaselineTask& task, FlipFree::ItkImage* image, Filter* filter)
{
  const FlipFree::SeedStatistics seed =
    FlipFree::StatisticsOf(task.Region.Voxels.data(), task.SeedVoxels);
  for (const std::size_t voxel : task.SeedVoxels)
  {
    if (std::abs(task.Region.Voxels[voxel] - seed.Mean) <=
      SeedStandardDeviations * seed.StandardDeviation + 1e-6)
    {
      filter->AddSeed(image->ComputeIndex(static_cast<itk::OffsetValueType>(voxel)));
    }
  }
}

} // namespace

bool vtkRegionGrowing::Segment(const FlipFree::BaselineTask& task,
  const std::function<bool(double)>& monitor, FlipFree::BaselineResult& result)
{
  auto image = FlipFree::CopyToItk(task.Region.Voxels, task.Region.Geometry);
  auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetInitialNeighborhoodRadius(0);
  filter->SetMultiplier(this->Multiplier);
  filter->SetNumberOfIterations(static_cast<unsigned int>(this->Repetitions));
  AddSeeds(task, image, filter);
  if (!FlipFree::UpdateMonitored<Filter>(filter, FlipFree::ReportedProgress<Filter>,
        FlipFree::PartOf(monitor, 0, GrowingEnds)))
  {
    return false;
  }
  const FlipFree::ImageView<unsigned char> grown{ filter->GetOutput()->GetBufferPointer(),
    task.Region.Geometry };
  FlipFree::BitMask mask = FlipFree::VoxelsWhere(
    grown, [](unsigned char value) { return value != 0; }, FlipFree::SMPFor);
  const FlipFree::LeakControlRadii radii = FlipFree::RadiiOf(
    { this->ClosingRadius, this->OpeningScale }, task.Seeds.front().Radius, task.Region.Geometry);
  if (!FlipFree::ControlLeaks(mask, task.SeedVoxels, radii, FlipFree::SMPFor,
        FlipFree::PartOf(monitor, GrowingEnds, 1)))
  {
    return false;
  }
  result.Field = FlipFree::FieldOfMask(mask);
  result.Iterations = this->Repetitions;
  return true;
}

void vtkRegionGrowing::RequireProperties()
{
  this->Superclass::RequireProperties();
  FlipFree::RequireNumbers({ { "Multiplier", this->Multiplier },
    { "ClosingRadius", this->ClosingRadius }, { "OpeningScale", this->OpeningScale } });
}
