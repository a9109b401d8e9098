#include "Vessel/VesselParameters.h"

namespace FlipFree
{

const ParameterTable<VesselSegmentationSettings>& VesselParameters()
{
  using Settings = VesselSegmentationSettings;
  // clang-format off
  static const ParameterTable<Settings> table{
    FLIPFREE_VESSEL_PATH_PARAMETERS(FLIPFREE_PARAMETER, settings.)
    FLIPFREE_PARAMETER(Modality, Modality, settings.Path.Modality, 0, 2, "N",
      "Scale of the gray values, by which the contrast across the outline is judged; "
      "0: automatic, 1: CT, 2: MR")
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
