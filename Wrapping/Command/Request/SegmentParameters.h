/**
 * The parameters of an organ's segmentation as options.
 */
#ifndef FlipFreeCommandSegmentParameters_h
#define FlipFreeCommandSegmentParameters_h

#include "Options.h"

#include "Deformation/VolumeSegmentation.h"
#include "QuantityNames.h"

#include <map>
#include <string>
#include <vector>

namespace Command
{

class SegmentParameters
{
public:
  void AddOptions(CLI::App& command);

  /// Whether the command line names another preset than the default.
  bool HasPreset() const { return this->Preset != "default"; }

  const std::string& GetPreset() const { return this->Preset; }
  const GivenParameters<FlipFree::VolumeSegmentationSettings>& GetGiven() const
  {
    return this->Given;
  }

  /// Those of the preset, then the options that were given, whatever their order. Throws WrongUsage
  /// for a value out of range.
  FlipFree::VolumeSegmentationSettings Settings() const;

  /// The same parameters of which something else than the command line has the preset and values,
  /// by the names of properties; the command line's options come after them. Throws a Failure for a
  /// name that there is not.
  SegmentParameters With(const std::string& preset,
    const std::map<std::string, std::vector<double>>& values) const;

  /// What the options are called, by the properties that they set.
  static FlipFree::QuantityNames Names();

private:
  std::string Preset = "default";
  GivenParameters<FlipFree::VolumeSegmentationSettings> Given;
};

} // namespace Command

#endif
