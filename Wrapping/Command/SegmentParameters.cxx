#include "SegmentParameters.h"

#include "Failure.h"
#include "MessageText.h"

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <cctype>
#include <limits>
#include <type_traits>

namespace Command
{
namespace
{

using Filter = vtkFlipFreeSegmentation;
using Feature = vtkGMMFeatureFilter;
using Search = vtkCorrespondenceSearch;
using Deform = vtkFlipFreeDeform;

/// An option that sets a property of the filter or of one of its stages.
struct Parameter
{
  std::string Names; // the last one is the property's
  std::string Unit;  // empty for a switch
  std::string Description;
  bool IsInteger;
  std::function<double(Filter*)> Get;
  std::function<void(Filter*, double)> Set;
};

struct ParameterGroup
{
  const char* Name;
  std::vector<Parameter> Parameters;
};

/// A property of what `of` finds in the filter.
template <typename Object, typename Getter, typename Setter>
Parameter Property(Object* (*of)(Filter*), const char* names, const char* unit,
  const char* description, Getter get, Setter set)
{
  using Value = std::invoke_result_t<Getter, Object*>;
  return { names, unit, description, std::is_same_v<Value, int>,
    [=](Filter* filter) { return static_cast<double>((of(filter)->*get)()); },
    [=](Filter* filter, double value) { (of(filter)->*set)(static_cast<Value>(value)); } };
}

Filter* Whole(Filter* filter)
{
  return filter;
}

Feature* FeatureOf(Filter* filter)
{
  return filter->GetFeature();
}

Search* SearchOf(Filter* filter)
{
  return filter->GetSearch();
}

Deform* DeformOf(Filter* filter)
{
  return filter->GetDeform();
}

ParameterGroup MainParameters()
{
  return { "Parameters",
    {
      Property(Whole, "--resolution", "N",
        "Vertices along an edge of each of the mesh's six sides, 6 N^2 in all",
        &Filter::GetResolution, &Filter::SetResolution),
      Property(Whole, "--levels", "N", "Levels from coarse to fine", &Filter::GetLevels,
        &Filter::SetLevels),
      Property(Whole, "--iterations,--maximum-iterations", "N",
        "Maximum number of iterations at each level", &Filter::GetMaximumIterations,
        &Filter::SetMaximumIterations),
      Property(Whole, "--search-distance", "MM",
        "Length of the search lines; 0: proportional to the radius", &Filter::GetSearchDistance,
        &Filter::SetSearchDistance),
      Property(Whole, "--reach", "MM",
        "How far from the seed the surface may get; 0: ten seed radii, at least 100 and at most "
        "250 mm",
        &Filter::GetReach, &Filter::SetReach),
      Property(Whole, "--diffusion-iterations", "N",
        "Iterations of the diffusion that smooths the volume", &Filter::GetDiffusionIterations,
        &Filter::SetDiffusionIterations),
      Property(Whole, "--foreground-mass", "P", "Mass of the mixture that counts as the organ",
        &Filter::GetForegroundMass, &Filter::SetForegroundMass),
      Property(Whole, "--leak-control", "", "Cut thin bridges between the organ and its neighbors",
        &Filter::GetLeakControl, &Filter::SetLeakControl),
      Property(Whole, "--guard", "",
        "Keep the surface from intersecting itself; without, it may, and faces may flip",
        &Filter::GetGuard, &Filter::SetGuard),
    } };
}

ParameterGroup FeatureParameters()
{
  return { "Feature parameters",
    {
      Property(FeatureOf, "--threshold,--feature-threshold", "G",
        "Gamma of Eq. 2, 0 to 1; 0: derived from --foreground-mass", &Feature::GetFeatureThreshold,
        &Feature::SetFeatureThreshold),
      Property(FeatureOf, "--components,--maximum-components", "N",
        "Maximum number of Gaussians in the mixture", &Feature::GetMaximumComponents,
        &Feature::SetMaximumComponents),
      Property(FeatureOf, "--minimum-weight,--minimum-component-weight", "P",
        "Weight below which a Gaussian is dropped from the mixture",
        &Feature::GetMinimumComponentWeight, &Feature::SetMinimumComponentWeight),
      Property(FeatureOf, "--noise-widening", "F",
        "How much each Gaussian is widened, in standard deviations of the volume's noise",
        &Feature::GetNoiseWidening, &Feature::SetNoiseWidening),
      Property(FeatureOf, "--closing,--closing-radius", "MM", "Radius of the foreground's closing",
        &Feature::GetClosingRadius, &Feature::SetClosingRadius),
      Property(FeatureOf, "--opening,--opening-scale", "F",
        "Radius of the foreground's opening, in seed radii; 0: none", &Feature::GetOpeningScale,
        &Feature::SetOpeningScale),
      Property(FeatureOf, "--reestimate-intensities", "",
        "Fit the intensities again inside the growing surface", &Feature::GetReestimateIntensities,
        &Feature::SetReestimateIntensities),
      Property(FeatureOf, "--carving", "",
        "Carve off what is connected only by a neck, move the boundary to half the local contrast, "
        "and run again",
        &Feature::GetCarving, &Feature::SetCarving),
      Property(FeatureOf, "--consensus", "",
        "Where --carving changes much, grow the foreground again in other ways, and decide once more",
        &Feature::GetConsensus, &Feature::SetConsensus),
      Property(FeatureOf, "--modality", "N",
        "Scale of the gray values, for --carving; 0: automatic, 1: CT, 2: MR",
        &Feature::GetModality, &Feature::SetModality),
    } };
}

ParameterGroup SearchParameters()
{
  return { "Search parameters",
    {
      Property(SearchOf, "--search-scale", "F",
        "Length of the search lines in seed radii, if --search-distance is 0",
        &Search::GetSearchScale, &Search::SetSearchScale),
      Property(SearchOf, "--run-length", "MM",
        "Length of background that marks the boundary; 0: --run-voxels counts",
        &Search::GetRunLength, &Search::SetRunLength),
      Property(SearchOf, "--run-voxels", "N", "The same in voxels, the paper's N + 1",
        &Search::GetRunVoxels, &Search::SetRunVoxels),
      Property(SearchOf, "--search-inward", "",
        "Vertices in the background search inward for the organ", &Search::GetSearchInward,
        &Search::SetSearchInward),
      Property(SearchOf, "--image-boundary-distance", "MM",
        "A vertex this close to the volume's boundary takes it for its target; 0: it has none",
        &Search::GetImageBoundaryDistance, &Search::SetImageBoundaryDistance),
      Property(SearchOf, "--edge-window", "MM",
        "Standard deviation of the window in which targets snap to the strongest edge before "
        "carving, "
        "at most 1.5 voxels; 0: they do not",
        &Search::GetEdgeWindow, &Search::SetEdgeWindow),
      Property(SearchOf, "--normal-smoothing-iterations", "N",
        "Smoothing passes over the surface's normals", &Search::GetNormalSmoothingIterations,
        &Search::SetNormalSmoothingIterations),
      Property(SearchOf, "--outlier-standard-deviations", "F",
        "Standard deviations, plus a voxel, beyond which a target is dropped; 0: none is",
        &Search::GetOutlierStandardDeviations, &Search::SetOutlierStandardDeviations),
      Property(SearchOf, "--maximum-displacement", "VOXELS",
        "Maximum displacement in one iteration; 0: unlimited", &Search::GetMaximumDisplacement,
        &Search::SetMaximumDisplacement),
    } };
}

ParameterGroup DeformationParameters()
{
  return { "Deformation parameters",
    {
      Property(DeformOf, "--avoid-flips", "", "Avoid the flips that are detected",
        &Deform::GetAvoidFlips, &Deform::SetAvoidFlips),
      Property(DeformOf, "--flip-threshold", "R", "r of Eq. 3", &Deform::GetFlipThreshold,
        &Deform::SetFlipThreshold),
      Property(DeformOf, "--propagation,--propagation-iterations", "N",
        "Passes that carry displacements to solitary vertices", &Deform::GetPropagationIterations,
        &Deform::SetPropagationIterations),
      Property(DeformOf, "--smoothing-iterations", "N",
        "Passes that smooth the displacements of matched vertices, too",
        &Deform::GetSmoothingIterations, &Deform::SetSmoothingIterations),
      Property(DeformOf, "--position-weight", "F", "lambda_p of Eq. 7", &Deform::GetPositionWeight,
        &Deform::SetPositionWeight),
      Property(DeformOf, "--uniform-weight", "F", "lambda_u of Eq. 8", &Deform::GetUniformWeight,
        &Deform::SetUniformWeight),
      Property(DeformOf, "--fairing", "F", "0 keeps the surface's shape (Eq. 5), 1 smooths it",
        &Deform::GetFairing, &Deform::SetFairing),
    } };
}

ParameterGroup ScheduleParameters()
{
  return { "Start and convergence",
    {
      Property(Whole, "--distance-tolerance", "VOXELS",
        "A level ends when the mean distance to the targets is below this",
        &Filter::GetDistanceTolerance, &Filter::SetDistanceTolerance),
      Property(Whole, "--change-tolerance", "VOXELS",
        "A level ends when that distance changes by less over five iterations; negative: never",
        &Filter::GetChangeTolerance, &Filter::SetChangeTolerance),
      Property(Whole, "--start-scale", "F", "Radius of the first sphere, in seed radii",
        &Filter::GetStartScale, &Filter::SetStartScale),
    } };
}

const std::vector<ParameterGroup>& Table()
{
  static const std::vector<ParameterGroup> table{ MainParameters(), FeatureParameters(),
    SearchParameters(), DeformationParameters(), ScheduleParameters() };
  return table;
}

std::string FirstNameOf(const Parameter& parameter)
{
  return parameter.Names.substr(0, parameter.Names.find(','));
}

/// `SeedRadius` for `--seed-radius`.
std::string PropertyOf(const std::string& option)
{
  std::string property;
  bool startsWord = true;
  for (const char letter : option)
  {
    if (letter != '-')
    {
      property += startsWord ? static_cast<char>(std::toupper(letter)) : letter;
    }
    startsWord = letter == '-';
  }
  return property;
}

/// Such as `0 to 6`, by what the filter takes in place of numbers that no range has.
std::string RangeOf(const Parameter& parameter, Filter* filter)
{
  const double most =
    parameter.IsInteger ? std::numeric_limits<int>::max() : std::numeric_limits<double>::max();
  parameter.Set(filter, -most);
  const std::string from = FlipFree::TextOf(parameter.Get(filter));
  parameter.Set(filter, most);
  const double to = parameter.Get(filter);
  return from + (to == most ? " or more" : " to " + FlipFree::TextOf(to));
}

void SetOrRefuse(const Parameter& parameter, Filter* filter, double value)
{
  parameter.Set(filter, value);
  if (!(parameter.Get(filter) == value))
  {
    throw WrongUsage(FirstNameOf(parameter) + ": " + FlipFree::TextOf(value) +
      " is out of range. Give " + RangeOf(parameter, filter) + ".");
  }
}

/// The parameter that sets a property; null if there is none.
const Parameter* FindProperty(const std::string& property)
{
  for (const ParameterGroup& group : Table())
  {
    for (const Parameter& parameter : group.Parameters)
    {
      if (PropertyOf(parameter.Names.substr(parameter.Names.rfind("--"))) == property)
      {
        return &parameter;
      }
    }
  }
  return nullptr;
}

const std::string& RequirePreset(const std::string& preset)
{
  if (preset != "default" && preset != "published" && preset != "naive")
  {
    throw Failure("there is no preset '" + preset + "'");
  }
  return preset;
}

/// Adds the option, which has `keep` called with its value.
CLI::Option* AddOption(CLI::App& command, const Parameter& parameter,
  const std::function<void(double)>& keep)
{
  if (parameter.Unit.empty())
  {
    const std::string off = ",!--no-" + parameter.Names.substr(2);
    return command.add_flag_function(
      parameter.Names + off, [keep](std::int64_t count) { keep(count > 0 ? 1 : 0); },
      parameter.Description);
  }
  CLI::Option* option = parameter.IsInteger
    ? command.add_option_function<int>(parameter.Names, keep, parameter.Description)
    : command.add_option_function<double>(parameter.Names, keep, parameter.Description);
  return option->type_name(parameter.Unit);
}

} // namespace

void SegmentParameters::AddOptions(CLI::App& command)
{
  command
    .add_option("--preset", this->Preset,
      "Values that the parameters start from: 'default', 'published' (the paper's own method: one "
      "level, no leak control, no guard) or 'naive' (also without flip avoidance). With the last "
      "two, the surface may intersect itself. The options below override the preset")
    ->type_name("NAME")
    ->check(CLI::IsMember({ "default", "published", "naive" }))
    ->capture_default_str()
    ->group(Table().front().Name);
  vtkNew<Filter> defaults;
  for (const ParameterGroup& group : Table())
  {
    for (const Parameter& parameter : group.Parameters)
    {
      const auto keep = [this, &parameter](double value)
      {
        this->Given.emplace_back(
          [&parameter, value](Filter* filter) { SetOrRefuse(parameter, filter, value); });
      };
      const double value = parameter.Get(defaults);
      AddOption(command, parameter, keep)
        ->default_str(parameter.Unit.empty() ? value != 0 ? "on" : "off" : FlipFree::TextOf(value))
        ->group(group.Name);
    }
  }
  command
    .add_option("--start-offset,--start-center-offset", this->StartOffset,
      "Center of the first sphere relative to the seed, in mm, to start outside the seed")
    ->type_name("X Y Z")
    ->expected(3)
    ->default_str("0 0 0")
    ->group(Table().back().Name);
}

void SegmentParameters::Apply(Filter* filter) const
{
  if (this->Preset == "published")
  {
    filter->UsePublishedParameters();
  }
  else if (this->Preset == "naive")
  {
    filter->UseNaiveParameters();
  }
  else
  {
    filter->UseDefaultParameters();
  }
  for (const auto& set : this->Given)
  {
    set(filter);
  }
  if (!this->StartOffset.empty())
  {
    filter->SetStartCenterOffset(this->StartOffset.data());
  }
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
    if (property == "StartCenterOffset" && numbers.size() == 3)
    {
      parameters.StartOffset = numbers;
      continue;
    }
    const Parameter* parameter = FindProperty(property);
    if (!parameter || numbers.size() != 1)
    {
      throw Failure("there is no parameter '" + property + "' of " +
        std::to_string(numbers.size()) + " values");
    }
    parameters.Given.emplace_back([parameter, value = numbers.front()](Filter* filter)
      { SetOrRefuse(*parameter, filter, value); });
  }
  parameters.Given.insert(parameters.Given.end(), this->Given.begin(), this->Given.end());
  if (!this->StartOffset.empty())
  {
    parameters.StartOffset = this->StartOffset;
  }
  return parameters;
}

FlipFree::QuantityNames SegmentParameters::Names()
{
  FlipFree::QuantityNames names{ { "SeedCenter", "--seed" }, { "SeedRadius", "--radius" },
    { "StartLabel", "--start-label" }, { "StartCenterOffset", "--start-offset" },
    { "LabelValue", "--label-value" }, { "AddInsidePoint", "--inside" },
    { "AddOutsidePoint", "--outside" } };
  for (const ParameterGroup& group : Table())
  {
    for (const Parameter& parameter : group.Parameters)
    {
      const std::string last = parameter.Names.substr(parameter.Names.rfind("--"));
      names[PropertyOf(last)] = FirstNameOf(parameter);
    }
  }
  return names;
}

} // namespace Command
