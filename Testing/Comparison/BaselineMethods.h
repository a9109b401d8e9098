/**
 * Every method, for tests that ask the same of each.
 */
#ifndef FlipFreeBaselineMethods_h
#define FlipFreeBaselineMethods_h

#include "vtkBaselineSegmentation.h"
#include "vtkGVFSnake.h"
#include "vtkGraphCutSegmentation.h"
#include "vtkLevelSetSegmentation.h"
#include "vtkRegionGrowing.h"
#include "vtkSimplexMeshSegmentation.h"

#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace FlipFree
{

struct BaselineMethod
{
  std::string Name;
  std::function<vtkSmartPointer<vtkBaselineSegmentation>()> Make;
  double Dice;        ///< a little below what it reaches on the phantom's organ
  bool Plane = false; ///< outlines one slice in place of a volume, and is scored there
};

inline void PrintTo(const BaselineMethod& method, std::ostream* stream)
{
  *stream << method.Name;
}

/// Level sets with fewer iterations than by default: phantoms of tests are coarse.
template <int Speed>
vtkSmartPointer<vtkBaselineSegmentation> MakeLevelSet()
{
  auto filter = vtkSmartPointer<vtkLevelSetSegmentation>::New();
  filter->SetSpeed(Speed);
  filter->SetMaximumIterations(300);
  return filter;
}

template <int Mode>
vtkSmartPointer<vtkBaselineSegmentation> MakeGraphCut()
{
  auto filter = vtkSmartPointer<vtkGraphCutSegmentation>::New();
  filter->SetMode(Mode);
  return filter;
}

/// Those that segment a volume.
inline std::vector<BaselineMethod> VolumeMethods()
{
  return {
    { "RegionGrowing", []() { return vtkSmartPointer<vtkRegionGrowing>::New(); }, 0.88 },
    { "SliceGraphCut", MakeGraphCut<vtkGraphCutSegmentation::SLICES>, 0.9 },
    { "VolumeGraphCut", MakeGraphCut<vtkGraphCutSegmentation::VOLUME>, 0.85 },
    { "ThresholdLevelSet", MakeLevelSet<vtkLevelSetSegmentation::THRESHOLD>, 0.85 },
    { "GeodesicLevelSet", MakeLevelSet<vtkLevelSetSegmentation::GEODESIC>, 0.8 },
    { "SimplexMesh", []() { return vtkSmartPointer<vtkSimplexMeshSegmentation>::New(); }, 0.6 },
  };
}

inline std::vector<BaselineMethod> BaselineMethods()
{
  std::vector<BaselineMethod> methods = VolumeMethods();
  methods.push_back(
    { "GVFSnake", []() { return vtkSmartPointer<vtkGVFSnake>::New(); }, 0.5, true });
  return methods;
}

inline std::string NameOf(const testing::TestParamInfo<BaselineMethod>& method)
{
  return method.param.Name;
}

} // namespace FlipFree

#endif
