#include "SessionVessel.h"

#include "Failure.h"

#include "vtkFlipFreeVesselSegmentation.h"

#include <cstdio>

namespace Command
{
namespace
{

using Filter = vtkFlipFreeVesselSegmentation;

/// Sets a property; false if the filter does not take the value as it is.
template <typename T>
bool Take(Filter* filter, double value, void (Filter::*set)(T), T (Filter::*get)() const)
{
  (filter->*set)(static_cast<T>(value));
  return static_cast<double>((filter->*get)()) == value;
}

bool SetProperty(Filter* filter, const std::string& property, double value)
{
  if (property == "Radius")
  {
    return Take<double>(filter, value, &Filter::SetRadius, &Filter::GetRadius);
  }
  if (property == "WallThickness")
  {
    return Take<double>(filter, value, &Filter::SetWallThickness, &Filter::GetWallThickness);
  }
  if (property == "Levels")
  {
    return Take<int>(filter, value, &Filter::SetLevels, &Filter::GetLevels);
  }
  if (property == "MaximumIterations")
  {
    return Take<int>(filter, value, &Filter::SetMaximumIterations, &Filter::GetMaximumIterations);
  }
  throw Failure("there is no parameter '" + property +
    "' of a vessel; there are Radius, WallThickness, Levels and MaximumIterations");
}

} // namespace

vtkSmartPointer<Filter> VesselFilterOf(const SessionOrgan& vessel)
{
  auto filter = vtkSmartPointer<Filter>::New();
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
