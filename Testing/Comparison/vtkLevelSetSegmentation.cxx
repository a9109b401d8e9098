#include "vtkLevelSetSegmentation.h"

#include "BaselineTask.h"
#include "EdgeGradient.h"
#include "ItkRegion.h"
#include "SeedStatistics.h"
#include "SettlingLevelSet.h"

#include "ExecutionAdapter.h"
#include "PropertyCheck.h"

#include "vtkObjectFactory.h"

// Ahead of ITK's own Eigen, of another version, whose header has the same guard.
#include <Eigen/Eigenvalues>

#include "itkGeodesicActiveContourLevelSetImageFilter.h"
#include "itkReinitializeLevelSetImageFilter.h"
#include "itkThresholdSegmentationLevelSetImageFilter.h"

#include <algorithm>
#include <cmath>
#include <functional>

vtkStandardNewMacro(vtkLevelSetSegmentation);

namespace
{

using FlipFree::ItkImage;
using ThresholdFilter = FlipFree::SettlingLevelSet<
  itk::ThresholdSegmentationLevelSetImageFilter<ItkImage, ItkImage, float>>;
using GeodesicFilter = FlipFree::SettlingLevelSet<
  itk::GeodesicActiveContourLevelSetImageFilter<ItkImage, ItkImage, float>>;
using DistanceFilter = itk::ReinitializeLevelSetImageFilter<ItkImage>;

constexpr double CurvatureOfThreshold = 2;
constexpr double CurvatureOfGeodesic = 0.5;
// Shares of the progress.
constexpr double EdgesEnd = 0.1;
constexpr double EvolutionEnds = 0.95;

// Negative inside the seeds.
ItkImage::Pointer SeedFunction(const FlipFree::BaselineTask& task)
{
  const FlipFree::ImageGeometry& geometry = task.Region.Geometry;
  auto image = FlipFree::NewItkImage(geometry);
  FlipFree::SMPFor(0, geometry.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      float* value = image->GetBufferPointer() + geometry.Offset(0, 0, static_cast<int>(first));
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < geometry.Dimensions[1]; ++j)
        {
          for (int i = 0; i < geometry.Dimensions[0]; ++i)
          {
            const Eigen::Vector3d point = geometry.ToPhysical(Eigen::Vector3d(i, j, k));
            double distance = HUGE_VAL;
            for (const FlipFree::SeedSphere& seed : task.Seeds)
            {
              distance = std::min(distance, (point - seed.Center).norm() - seed.Radius);
            }
            *value++ = static_cast<float>(distance);
          }
        }
      }
    });
  return image;
}

ItkImage::Pointer ThresholdSpeed(const FlipFree::BaselineTask& task, double width)
{
  const FlipFree::IntensityInterval interval = FlipFree::IntervalOf(task, width);
  auto image = FlipFree::NewItkImage(task.Region.Geometry);
  std::transform(task.Region.Voxels.begin(), task.Region.Voxels.end(), image->GetBufferPointer(),
    [&interval](float value) { return static_cast<float>(interval.Speed(value)); });
  return image;
}

// Moves the front outward. The level set function is not a distance: it counts the least
// spacing for a voxel on any axis, and stops at four of them. False if the monitor stopped it.
bool MoveOutward(ItkImage::Pointer& level, double width, const FlipFree::Monitor& monitor)
{
  const auto& spacing = level->GetSpacing();
  const double known = width + *std::max_element(spacing.Begin(), spacing.End());
  auto filter = DistanceFilter::New();
  filter->SetInput(level);
  filter->NarrowBandingOn();
  filter->SetOutputNarrowBandwidth(2 * known); // to either side
  if (!FlipFree::UpdateMonitored<DistanceFilter>(filter, FlipFree::ReportedProgress<DistanceFilter>,
        monitor))
  {
    return false;
  }
  level = filter->GetOutput();
  level->DisconnectPipeline();
  float* const begin = level->GetBufferPointer();
  std::transform(begin, begin + level->GetBufferedRegion().GetNumberOfPixels(), begin,
    [=](double distance)
    { return static_cast<float>(std::max(-known, std::min(known, distance)) - width); });
  return true;
}

// Runs the level set and takes its result over. False if the monitor stopped it.
template <typename TFilter>
bool Evolve(const FlipFree::BaselineTask& task, TFilter* filter, double rimWidth,
  const FlipFree::Monitor& monitor, FlipFree::BaselineResult& result)
{
  filter->SetInput(SeedFunction(task));
  filter->SetMaximumRMSError(0);
  filter->SetUseImageSpacing(true);
  const auto progress = [](const TFilter* running)
  {
    return static_cast<double>(running->GetElapsedIterations()) /
      static_cast<double>(running->GetNumberOfIterations());
  };
  if (!FlipFree::UpdateMonitored<TFilter>(filter, progress,
        FlipFree::PartOf(monitor, 0, EvolutionEnds)))
  {
    return false;
  }
  ItkImage::Pointer level = filter->GetOutput();
  level->DisconnectPipeline();
  if (rimWidth > 0 && !MoveOutward(level, rimWidth, FlipFree::PartOf(monitor, EvolutionEnds, 1)))
  {
    return false;
  }
  const float* const value = level->GetBufferPointer();
  result.Field.resize(task.Region.Voxels.size());
  std::transform(value, value + result.Field.size(), result.Field.begin(), std::negate<>());
  result.Iterations = static_cast<int>(filter->GetElapsedIterations());
  return true;
}

} // namespace

bool vtkLevelSetSegmentation::Segment(const FlipFree::BaselineTask& task,
  const std::function<bool(double)>& monitor, FlipFree::BaselineResult& result)
{
  const double curvature = this->CurvatureScaling > 0
    ? this->CurvatureScaling
    : (this->Speed == THRESHOLD ? CurvatureOfThreshold : CurvatureOfGeodesic);
  const auto configure = [this, curvature](auto filter)
  {
    filter->SetPropagationScaling(1); // outward, where negative is inside
    filter->SetCurvatureScaling(static_cast<float>(curvature));
    filter->SetNumberOfIterations(static_cast<unsigned int>(this->MaximumIterations));
    filter->SetVolumeTolerance(this->VolumeTolerance);
    return filter;
  };
  if (this->Speed == THRESHOLD)
  {
    auto filter = configure(ThresholdFilter::New());
    auto speed = ThresholdSpeed(task, this->IntensityWidth);
    filter->SetFeatureImage(speed); // required, but not looked at: the speed is given
    filter->AutoGenerateSpeedAdvectionOff();
    filter->GetSegmentationFunction()->SetSpeedImage(speed);
    return Evolve<ThresholdFilter>(task, filter, this->RimWidth, monitor, result);
  }
  FlipFree::RequireGaussianWidth(task.Region.Geometry, 3);
  // 1 in flat parts of the image, a half where the gradient is EdgeContrast times the seed's mean,
  // 0 at strong edges.
  auto potential =
    FlipFree::MapGradient<ItkImage>(FlipFree::CopyToItk(task.Region.Voxels, task.Region.Geometry),
      this->EdgeSigma, this->EdgeContrast, task.SeedVoxels, FlipFree::PartOf(monitor, 0, EdgesEnd),
      [](double squared) { return 1 / (1 + squared * squared); });
  if (!potential)
  {
    return false;
  }
  auto filter = configure(GeodesicFilter::New());
  filter->SetFeatureImage(potential);
  filter->SetAdvectionScaling(static_cast<float>(this->AdvectionScaling));
  return Evolve<GeodesicFilter>(task, filter, 0, FlipFree::PartOf(monitor, EdgesEnd, 1), result);
}

void vtkLevelSetSegmentation::RequireProperties()
{
  this->Superclass::RequireProperties();
  FlipFree::RequireNumbers({ { "IntensityWidth", this->IntensityWidth },
    { "CurvatureScaling", this->CurvatureScaling }, { "AdvectionScaling", this->AdvectionScaling },
    { "EdgeSigma", this->EdgeSigma }, { "EdgeContrast", this->EdgeContrast },
    { "RimWidth", this->RimWidth }, { "VolumeTolerance", this->VolumeTolerance } });
}
