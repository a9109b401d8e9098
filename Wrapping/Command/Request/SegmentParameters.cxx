#include "SegmentParameters.h"

#include "Failure.h"

#include "Deformation/SegmentationParameters.h"
#include "Deformation/SegmentationSettings.h"

#include <algorithm>

namespace Command
{
namespace
{

const std::string& RequirePreset(const std::string& preset)
{
  const std::vector<std::string>& choices = EntryOf("segment", "--preset").Choices;
  if (std::find(choices.begin(), choices.end(), preset) == choices.end())
  {
    throw Failure("there is no preset '" + preset + "'");
  }
  return preset;
}

} // namespace

void SegmentParameters::AddOptions(CLI::App& command)
{
  AddOption(command, "--preset", this->Preset);
  this->Given.AddOptions(command, FlipFree::SegmentationParameters());
}

FlipFree::VolumeSegmentationSettings SegmentParameters::Settings() const
{
  FlipFree::VolumeSegmentationSettings settings;
  settings.Method = FlipFree::SettingsOfPreset(this->Preset);
  this->Given.Apply(settings);
  return settings;
}

SegmentParameters SegmentParameters::With(const std::string& preset,
  const std::map<std::string, std::vector<double>>& values) const
{
  SegmentParameters parameters;
  parameters.Preset = RequirePreset(preset);
  for (const auto& [property, numbers] : values)
  {
    if (property == "KeepHistory" || property == "LabelValue") // they change no surface
    {
      continue;
    }
    const auto* const parameter =
      FlipFree::FindParameter(FlipFree::SegmentationParameters(), property);
    if (!parameter || static_cast<int>(numbers.size()) != parameter->Count)
    {
      throw Failure("there is no parameter '" + property + "' of " +
        std::to_string(numbers.size()) + " values");
    }
    parameters.Given.Give(*parameter, numbers);
  }
  parameters.Given.Give(this->Given);
  return parameters;
}

FlipFree::QuantityNames SegmentParameters::Names()
{
  FlipFree::QuantityNames names = OptionNames(FlipFree::SegmentationParameters());
  names.insert(
    { { "SeedCenter", "--seed" }, { "SeedRadius", "--radius" }, { "StartLabel", "--start-label" },
      { "AddInsidePoint", "--inside" }, { "AddOutsidePoint", "--outside" } });
  return names;
}

} // namespace Command
