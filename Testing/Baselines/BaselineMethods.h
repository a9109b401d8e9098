/**
 * Every method of the module, for tests that ask the same of each.
 */
#ifndef FlipFreeBaselineMethods_h
#define FlipFreeBaselineMethods_h

#include "vtkBaselineSegmentation.h"
#include "vtkGraphCutSegmentation.h"
#include "vtkLevelSetSegmentation.h"
#include "vtkRegionGrowing.h"

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
  double Dice; ///< a little below what it reaches on the phantom's liver
};

inline void PrintTo(const BaselineMethod& method, std::ostream* stream)
{
  *stream << method.Name;
}

inline std::vector<BaselineMethod> BaselineMethods()
{
  return {
    { "RegionGrowing", []() { return vtkSmartPointer<vtkRegionGrowing>::New(); }, 0.8 },
    { "SliceGraphCut", []() { return vtkSmartPointer<vtkGraphCutSegmentation>::New(); }, 0.8 },
    { "VolumeGraphCut",
      []()
      {
        auto filter = vtkSmartPointer<vtkGraphCutSegmentation>::New();
        filter->SetModeToVolume();
        return filter;
      },
      0.8 },
    { "ThresholdLevelSet", []() { return vtkSmartPointer<vtkLevelSetSegmentation>::New(); }, 0.8 },
    { "GeodesicLevelSet",
      []()
      {
        auto filter = vtkSmartPointer<vtkLevelSetSegmentation>::New();
        filter->SetSpeedToGeodesic();
        return filter;
      },
      0.8 },
  };
}

inline std::string NameOf(const testing::TestParamInfo<BaselineMethod>& method)
{
  return method.param.Name;
}

} // namespace FlipFree

#endif
