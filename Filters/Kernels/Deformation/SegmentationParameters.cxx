#include "Deformation/SegmentationParameters.h"

#include "PropertyCheck.h"

#include <type_traits>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

template <typename T>
ParameterType TypeOf()
{
  if (std::is_same_v<T, bool>)
  {
    return ParameterType::Boolean;
  }
  return std::is_integral_v<T> || std::is_enum_v<T> ? ParameterType::Integer : ParameterType::Real;
}

// `field(settings)` is a reference to the value.
template <typename T, typename Field>
SegmentationParameter Parameter(const char* name, const Field& field, double minimum,
  double maximum)
{
  return { name, TypeOf<T>(),
    [field](const Settings& settings) { return static_cast<double>(field(settings)); },
    [field, minimum, maximum](Settings& settings, double value)
    {
      const double clamped = value < minimum ? minimum : (value > maximum ? maximum : value);
      // Enumerations are numbered without gaps.
      field(settings) = static_cast<T>(clamped);
    } };
}

std::vector<SegmentationParameter> MakeParameters()
{
  std::vector<SegmentationParameter> parameters;
#define ADD(Name, type, field, minimum, maximum)                                                   \
  parameters.push_back(Parameter<type>(                                                            \
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
  return parameters;
}

} // namespace

const std::vector<SegmentationParameter>& SegmentationParameters()
{
  static const std::vector<SegmentationParameter> parameters = MakeParameters();
  return parameters;
}

void RequireNumbers(const VolumeSegmentationSettings& settings)
{
  RequireNumbers({ { "StartCenterOffset", settings.StartCenterOffset.sum() } });
  for (const SegmentationParameter& parameter : SegmentationParameters())
  {
    RequireNumbers({ { parameter.Name.c_str(), parameter.Get(settings) } });
  }
}

} // namespace FlipFree
