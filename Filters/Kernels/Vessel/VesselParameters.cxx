#include "Vessel/VesselParameters.h"

namespace FlipFree
{

const ParameterTable<VesselSegmentationSettings>& VesselParameters()
{
  using Settings = VesselSegmentationSettings;
  // clang-format off
  static const ParameterTable<Settings> table{
    FLIPFREE_VESSEL_PATH_PARAMETERS(FLIPFREE_PARAMETER, settings.)
    FLIPFREE_VESSEL_SURFACE_PARAMETERS(FLIPFREE_PARAMETER, settings.)
  };
  // clang-format on
  return table;
}

void RequireNumbers(const VesselSegmentationSettings& settings)
{
  RequireNumbers(VesselParameters(), settings);
}

} // namespace FlipFree
