#include "SessionVessel.h"

#include "Failure.h"

#include "vtkFlipFreeVesselSegmentation.h"

#include <cstdio>

namespace Command
{
namespace
{

using VesselFilter = vtkFlipFreeVesselSegmentation;

/// Sets a property; false if the filter does not take the value as it is.
template <typename T>
bool Take(VesselFilter* filter, double value, void (VesselFilter::*set)(T),
  T (VesselFilter::*get)() const)
{
  (filter->*set)(static_cast<T>(value));
  return static_cast<double>((filter->*get)()) == value;
}

bool SetProperty(VesselFilter* filter, const std::string& property, double value)
{
  if (property == "Radius")
  {
    return Take<double>(filter, value, &VesselFilter::SetRadius, &VesselFilter::GetRadius);
  }
  if (property == "WallThickness")
  {
    return Take<double>(filter, value, &VesselFilter::SetWallThickness,
      &VesselFilter::GetWallThickness);
  }
  if (property == "Modality")
  {
    return Take<int>(filter, value, &VesselFilter::SetModality, &VesselFilter::GetModality);
  }
  if (property == "Levels")
  {
    return Take<int>(filter, value, &VesselFilter::SetLevels, &VesselFilter::GetLevels);
  }
  if (property == "MaximumIterations")
  {
    return Take<int>(filter, value, &VesselFilter::SetMaximumIterations,
      &VesselFilter::GetMaximumIterations);
  }
  throw Failure("there is no parameter '" + property +
    "' of a vessel; there are Radius, WallThickness, Modality, Levels and MaximumIterations");
}

} // namespace

vtkSmartPointer<VesselFilter> VesselFilterOf(const SessionOrgan& vessel)
{
  auto filter = vtkSmartPointer<VesselFilter>::New();
  for (const auto& [x, y, z] : vessel.Points)
  {
    filter->AddPoint(x, y, z);
  }
  AddPoints(vessel.Corrections, filter);
  for (const auto& [property, values] : vessel.Parameters)
  {
    if (values.size() != 1 || !SetProperty(filter, property, values.front()))
    {
      throw Failure("the parameter '" + property + "' is out of its range");
    }
  }
  return filter;
}

} // namespace Command
