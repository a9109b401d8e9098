#include "Deformation/SegmentationParameters.h"

namespace FlipFree
{

const ParameterTable<VolumeSegmentationSettings>& SegmentationParameters()
{
  using Settings = VolumeSegmentationSettings;
  // clang-format off
  static const ParameterTable<Settings> table{
    VectorParameter<double, Settings>(
      "StartCenterOffset", [](auto& settings) { return settings.StartCenterOffset.data(); }, 3,
      { "X Y Z",
        "Center of the first sphere relative to the seed, in mm, to start outside the seed", "Start" }),
    FLIPFREE_WHOLE_PARAMETERS(FLIPFREE_PARAMETER, settings.)
    FLIPFREE_SMOOTHING_PARAMETERS(FLIPFREE_PARAMETER, settings.Method.Smoothing., DiffusionIterations)
    FLIPFREE_FEATURE_PARAMETERS(FLIPFREE_PARAMETER, settings.Method.Feature.)
    FLIPFREE_TARGET_PARAMETERS(FLIPFREE_PARAMETER, settings.Method.Targets.)
    FLIPFREE_STEP_PARAMETERS(FLIPFREE_PARAMETER, settings.Method.Step.)
  };
  // clang-format on
  return table;
}

void RequireNumbers(const VolumeSegmentationSettings& settings)
{
  RequireNumbers(SegmentationParameters(), settings);
}

} // namespace FlipFree
