#include "SegmentParameters.h"

#include "Failure.h"

#include "vtkFlipFreeSegmentation.h"

#include <CLI/CLI.hpp>

#include <sstream>

namespace Command
{
namespace
{

using Filter = vtkFlipFreeSegmentation;

const char* const General = "Parameters of the method";
const char* const Finer = "Finer parameters";

template <typename T>
std::string TextOf(T value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

} // namespace

SegmentParameters::SegmentParameters() = default;
SegmentParameters::~SegmentParameters() = default;

template <typename T>
void SegmentParameters::Add(CLI::App& command, const char* group, const std::string& option,
  const std::string& unit, const std::string& description, T (Filter::*get)(),
  void (Filter::*set)(T))
{
  const auto keep = [this, option, get, set](const T& value)
  {
    this->Given.push_back(
      [=](Filter* filter)
      {
        (filter->*set)(value);
        const T taken = (filter->*get)();
        if (taken != value)
        {
          throw WrongUsage(option.substr(0, option.find(',')) + ": " + TextOf(value) +
            " is out of range; the nearest is " + TextOf(taken) + ".");
        }
      });
  };
  command.add_option_function<T>(option, keep, description)
    ->type_name(unit)
    ->default_str(TextOf((this->Defaults->*get)()))
    ->group(group);
}

void SegmentParameters::AddSwitch(CLI::App& command, const char* group, const std::string& option,
  const std::string& description, void (Filter::*set)(bool))
{
  const auto keep = [this, set](std::int64_t count)
  { this->Given.emplace_back([=](Filter* filter) { (filter->*set)(count > 0); }); };
  command.add_flag_function("--" + option + ",!--no-" + option, keep, description)->group(group);
}

void SegmentParameters::AddOptions(CLI::App& command)
{
  command
    .add_option("--preset", this->Preset,
      "Which values the parameters start from: 'default', 'published' (the paper's own method: one "
      "level, no leak control, no guard) or 'naive' (without flip avoidance, too); both may give "
      "surfaces that intersect themselves. Options below change them further")
    ->type_name("NAME")
    ->check(CLI::IsMember({ "default", "published", "naive" }))
    ->capture_default_str()
    ->group(General);
  this->Add(command, General, "--resolution", "N",
    "Vertices along the edge of a side of the mesh, 6 N^2 in all", &Filter::GetResolution,
    &Filter::SetResolution);
  this->Add(command, General, "--levels", "N", "Levels from coarse to fine", &Filter::GetLevels,
    &Filter::SetLevels);
  this->Add(command, General, "--iterations,--maximum-iterations", "N",
    "Most iterations at each level", &Filter::GetMaximumIterations, &Filter::SetMaximumIterations);
  this->Add(command, General, "--search-distance", "MM",
    "Length of the search lines; 0: in proportion to the radius", &Filter::GetSearchDistance,
    &Filter::SetSearchDistance);
  this->Add(command, General, "--reach", "MM",
    "How far from the seed the surface may get; 0: ten radii, 100 to 250 mm", &Filter::GetReach,
    &Filter::SetReach);
  this->Add(command, General, "--smoothing,--diffusion-iterations", "N",
    "Iterations of the diffusion that smooths the volume", &Filter::GetDiffusionIterations,
    &Filter::SetDiffusionIterations);
  this->Add(command, General, "--foreground-mass", "P",
    "Mass of the mixture that counts as the organ", &Filter::GetForegroundMass,
    &Filter::SetForegroundMass);
  this->AddSwitch(command, General, "leak-control",
    "Cut thin bridges from the organ to its neighbors (default: on)", &Filter::SetLeakControl);
  this->AddSwitch(command, General, "guard",
    "Keep the surface from meeting itself (default: on); without, nothing is promised",
    &Filter::SetGuard);

  this->Add(command, Finer, "--diffusion-equation", "N",
    "How edges are kept: 0 by differences across faces, 1 and 2 by ITK's gradient and curvature "
    "equations",
    &Filter::GetDiffusionEquation, &Filter::SetDiffusionEquation);
  this->Add(command, Finer, "--threshold,--feature-threshold", "G",
    "Gamma of Eq. 2, 0 to 1; 0: from the foreground's mass", &Filter::GetFeatureThreshold,
    &Filter::SetFeatureThreshold);
  this->Add(command, Finer, "--components,--maximum-components", "N",
    "Most Gaussians in the mixture", &Filter::GetMaximumComponents, &Filter::SetMaximumComponents);
  this->Add(command, Finer, "--minimum-weight,--minimum-component-weight", "P",
    "Weight below which a Gaussian is taken out of the mixture", &Filter::GetMinimumComponentWeight,
    &Filter::SetMinimumComponentWeight);
  this->Add(command, Finer, "--noise-widening", "F",
    "Noise added to the mixture's deviations, in standard deviations of the volume's noise",
    &Filter::GetNoiseWidening, &Filter::SetNoiseWidening);
  this->Add(command, Finer, "--closing,--closing-radius", "MM",
    "Radius of the closing of the foreground", &Filter::GetClosingRadius,
    &Filter::SetClosingRadius);
  this->Add(command, Finer, "--opening,--opening-scale", "F",
    "Radius of the opening of the foreground, in seed radii", &Filter::GetOpeningScale,
    &Filter::SetOpeningScale);
  this->AddSwitch(command, Finer, "reestimate-intensities",
    "Fit the intensities again inside the growing surface (default: on)",
    &Filter::SetReestimateIntensities);
  this->Add(command, Finer, "--run-length", "MM",
    "Length beyond the boundary that must be background; 0: by --run-voxels", &Filter::GetRunLength,
    &Filter::SetRunLength);
  this->Add(command, Finer, "--run-voxels", "N", "The same in voxels, the paper's N + 1",
    &Filter::GetRunVoxels, &Filter::SetRunVoxels);
  this->AddSwitch(command, Finer, "search-inward",
    "Vertices in the background look inward for the organ (default: on)", &Filter::SetSearchInward);
  this->Add(command, Finer, "--search-scale", "F",
    "Length of the search lines in seed radii, where it is not given in millimeters",
    &Filter::GetSearchScale, &Filter::SetSearchScale);
  this->Add(command, Finer, "--image-boundary-distance", "MM",
    "How near the end of the volume a vertex takes the end for its target; 0: it has none",
    &Filter::GetImageBoundaryDistance, &Filter::SetImageBoundaryDistance);
  this->Add(command, Finer, "--edge-window", "MM",
    "Window in which targets move to the strongest edge", &Filter::GetEdgeWindow,
    &Filter::SetEdgeWindow);
  this->Add(command, Finer, "--normal-smoothing-iterations", "N",
    "Passes of averaging that the surface's normals get", &Filter::GetNormalSmoothingIterations,
    &Filter::SetNormalSmoothingIterations);
  this->Add(command, Finer, "--outlier-standard-deviations", "F",
    "Standard deviations beyond which a target is dropped; 0: none is",
    &Filter::GetOutlierStandardDeviations, &Filter::SetOutlierStandardDeviations);
  this->Add(command, Finer, "--maximum-displacement", "VOXELS",
    "Greatest displacement in one iteration", &Filter::GetMaximumDisplacement,
    &Filter::SetMaximumDisplacement);
  this->AddSwitch(command, Finer, "avoid-flips", "Detect and avoid flips (default: on)",
    &Filter::SetAvoidFlips);
  this->Add(command, Finer, "--flip-threshold", "R", "r of Eq. 3", &Filter::GetFlipThreshold,
    &Filter::SetFlipThreshold);
  this->Add(command, Finer, "--propagation,--propagation-iterations", "N",
    "Passes that carry displacements to solitary vertices", &Filter::GetPropagationIterations,
    &Filter::SetPropagationIterations);
  this->Add(command, Finer, "--position-weight", "F", "lambda_p of Eq. 7",
    &Filter::GetPositionWeight, &Filter::SetPositionWeight);
  this->Add(command, Finer, "--uniform-weight", "F", "lambda_u of Eq. 8", &Filter::GetUniformWeight,
    &Filter::SetUniformWeight);
  this->Add(command, Finer, "--fairing", "F",
    "From 0, the shape is kept (Eq. 5), to 1, it is smoothed", &Filter::GetFairing,
    &Filter::SetFairing);
  this->Add(command, Finer, "--distance-tolerance", "VOXELS", "Mean distance at which a level ends",
    &Filter::GetDistanceTolerance, &Filter::SetDistanceTolerance);
  this->Add(command, Finer, "--change-tolerance", "VOXELS",
    "Its change over five iterations at which a level ends; negative: never",
    &Filter::GetChangeTolerance, &Filter::SetChangeTolerance);
  this->Add(command, Finer, "--start-scale", "F", "Radius of the first sphere, in seed radii",
    &Filter::GetStartScale, &Filter::SetStartScale);
  command
    .add_option("--start-offset,--start-center-offset", this->StartOffset,
      "Center of the first sphere from the seed's, in mm, to start elsewhere than in the seed")
    ->type_name("X Y Z")
    ->expected(3)
    ->default_str("0 0 0")
    ->group(Finer);
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

} // namespace Command
