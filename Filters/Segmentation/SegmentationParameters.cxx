#include "SegmentationParameters.h"

#include "ExecutionAdapter.h"
#include "PropertyCheck.h"

#include "vtkFlipFreeSegmentation.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Lengths beyond these help on no organ, whatever the seed.
constexpr int MinimumResolution = 2;
constexpr double MinimumReach = 100;
constexpr double MaximumReach = 250;
constexpr double ReachInRadii = 10;
constexpr double UsualSearchInRadii = 1.6; // SearchScale by default
constexpr double MinimumSearch = 15;
constexpr double MaximumSearch = 60;
constexpr double MinimumOpening = 2.5;
constexpr double MaximumOpening = 6;
constexpr double MaximumVoxelsOpened = 2;
constexpr double MaximumVoxelsOfEdgeWindow = 1.5;

double Clamp(double value, double least, double greatest)
{
  return std::max(least, std::min(greatest, value));
}

double SearchDistanceBy(double scale, double radius)
{
  return Clamp(scale * radius, MinimumSearch, MaximumSearch);
}

double SearchDistanceOf(vtkFlipFreeSegmentation* filter)
{
  return filter->GetSearchDistance() > 0
    ? filter->GetSearchDistance()
    : SearchDistanceBy(filter->GetSearchScale(), filter->GetSeedRadius());
}

} // namespace

void RequireParameters(vtkFlipFreeSegmentation* filter)
{
  const double* offset = filter->GetStartCenterOffset();
  RequireNumbers({ { "StartScale", filter->GetStartScale() },
    { "DistanceTolerance", filter->GetDistanceTolerance() },
    { "ChangeTolerance", filter->GetChangeTolerance() }, { "Reach", filter->GetReach() },
    { "MinimumComponentWeight", filter->GetMinimumComponentWeight() },
    { "ForegroundMass", filter->GetForegroundMass() },
    { "FeatureThreshold", filter->GetFeatureThreshold() },
    { "NoiseWidening", filter->GetNoiseWidening() },
    { "ClosingRadius", filter->GetClosingRadius() }, { "OpeningScale", filter->GetOpeningScale() },
    { "SearchScale", filter->GetSearchScale() }, { "SearchDistance", filter->GetSearchDistance() },
    { "RunLength", filter->GetRunLength() }, { "EdgeWindow", filter->GetEdgeWindow() },
    { "ImageBoundaryDistance", filter->GetImageBoundaryDistance() },
    { "OutlierStandardDeviations", filter->GetOutlierStandardDeviations() },
    { "MaximumDisplacement", filter->GetMaximumDisplacement() },
    { "FlipThreshold", filter->GetFlipThreshold() },
    { "PositionWeight", filter->GetPositionWeight() },
    { "UniformWeight", filter->GetUniformWeight() }, { "Fairing", filter->GetFairing() },
    { "StartCenterOffset", offset[0] + offset[1] + offset[2] } });
}

int LevelsOf(vtkFlipFreeSegmentation* filter)
{
  int levels = filter->GetLevels();
  while (levels > 1 && filter->GetResolution() >> (levels - 1) < MinimumResolution)
  {
    --levels;
  }
  return levels;
}

int FirstResolution(vtkFlipFreeSegmentation* filter)
{
  return filter->GetResolution() >> (LevelsOf(filter) - 1);
}

double ReachOf(vtkFlipFreeSegmentation* filter)
{
  return filter->GetReach() > 0
    ? filter->GetReach()
    : Clamp(ReachInRadii * filter->GetSeedRadius(), MinimumReach, MaximumReach);
}

bool ReachesEndOf(const ImageGeometry& region, const ImageGeometry& image, const PointList& points)
{
  // Voxels of the image before and behind the region, along each axis.
  const Eigen::Vector3d first = image.ToIndex(region.ToPhysical(Eigen::Vector3d::Zero()));
  for (int axis = 0; axis < 3; ++axis)
  {
    const double size = region.Dimensions[axis];
    const bool isCutBelow = first[axis] > 0.5;
    const bool isCutAbove = first[axis] + size < image.Dimensions[axis] - 0.5;
    for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
    {
      const double index = region.ToIndex(points.row(vertex).transpose())[axis];
      if ((isCutBelow && index < 0) || (isCutAbove && index > size - 1))
      {
        return true;
      }
    }
  }
  return false;
}

double FractionAtEndsOf(const ImageGeometry& image, const PointList& points)
{
  const Eigen::Array3d last(image.Dimensions[0] - 1, image.Dimensions[1] - 1,
    image.Dimensions[2] - 1);
  // At the ends of each axis, and at those of each of the two others.
  Eigen::Array3i ofAxis = Eigen::Array3i::Zero();
  Eigen::Array3i ofOthers = Eigen::Array3i::Zero();
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    const Eigen::Array3d index = image.ToIndex(points.row(vertex).transpose());
    const Eigen::Array<bool, 3, 1> atEnd = index < 0.5 || index > last - 0.5;
    for (int axis = 0; axis < 3; ++axis)
    {
      ofAxis[axis] += atEnd[axis];
      ofOthers[axis] += atEnd[(axis + 1) % 3] || atEnd[(axis + 2) % 3];
    }
  }
  Eigen::Index most = 0;
  ofAxis.maxCoeff(&most);
  return ofOthers[most] / static_cast<double>(points.rows());
}

bool SearchesFar(vtkFlipFreeSegmentation* filter)
{
  return SearchDistanceOf(filter) >= SearchDistanceBy(UsualSearchInRadii, filter->GetSeedRadius());
}

AnisotropicDiffusionSettings DiffusionSettingsOf(vtkFlipFreeSegmentation* filter, double noise,
  const ImageGeometry& geometry)
{
  AnisotropicDiffusionSettings settings;
  settings.Iterations = filter->GetDiffusionIterations();
  settings.Equation = static_cast<DiffusionEquation>(filter->GetDiffusionEquation());
  settings.Contrast = ContrastOfNoise(noise, geometry, settings.Equation);
  settings.Threads = NumberOfThreads();
  return settings;
}

OrganSegmentationSettings SettingsOf(vtkFlipFreeSegmentation* filter, const ImageGeometry& geometry)
{
  const double voxel = geometry.Spacing.maxCoeff();
  const double radius = filter->GetSeedRadius();
  OrganSegmentationSettings settings;
  settings.Levels = LevelsOf(filter);
  settings.MaximumIterations = filter->GetMaximumIterations();
  settings.DistanceTolerance = voxel * filter->GetDistanceTolerance();
  settings.ChangeTolerance = voxel * filter->GetChangeTolerance();
  settings.ReestimateIntensities = filter->GetReestimateIntensities();
  settings.Guard = filter->GetGuard();

  IntensitySettings& intensity = settings.Feature.Intensity;
  intensity.Mixture.MaximumComponents = filter->GetMaximumComponents();
  intensity.Mixture.MinimumWeight = filter->GetMinimumComponentWeight();
  intensity.NoiseWidening = filter->GetNoiseWidening();
  intensity.ForegroundMass = filter->GetForegroundMass();
  intensity.Threshold = filter->GetFeatureThreshold();
  settings.Feature.ControlLeaks = filter->GetLeakControl();
  settings.Feature.Leaks.ClosingRadius =
    std::min(filter->GetClosingRadius(), MaximumVoxelsOpened * voxel);
  settings.Feature.Leaks.OpeningRadius =
    std::min(Clamp(filter->GetOpeningScale() * radius, MinimumOpening, MaximumOpening),
      MaximumVoxelsOpened * voxel);

  CorrespondenceSettings& search = settings.Targets.Correspondence;
  search.SearchDistance = SearchDistanceOf(filter);
  search.RunLength = filter->GetRunLength();
  search.RunVoxels = filter->GetRunVoxels();
  search.SearchInward = filter->GetSearchInward();
  search.ImageBoundaryDistance = filter->GetImageBoundaryDistance();
  search.EdgeWindow = std::min(filter->GetEdgeWindow(), MaximumVoxelsOfEdgeWindow * voxel);
  settings.Targets.NormalSmoothingIterations = filter->GetNormalSmoothingIterations();
  settings.Targets.OutlierStandardDeviations = filter->GetOutlierStandardDeviations();
  settings.Targets.MaximumDisplacement = voxel * filter->GetMaximumDisplacement();

  settings.Step.AvoidFlips = filter->GetAvoidFlips();
  settings.Step.FlipThreshold = filter->GetFlipThreshold();
  settings.Step.Propagation.Iterations = filter->GetPropagationIterations();
  settings.Step.Energy.PositionWeight = filter->GetPositionWeight();
  settings.Step.Energy.UniformWeight = filter->GetUniformWeight();
  settings.Step.Energy.Fairing = filter->GetFairing();
  return settings;
}

} // namespace FlipFree
