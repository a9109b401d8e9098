#include "Vessel/VesselParameters.h"

namespace FlipFree
{
namespace
{

using Settings = VesselSegmentationSettings;

ParameterTable<Settings> MakeTable()
{
  ParameterTable<Settings> table;
#define ADD(Name, type, field, minimum, maximum)                                                   \
  table.push_back(NumberParameter<type, Settings>(                                                 \
    #Name, [](auto& settings) -> auto& { return field; }, minimum, maximum));
  FLIPFREE_VESSEL_PATH_PARAMETERS(ADD, settings.)
  ADD(Modality, Modality, settings.Path.Modality, 0, 2)
  FLIPFREE_VESSEL_SURFACE_PARAMETERS(ADD, settings.)
#undef ADD
  return table;
}

} // namespace

const ParameterTable<Settings>& VesselParameters()
{
  static const ParameterTable<Settings> table = MakeTable();
  return table;
}

void RequireNumbers(const Settings& settings)
{
  RequireNumbers(VesselParameters(), settings);
}

} // namespace FlipFree
