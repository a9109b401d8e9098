#include "SessionVessel.h"

#include "Failure.h"
#include "OptionTable.h"

#include "FilterSettings.h"
#include "Vessel/VesselParameters.h"

#include "vtkFlipFreeVesselSegmentation.h"

#include <algorithm>

namespace Command
{

vtkSmartPointer<vtkFlipFreeVesselSegmentation> VesselFilterOf(const SessionOrgan& vessel)
{
  auto filter = vtkSmartPointer<vtkFlipFreeVesselSegmentation>::New();
  for (const auto& [x, y, z] : vessel.Points)
  {
    filter->AddPoint(x, y, z);
  }
  AddPoints(vessel.Corrections, filter);
  std::vector<std::string> names;
  for (const auto& parameter : FlipFree::VesselParameters())
  {
    if (parameter.Name != "LabelValue") // which changes no surface
    {
      names.push_back(parameter.Name);
    }
  }
  FlipFree::VesselSegmentationSettings settings;
  for (const auto& [property, values] : vessel.Parameters)
  {
    if (std::find(names.begin(), names.end(), property) == names.end())
    {
      names.back().insert(0, "and ");
      throw Failure(
        "there is no parameter '" + property + "' of a vessel; there are " + Joined(names, ", "));
    }
    if (values.size() != 1 ||
      !FlipFree::FindParameter(FlipFree::VesselParameters(), property)->Take(settings, values))
    {
      throw Failure("the parameter '" + property + "' is out of its range");
    }
  }
  FlipFree::FilterSettings::Set(filter, settings);
  return filter;
}

} // namespace Command
