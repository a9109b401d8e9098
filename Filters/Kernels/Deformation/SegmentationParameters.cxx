#include "Deformation/SegmentationParameters.h"

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

ParameterTable<Settings> MakeTable()
{
  ParameterTable<Settings> table;
  table.push_back(VectorParameter<double, Settings>(
    "StartCenterOffset", [](auto& settings) { return settings.StartCenterOffset.data(); }, 3));
#define ADD(Name, type, field, minimum, maximum)                                                   \
  table.push_back(NumberParameter<type, Settings>(                                                 \
    #Name, [](auto& settings) -> auto& { return field; }, minimum, maximum));
  ADD(StartScale, double, settings.StartScale, 1e-3, 1e3)
  FLIPFREE_SCHEDULE_PARAMETERS(ADD, settings.Method.Schedule.)
  ADD(LabelValue, int, settings.LabelValue, 1, 255)
  ADD(KeepHistory, bool, settings.KeepHistory, false, true)
  FLIPFREE_SMOOTHING_PARAMETERS(ADD, settings.Method.Smoothing., DiffusionIterations)
  FLIPFREE_FEATURE_PARAMETERS(ADD, settings.Method.Feature.)
  ADD(Modality, Modality, settings.Method.Feature.Modality, 0, 2)
  FLIPFREE_TARGET_PARAMETERS(ADD, settings.Method.Targets.)
  FLIPFREE_STEP_PARAMETERS(ADD, settings.Method.Step.)
#undef ADD
  return table;
}

} // namespace

const ParameterTable<Settings>& SegmentationParameters()
{
  static const ParameterTable<Settings> table = MakeTable();
  return table;
}

void RequireNumbers(const Settings& settings)
{
  RequireNumbers(SegmentationParameters(), settings);
}

} // namespace FlipFree
