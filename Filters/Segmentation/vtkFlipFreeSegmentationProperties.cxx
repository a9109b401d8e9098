// The properties of vtkFlipFreeSegmentation: its own and those of its stages.
#include "vtkFlipFreeSegmentation.h"

#include "StageProperties.h"
#include "UnusedSettings.h"

#include "Deformation/SegmentationParameters.h"
#include "Deformation/SegmentationSettings.h"

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkNew.h"
#include "vtkSeedRegionDiffusion.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <string>
#include <utility>

#define FLIPFREE_STAGE vtkFlipFreeSegmentation

#define PROPERTIES(P)                                                                              \
  FLIPFREE_WHOLE_PARAMETERS(P, Settings->)                                                         \
  P(StartLabel, int, StartLabel, 0, VTK_INT_MAX, "")                                               \
  P(KeepForCorrections, bool, KeepForCorrections, false, true, "")

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

void vtkFlipFreeSegmentation::SetSeedRadius(double value)
{
  FlipFree::SetSeedRadius(this, value, this->SeedRadius);
}

// Name, type, the stage, and its name there.
#define FORWARDED_PROPERTIES(P)                                                                    \
  P(Reach, double, Diffusion, Reach)                                                               \
  P(DiffusionIterations, int, Diffusion, NumberOfIterations)                                       \
  P(ForegroundMass, double, Feature, ForegroundMass)                                               \
  P(LeakControl, bool, Feature, LeakControl)                                                       \
  P(SearchDistance, double, Search, SearchDistance)                                                \
  P(Guard, bool, Deform, Guard)

#define DEFINE_FORWARDED_PROPERTY(Name, type, stage, NameThere)                                    \
  void FLIPFREE_STAGE::Set##Name(type value)                                                       \
  {                                                                                                \
    this->stage->Set##NameThere(value);                                                            \
  }                                                                                                \
  type FLIPFREE_STAGE::Get##Name() const                                                           \
  {                                                                                                \
    return this->stage->Get##NameThere();                                                          \
  }

FORWARDED_PROPERTIES(DEFINE_FORWARDED_PROPERTY)

// A type cannot be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define DEFINE_STAGE(Name, type)                                                                   \
  void FLIPFREE_STAGE::Set##Name(type* stage)                                                      \
  {                                                                                                \
    if (this->Name != stage)                                                                       \
    {                                                                                              \
      this->Name = stage ? vtkSmartPointer<type>(stage) : vtkSmartPointer<type>::New();            \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  type* FLIPFREE_STAGE::Get##Name() const                                                          \
  {                                                                                                \
    return this->Name;                                                                             \
  }
// NOLINTEND(bugprone-macro-parentheses)

DEFINE_STAGE(Diffusion, vtkSeedRegionDiffusion)
DEFINE_STAGE(Feature, vtkGMMFeatureFilter)
DEFINE_STAGE(Search, vtkCorrespondenceSearch)
DEFINE_STAGE(Deform, vtkFlipFreeDeform)

vtkMTimeType vtkFlipFreeSegmentation::GetMTime()
{
  return std::max({ this->Superclass::GetMTime(), this->Diffusion->GetMTime(),
    this->Feature->GetMTime(), this->Search->GetMTime(), this->Deform->GetMTime() });
}

FlipFree::VolumeSegmentationSettings vtkFlipFreeSegmentation::GetSettings() const
{
  FlipFree::VolumeSegmentationSettings settings = *this->Settings;
  settings.Method.Smoothing = *this->Diffusion->Settings;
  settings.Method.Feature = *this->Feature->Settings;
  settings.Method.Targets = *this->Search->Settings;
  settings.Method.Step = *this->Deform->Settings;
  settings.StartCenterOffset = Eigen::Vector3d(this->StartCenterOffset);
  return settings;
}

void vtkFlipFreeSegmentation::RequireNoUnusedStageSettings(const std::string& owner) const
{
  const std::pair<const char*, vtkAlgorithm*> stages[] = { { "GetDiffusion()", this->Diffusion },
    { "GetFeature()", this->Feature }, { "GetSearch()", this->Search },
    { "GetDeform()", this->Deform } };
  for (const auto& [getter, stage] : stages)
  {
    FlipFree::RequireNoConnection(getter + owner, stage);
  }
  const std::string instead = "vtkFlipFreeSegmentation or vtkFlipFreeOrganGroup";
  FlipFree::RequireNoSeed("GetDiffusion()" + owner, this->Diffusion.Get(), instead);
  FlipFree::RequireNoSeed("GetFeature()" + owner, this->Feature.Get(), instead);
  if (this->Search->GetThreshold() != vtkNew<vtkCorrespondenceSearch>()->GetThreshold())
  {
    throw FlipFree::Error(FlipFree::ErrorCode::OutOfRange,
      "GetSearch()" + owner + " has a Threshold, which is not used; set FeatureThreshold of " +
        "GetFeature()" + owner + ", and leave Threshold at its default");
  }
}

void vtkFlipFreeSegmentation::UseSettings(const FlipFree::VolumeSegmentationSettings& settings)
{
  *this->Settings = settings;
  *this->Diffusion->Settings = settings.Method.Smoothing;
  *this->Feature->Settings = settings.Method.Feature;
  *this->Search->Settings = settings.Method.Targets;
  *this->Deform->Settings = settings.Method.Step;
  Eigen::Map<Eigen::Vector3d>(this->StartCenterOffset) = settings.StartCenterOffset;
  // Others may use the stages, too.
  this->Diffusion->Modified();
  this->Feature->Modified();
  this->Search->Modified();
  this->Deform->Modified();
  this->Modified();
}

void vtkFlipFreeSegmentation::UseMethod(const FlipFree::OrganSegmentationSettings& method)
{
  FlipFree::VolumeSegmentationSettings settings = this->GetSettings();
  settings.Method = method;
  settings.Method.Smoothing.Reach = this->GetReach(); // goes with the image
  this->UseSettings(settings);
}

void vtkFlipFreeSegmentation::UseDefaultParameters()
{
  this->UseMethod({});
}

void vtkFlipFreeSegmentation::UsePublishedParameters()
{
  this->UseMethod(FlipFree::PublishedSettings());
}

void vtkFlipFreeSegmentation::UseNaiveParameters()
{
  this->UseMethod(FlipFree::NaiveSettings());
}

void vtkFlipFreeSegmentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SeedCenter: (" << this->SeedCenter[0] << ", " << this->SeedCenter[1] << ", "
     << this->SeedCenter[2] << ")\n";
  os << indent << "SeedRadius: " << this->SeedRadius << "\n";
  os << indent << "StartCenterOffset: (" << this->StartCenterOffset[0] << ", "
     << this->StartCenterOffset[1] << ", " << this->StartCenterOffset[2] << ")\n";
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
  const std::pair<const char*, vtkObject*> stages[] = { { "Diffusion", this->Diffusion },
    { "Feature", this->Feature }, { "Search", this->Search }, { "Deform", this->Deform } };
  for (const auto& [name, stage] : stages)
  {
    os << indent << name << ":\n";
    stage->PrintSelf(os, indent.GetNextIndent());
  }
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  os << indent << "NumberOfSelfIntersections: " << this->NumberOfSelfIntersections << "\n";
  os << indent << "Confidence: " << this->Confidence << "\n";
}

#undef FLIPFREE_STAGE
#undef PROPERTIES
#undef FORWARDED_PROPERTIES
#undef DEFINE_FORWARDED_PROPERTY
#undef DEFINE_STAGE
