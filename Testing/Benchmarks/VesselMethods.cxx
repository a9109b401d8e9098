#include "VesselMethods.h"

#include "vtkGraphCutSegmentation.h"
#include "vtkImageData.h"
#include "vtkLevelSetSegmentation.h"
#include "vtkPolyData.h"
#include "vtkRegionGrowing.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace
{

vtkSmartPointer<vtkBaselineSegmentation> RegionGrowing()
{
  auto filter = vtkSmartPointer<vtkRegionGrowing>::New();
  filter->SetMultiplier(2);
  filter->SetRepetitions(0);
  filter->SetOpeningScale(0); // it would remove thin vessels
  return filter;
}

vtkSmartPointer<vtkBaselineSegmentation> ThresholdLevelSet()
{
  auto filter = vtkSmartPointer<vtkLevelSetSegmentation>::New();
  filter->SetSpeedToThreshold();
  filter->SetIntensityWidth(4);
  filter->SetCurvatureScaling(0.2);
  filter->SetRimWidth(0);
  filter->SetMaximumIterations(2000); // from either end to the middle
  return filter;
}

vtkSmartPointer<vtkGraphCutSegmentation> GraphCut()
{
  auto filter = vtkSmartPointer<vtkGraphCutSegmentation>::New();
  filter->SetSmoothness(5);
  filter->SetOpeningScale(0);
  filter->SetRimWidth(0);
  return filter;
}

vtkSmartPointer<vtkBaselineSegmentation> VolumeCut()
{
  auto filter = GraphCut();
  filter->SetModeToVolume();
  filter->SetEdgeContrast(0.5);
  return filter;
}

vtkSmartPointer<vtkBaselineSegmentation> SliceCut()
{
  auto filter = GraphCut();
  filter->SetModeToSlices();
  filter->SetSliceMargin(3);
  return filter;
}

using Setters = std::map<std::string, std::function<void(double)>>;

// Parameters that a study may vary.
Setters SettersOf(vtkBaselineSegmentation* method)
{
  Setters setters = { { "DiffusionIterations",
                        [=](double x) { method->SetDiffusionIterations(static_cast<int>(x)); } },
    { "Reach", [=](double x) { method->SetReach(x); } } };
  if (auto* growing = vtkRegionGrowing::SafeDownCast(method))
  {
    setters["Multiplier"] = [=](double x) { growing->SetMultiplier(x); };
    setters["Repetitions"] = [=](double x) { growing->SetRepetitions(static_cast<int>(x)); };
    setters["ClosingRadius"] = [=](double x) { growing->SetClosingRadius(x); };
    setters["OpeningScale"] = [=](double x) { growing->SetOpeningScale(x); };
  }
  if (auto* level = vtkLevelSetSegmentation::SafeDownCast(method))
  {
    setters["IntensityWidth"] = [=](double x) { level->SetIntensityWidth(x); };
    setters["CurvatureScaling"] = [=](double x) { level->SetCurvatureScaling(x); };
    setters["RimWidth"] = [=](double x) { level->SetRimWidth(x); };
    setters["MaximumIterations"] = [=](double x)
    { level->SetMaximumIterations(static_cast<int>(x)); };
  }
  if (auto* cut = vtkGraphCutSegmentation::SafeDownCast(method))
  {
    setters["NoiseWidening"] = [=](double x) { cut->SetNoiseWidening(x); };
    setters["Smoothness"] = [=](double x) { cut->SetSmoothness(x); };
    setters["EdgeContrast"] = [=](double x) { cut->SetEdgeContrast(x); };
    setters["SliceMargin"] = [=](double x) { cut->SetSliceMargin(x); };
    setters["ClosingRadius"] = [=](double x) { cut->SetClosingRadius(x); };
    setters["OpeningScale"] = [=](double x) { cut->SetOpeningScale(x); };
    setters["RimWidth"] = [=](double x) { cut->SetRimWidth(x); };
  }
  return setters;
}

void SetSeeds(const std::vector<Eigen::Vector3d>& points, double radius,
  vtkBaselineSegmentation* method)
{
  method->RemoveAllFurtherSeeds();
  method->SetSeedCenter(points.front().x(), points.front().y(), points.front().z());
  method->SetSeedRadius(radius);
  for (std::size_t point = 1; point < points.size(); ++point)
  {
    method->AddFurtherSeed(points[point].x(), points[point].y(), points[point].z(), radius);
  }
}

} // namespace

const std::vector<VesselMethod>& VesselMethods()
{
  static const std::vector<VesselMethod> methods = {
    { "region-growing", 4, 10, RegionGrowing },
    { "level-set-threshold", 4, 10, ThresholdLevelSet },
    { "graph-cut-volume", 3, 10, VolumeCut },
    { "graph-cut-slices", 4, 20, SliceCut },
  };
  return methods;
}

const VesselMethod& VesselMethodOf(const std::string& name)
{
  const auto found = std::find_if(VesselMethods().begin(), VesselMethods().end(),
    [&name](const VesselMethod& method) { return method.Name == name; });
  if (found == VesselMethods().end())
  {
    throw std::out_of_range("there is no method " + name);
  }
  return *found;
}

vtkSmartPointer<vtkBaselineSegmentation> PrepareMethod(const VesselMethod& method,
  vtkImageData* image, const std::vector<Eigen::Vector3d>& points, vtkPolyData* centerline,
  const std::vector<std::string>& parameters)
{
  auto filter = method.Make();
  filter->SetInputData(image);
  filter->SetPathData(centerline);
  filter->SetReach(method.Reach);
  SetSeeds(points, method.SeedRadius, filter);
  Setters setters = SettersOf(filter);
  setters["SeedRadius"] = [&](double x) { SetSeeds(points, x, filter); };
  for (const std::string& assignment : parameters)
  {
    const std::size_t equals = assignment.find('=');
    const auto setter = setters.find(assignment.substr(0, equals));
    if (setter != setters.end())
    {
      setter->second(std::stod(assignment.substr(equals + 1)));
    }
  }
  return filter;
}
