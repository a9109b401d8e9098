/**
 * The parameters of vtkFlipFreeSegmentation as options. Their defaults are the filter's own, and so
 * are their ranges: what the filter does not take is refused.
 */
#ifndef FlipFreeCommandSegmentParameters_h
#define FlipFreeCommandSegmentParameters_h

#include "vtkNew.h"

#include <functional>
#include <string>
#include <vector>

class vtkFlipFreeSegmentation;

namespace CLI
{
class App;
}

namespace Command
{

class SegmentParameters
{
public:
  SegmentParameters();
  ~SegmentParameters();

  void AddOptions(CLI::App& command);

  /// First the preset, then the options that were given, whatever their order. Throws WrongUsage.
  void Apply(vtkFlipFreeSegmentation* filter) const;

private:
  template <typename T, typename Owner>
  void Add(CLI::App& command, const char* group, const std::string& option, const std::string& unit,
    const std::string& description, T (Owner::*get)() const, void (Owner::*set)(T),
    Owner* (vtkFlipFreeSegmentation::*stage)() const = nullptr);
  template <typename Owner>
  void AddSwitch(CLI::App& command, const char* group, const std::string& option,
    const std::string& description, void (Owner::*set)(bool),
    Owner* (vtkFlipFreeSegmentation::*stage)() const = nullptr);

  std::string Preset = "default";
  std::vector<double> StartOffset;
  std::vector<std::function<void(vtkFlipFreeSegmentation*)>> Given;
  vtkNew<vtkFlipFreeSegmentation> Defaults;
};

} // namespace Command

#endif
