// The stages own the parameters of the method, and the composite obeys them.
#include "vtkConstraintPointSource.h"
#include "vtkCorrespondenceSearch.h"
#include "vtkErrorCode.h"
#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkSeedRegionDiffusion.h"

#include "BadInput.h"
#include "Deformation/SegmentationParameters.h"
#include "FilterErrors.h"
#include "Image/SeedRegion.h"

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

using namespace FlipFree;

namespace
{

using Filter = vtkFlipFreeSegmentation;

struct Property
{
  std::string Name;
  bool IsNumber; // and not a count or a switch
  double (*Get)(Filter*);
  void (*Set)(Filter*, double);
};

template <typename Owner, typename T>
void SetAs(Owner* owner, void (Owner::*set)(T), double value)
{
  (owner->*set)(static_cast<T>(value));
}

#define PROPERTY(owner, Class, Name)                                                               \
  {                                                                                                \
#Name, std::is_same_v < decltype(std::declval <Class>().Get##Name()), double>,                 \
      [](Filter * filter) { return static_cast<double>((owner)->Get##Name()); },                   \
        [](Filter * filter, double value) { SetAs<Class>(owner, &Class::Set##Name, value); }       \
  }
#define OF_FILTER(Name, ...) PROPERTY(filter, vtkFlipFreeSegmentation, Name),
#define OF_DIFFUSION(Name, ...) PROPERTY(filter->GetDiffusion(), vtkSeedRegionDiffusion, Name),
#define OF_FEATURE(Name, ...) PROPERTY(filter->GetFeature(), vtkGMMFeatureFilter, Name),
#define OF_SEARCH(Name, ...) PROPERTY(filter->GetSearch(), vtkCorrespondenceSearch, Name),
#define OF_DEFORM(Name, ...) PROPERTY(filter->GetDeform(), vtkFlipFreeDeform, Name),

// Of the kernels' lists.
const std::vector<Property>& AllProperties()
{
  // clang-format off
  static const std::vector<Property> properties{
    FLIPFREE_WHOLE_PARAMETERS(OF_FILTER, )
    FLIPFREE_SMOOTHING_PARAMETERS(OF_DIFFUSION, , NumberOfIterations)
    FLIPFREE_FEATURE_PARAMETERS(OF_FEATURE, )
    FLIPFREE_TARGET_PARAMETERS(OF_SEARCH, )
    FLIPFREE_STEP_PARAMETERS(OF_DEFORM, )
  };
  // clang-format on
  return properties;
}

// Those that a preset sets.
std::vector<Property> Properties()
{
  std::vector<Property> properties;
  for (const Property& property : AllProperties())
  {
    const std::string& name = property.Name;
    if (name != "StartScale" && name != "LabelValue" && name != "KeepHistory" && name != "Reach")
    {
      properties.push_back(property);
    }
  }
  return properties;
}

class StageParameters : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Segmentation->SetInputDataObject(SphereImage());
    this->Segmentation->SetSeedCenter(ExampleCenter.data());
    this->Segmentation->SetSeedRadius(ExampleRadius);
    this->Segmentation->SetResolution(8);
    this->Segmentation->SetLevels(1);
    this->Segmentation->SetMaximumIterations(3);
  }

  // Of the vertices that the next update gives.
  double MeanRadius()
  {
    this->Segmentation->Update();
    vtkPolyData* surface = this->Segmentation->GetSurface();
    double sum = 0;
    for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
    {
      const double* point = surface->GetPoint(vertex);
      sum += std::hypot(point[0] - ExampleCenter[0], point[1] - ExampleCenter[1],
        point[2] - ExampleCenter[2]);
    }
    return sum / static_cast<double>(surface->GetNumberOfPoints());
  }

  vtkNew<Filter> Segmentation;
};

} // namespace

TEST_F(StageParameters, PresetsSetThemAllInEveryStage)
{
  vtkNew<Filter> defaults;
  this->Segmentation->SetReach(77);
  for (const Property& property : Properties())
  {
    const double usual = property.Get(defaults);
    property.Set(this->Segmentation, usual == 1 ? 0 : 1);
    EXPECT_NE(property.Get(this->Segmentation), usual) << property.Name;
  }
  this->Segmentation->UseDefaultParameters();
  for (const Property& property : Properties())
  {
    EXPECT_EQ(property.Get(this->Segmentation), property.Get(defaults)) << property.Name;
  }

  std::map<std::string, double> published{ { "Levels", 1 }, { "MaximumIterations", 150 },
    { "MinimumComponentWeight", 0 }, { "NoiseWidening", 0 }, { "ReestimateIntensities", 0 },
    { "Carving", 0 }, { "Consensus", 0 }, { "LeakControl", 0 }, { "SearchDistance", 40 },
    { "RunLength", 0 }, { "SearchInward", 0 }, { "EdgeWindow", 0 }, { "ImageBoundaryDistance", 0 },
    { "NormalSmoothingIterations", 0 }, { "OutlierStandardDeviations", 0 },
    { "MaximumDisplacement", 0 }, { "Guard", 0 } };
  const auto expectPublished = [&]
  {
    for (const Property& property : Properties())
    {
      const auto expected = published.find(property.Name);
      EXPECT_EQ(property.Get(this->Segmentation),
        expected != published.end() ? expected->second : property.Get(defaults))
        << property.Name;
    }
  };
  const vtkMTimeType before = this->Segmentation->GetSearch()->GetMTime();
  this->Segmentation->UsePublishedParameters();
  EXPECT_GT(this->Segmentation->GetSearch()->GetMTime(), before); // it may have other consumers
  expectPublished();
  this->Segmentation->UseNaiveParameters();
  published["AvoidFlips"] = 0;
  expectPublished();
  EXPECT_EQ(this->Segmentation->GetReach(), 77); // goes with the image
}

TEST_F(StageParameters, ThatAreNotNumbersAreRefusedByName)
{
  vtkNew<Filter> defaults;
  int numbers = 0;
  for (const Property& property : AllProperties())
  {
    if (property.IsNumber)
    {
      property.Set(this->Segmentation, NotANumber);
      ExpectRefusal(this->Segmentation, { "the value of " + property.Name + " ", "NaN", "set it" });
      property.Set(this->Segmentation, property.Get(defaults));
      ++numbers;
    }
  }
  EXPECT_GE(numbers, 21);
  this->Segmentation->SetStartCenterOffset(0, NotANumber, 0);
  ExpectRefusal(this->Segmentation, { "the value of StartCenterOffset", "NaN", "set it" });
  this->Segmentation->SetStartCenterOffset(0, std::numeric_limits<double>::infinity(), 0);
  ExpectRefusal(this->Segmentation, { "the value of StartCenterOffset", "infinite", "set it" });
}

TEST_F(StageParameters, AreClampedToTheirRange)
{
  for (const Property& property : Properties())
  {
    property.Set(this->Segmentation, 2e6);
  }
  EXPECT_EQ(this->Segmentation->GetResolution(), 256);
  EXPECT_EQ(this->Segmentation->GetForegroundMass(), 0.99999);
  EXPECT_EQ(this->Segmentation->GetSearch()->GetRunLength(), 1000);
  this->Segmentation->GetSearch()->SetRunVoxels(0);
  EXPECT_EQ(this->Segmentation->GetSearch()->GetRunVoxels(), 1);
}

TEST_F(StageParameters, ThatUsersTouchAreThoseOfTheStages)
{
  this->Segmentation->SetReach(50);
  this->Segmentation->SetDiffusionIterations(2);
  this->Segmentation->SetForegroundMass(0.9);
  this->Segmentation->LeakControlOff();
  this->Segmentation->SetSearchDistance(33);
  this->Segmentation->GuardOff();
  EXPECT_EQ(this->Segmentation->GetDiffusion()->GetReach(), 50);
  EXPECT_EQ(this->Segmentation->GetDiffusion()->GetNumberOfIterations(), 2);
  EXPECT_EQ(this->Segmentation->GetFeature()->GetForegroundMass(), 0.9);
  EXPECT_FALSE(this->Segmentation->GetFeature()->GetLeakControl());
  EXPECT_EQ(this->Segmentation->GetSearch()->GetSearchDistance(), 33);
  EXPECT_FALSE(this->Segmentation->GetDeform()->GetGuard());
  this->Segmentation->GetSearch()->SetSearchDistance(22);
  EXPECT_EQ(this->Segmentation->GetSearchDistance(), 22);
}

TEST_F(StageParameters, OfAStageMakeTheCompositeExecuteAgain)
{
  const double whole = this->MeanRadius();
  this->Segmentation->GetSearch()->SetMaximumDisplacement(0.5);
  const double limited = this->MeanRadius();
  EXPECT_LT(limited, whole - 1);

  vtkNew<vtkCorrespondenceSearch> another;
  another->SetMaximumDisplacement(0.25);
  this->Segmentation->SetSearch(another);
  EXPECT_LT(this->MeanRadius(), limited - 0.5);
  another->SetMaximumDisplacement(0.5);
  EXPECT_EQ(this->MeanRadius(), limited);

  this->Segmentation->SetSearch(nullptr); // one with default parameters
  EXPECT_EQ(this->MeanRadius(), whole);
  const vtkMTimeType time = this->Segmentation->GetMTime();
  this->Segmentation->SetSearch(this->Segmentation->GetSearch());
  EXPECT_EQ(this->Segmentation->GetMTime(), time);
}

TEST_F(StageParameters, WithoutEffectAreRefused)
{
  const auto expectRefusal = [this](const std::string& text, auto&& set, auto&& unset)
  {
    set();
    ExpectRefusal(this->Segmentation, { text });
    EXPECT_EQ(this->Segmentation->GetErrorCode(),
      vtkErrorCode::UserError + static_cast<int>(ErrorCode::OutOfRange));
    EXPECT_EQ(this->Segmentation->GetSurface()->GetNumberOfPoints(), 0);
    unset();
    EXPECT_EQ(ErrorOfUpdate(this->Segmentation), "0 errors");
  };
  const auto expectSeedRefused = [&](const std::string& getter, auto* stage)
  {
    const std::string text = getter + " has a seed sphere, which is not used";
    expectRefusal(
      text, [&] { stage->SetSeedCenter(0, 0, 1); }, [&] { stage->SetSeedCenter(0, 0, 0); });
    expectRefusal(
      text, [&] { stage->SetSeedRadius(9); }, [&] { stage->SetSeedRadius(10); });
  };
  expectSeedRefused("GetDiffusion()", this->Segmentation->GetDiffusion());
  expectSeedRefused("GetFeature()", this->Segmentation->GetFeature());
  const std::map<std::string, vtkAlgorithm*> stages{
    { "GetDiffusion()", this->Segmentation->GetDiffusion() },
    { "GetFeature()", this->Segmentation->GetFeature() },
    { "GetSearch()", this->Segmentation->GetSearch() },
    { "GetDeform()", this->Segmentation->GetDeform() },
  };
  vtkNew<Filter> source;
  for (const auto& one : stages)
  {
    vtkAlgorithm* const stage = one.second;
    expectRefusal(
      one.first + " has an input on port 0, which is not used",
      [&] { stage->SetInputConnection(source->GetOutputPort()); },
      [&] { stage->SetInputConnection(nullptr); });
  }
  vtkCorrespondenceSearch* const search = this->Segmentation->GetSearch();
  expectRefusal(
    "GetSearch() has a Threshold, which is not used", [&] { search->SetThreshold(0.5); },
    [&] { search->SetThreshold(vtkNew<vtkCorrespondenceSearch>()->GetThreshold()); });
}

// As the kernels have it.
TEST_F(StageParameters, RadiiOfSeedsHaveOneRange)
{
  const auto expectRange = [](auto&& set, auto&& get)
  {
    for (const auto& [given, taken] : { std::pair(0.0, MinimumSeedRadius), std::pair(12.5, 12.5),
           std::pair(1e9, MaximumSeedRadius) })
    {
      set(given);
      EXPECT_EQ(get(), taken);
    }
  };
  vtkNew<vtkFlipFreeSegmentation> whole;
  expectRange([&](double value) { whole->SetSeedRadius(value); },
    [&] { return whole->GetSeedRadius(); });
  vtkNew<vtkSeedRegionDiffusion> diffusion;
  expectRange([&](double value) { diffusion->SetSeedRadius(value); },
    [&] { return diffusion->GetSeedRadius(); });
  vtkNew<vtkGMMFeatureFilter> feature;
  expectRange([&](double value) { feature->SetSeedRadius(value); },
    [&] { return feature->GetSeedRadius(); });
  vtkNew<vtkConstraintPointSource> point;
  expectRange([&](double value) { point->SetRadius(value); }, [&] { return point->GetRadius(); });
  const vtkMTimeType before = point->GetMTime();
  point->SetRadius(1e7);
  EXPECT_EQ(point->GetMTime(), before);
}

#undef PROPERTY
#undef OF_FILTER
#undef OF_DIFFUSION
#undef OF_FEATURE
#undef OF_SEARCH
#undef OF_DEFORM
