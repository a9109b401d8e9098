#include "SegmentParameters.h"

#include "Failure.h"

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkGMMFeatureFilter.h"

#include <CLI/CLI.hpp>

#include <sstream>
#include <type_traits>

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

// The stage, or without one the filter itself.
template <typename Owner>
Owner* OwnerOf(Filter* filter, Owner* (Filter::*stage)() const)
{
  if constexpr (std::is_same_v<Owner, Filter>)
  {
    return filter;
  }
  else
  {
    return (filter->*stage)();
  }
}

} // namespace

SegmentParameters::SegmentParameters() = default;
SegmentParameters::~SegmentParameters() = default;

template <typename T, typename Owner>
void SegmentParameters::Add(CLI::App& command, const char* group, const std::string& option,
  const std::string& unit, const std::string& description, T (Owner::*get)() const,
  void (Owner::*set)(T), Owner* (Filter::*stage)() const)
{
  const auto keep = [this, option, get, set, stage](const T& value)
  {
    this->Given.push_back(
      [=](Filter* filter)
      {
        Owner* const owner = OwnerOf(filter, stage);
        (owner->*set)(value);
        const T taken = (owner->*get)();
        if (taken != value)
        {
          throw WrongUsage(option.substr(0, option.find(',')) + ": " + TextOf(value) +
            " is out of range; the nearest is " + TextOf(taken) + ".");
        }
      });
  };
  command.add_option_function<T>(option, keep, description)
    ->type_name(unit)
    ->default_str(TextOf((OwnerOf<Owner>(this->Defaults, stage)->*get)()))
    ->group(group);
}

template <typename Owner>
void SegmentParameters::AddSwitch(CLI::App& command, const char* group, const std::string& option,
  const std::string& description, void (Owner::*set)(bool), Owner* (Filter::*stage)() const)
{
  const auto keep = [this, set, stage](std::int64_t count)
  { this->Given.emplace_back([=](Filter* filter) { (OwnerOf(filter, stage)->*set)(count > 0); }); };
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

  this->Add(command, Finer, "--threshold,--feature-threshold", "G",
    "Gamma of Eq. 2, 0 to 1; 0: from the foreground's mass",
    &vtkGMMFeatureFilter::GetFeatureThreshold, &vtkGMMFeatureFilter::SetFeatureThreshold,
    &Filter::GetFeature);
  this->Add(command, Finer, "--components,--maximum-components", "N",
    "Most Gaussians in the mixture", &vtkGMMFeatureFilter::GetMaximumComponents,
    &vtkGMMFeatureFilter::SetMaximumComponents, &Filter::GetFeature);
  this->Add(command, Finer, "--minimum-weight,--minimum-component-weight", "P",
    "Weight below which a Gaussian is taken out of the mixture",
    &vtkGMMFeatureFilter::GetMinimumComponentWeight,
    &vtkGMMFeatureFilter::SetMinimumComponentWeight, &Filter::GetFeature);
  this->Add(command, Finer, "--noise-widening", "F",
    "Noise added to the mixture's deviations, in standard deviations of the volume's noise",
    &vtkGMMFeatureFilter::GetNoiseWidening, &vtkGMMFeatureFilter::SetNoiseWidening,
    &Filter::GetFeature);
  this->Add(command, Finer, "--closing,--closing-radius", "MM",
    "Radius of the closing of the foreground", &vtkGMMFeatureFilter::GetClosingRadius,
    &vtkGMMFeatureFilter::SetClosingRadius, &Filter::GetFeature);
  this->Add(command, Finer, "--opening,--opening-scale", "F",
    "Radius of the opening of the foreground, in seed radii", &vtkGMMFeatureFilter::GetOpeningScale,
    &vtkGMMFeatureFilter::SetOpeningScale, &Filter::GetFeature);
  this->AddSwitch(command, Finer, "reestimate-intensities",
    "Fit the intensities again inside the growing surface (default: on)",
    &vtkGMMFeatureFilter::SetReestimateIntensities, &Filter::GetFeature);
  this->Add(command, Finer, "--run-length", "MM",
    "Length beyond the boundary that must be background; 0: by --run-voxels",
    &vtkCorrespondenceSearch::GetRunLength, &vtkCorrespondenceSearch::SetRunLength,
    &Filter::GetSearch);
  this->Add(command, Finer, "--run-voxels", "N", "The same in voxels, the paper's N + 1",
    &vtkCorrespondenceSearch::GetRunVoxels, &vtkCorrespondenceSearch::SetRunVoxels,
    &Filter::GetSearch);
  this->AddSwitch(command, Finer, "search-inward",
    "Vertices in the background look inward for the organ (default: on)",
    &vtkCorrespondenceSearch::SetSearchInward, &Filter::GetSearch);
  this->Add(command, Finer, "--search-scale", "F",
    "Length of the search lines in seed radii, where it is not given in millimeters",
    &vtkCorrespondenceSearch::GetSearchScale, &vtkCorrespondenceSearch::SetSearchScale,
    &Filter::GetSearch);
  this->Add(command, Finer, "--image-boundary-distance", "MM",
    "How near the end of the volume a vertex takes the end for its target; 0: it has none",
    &vtkCorrespondenceSearch::GetImageBoundaryDistance,
    &vtkCorrespondenceSearch::SetImageBoundaryDistance, &Filter::GetSearch);
  this->Add(command, Finer, "--edge-window", "MM",
    "Window in which targets move to the strongest edge", &vtkCorrespondenceSearch::GetEdgeWindow,
    &vtkCorrespondenceSearch::SetEdgeWindow, &Filter::GetSearch);
  this->Add(command, Finer, "--normal-smoothing-iterations", "N",
    "Passes of averaging that the surface's normals get",
    &vtkCorrespondenceSearch::GetNormalSmoothingIterations,
    &vtkCorrespondenceSearch::SetNormalSmoothingIterations, &Filter::GetSearch);
  this->Add(command, Finer, "--outlier-standard-deviations", "F",
    "Standard deviations beyond which a target is dropped; 0: none is",
    &vtkCorrespondenceSearch::GetOutlierStandardDeviations,
    &vtkCorrespondenceSearch::SetOutlierStandardDeviations, &Filter::GetSearch);
  this->Add(command, Finer, "--maximum-displacement", "VOXELS",
    "Greatest displacement in one iteration", &vtkCorrespondenceSearch::GetMaximumDisplacement,
    &vtkCorrespondenceSearch::SetMaximumDisplacement, &Filter::GetSearch);
  this->AddSwitch(command, Finer, "avoid-flips", "Detect and avoid flips (default: on)",
    &vtkFlipFreeDeform::SetAvoidFlips, &Filter::GetDeform);
  this->Add(command, Finer, "--flip-threshold", "R", "r of Eq. 3",
    &vtkFlipFreeDeform::GetFlipThreshold, &vtkFlipFreeDeform::SetFlipThreshold, &Filter::GetDeform);
  this->Add(command, Finer, "--propagation,--propagation-iterations", "N",
    "Passes that carry displacements to solitary vertices",
    &vtkFlipFreeDeform::GetPropagationIterations, &vtkFlipFreeDeform::SetPropagationIterations,
    &Filter::GetDeform);
  this->Add(command, Finer, "--position-weight", "F", "lambda_p of Eq. 7",
    &vtkFlipFreeDeform::GetPositionWeight, &vtkFlipFreeDeform::SetPositionWeight,
    &Filter::GetDeform);
  this->Add(command, Finer, "--uniform-weight", "F", "lambda_u of Eq. 8",
    &vtkFlipFreeDeform::GetUniformWeight, &vtkFlipFreeDeform::SetUniformWeight, &Filter::GetDeform);
  this->Add(command, Finer, "--fairing", "F",
    "From 0, the shape is kept (Eq. 5), to 1, it is smoothed", &vtkFlipFreeDeform::GetFairing,
    &vtkFlipFreeDeform::SetFairing, &Filter::GetDeform);
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
