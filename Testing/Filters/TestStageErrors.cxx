// Whatever is wrong with the input of a single stage: one error that says what, where, and what to
// do, and an empty output.
#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeRefinement.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkQuadSphereSource.h"
#include "vtkSeedRegionDiffusion.h"

#include "BadInput.h"
#include "FilterErrors.h"
#include "MemoryLimit.h"

#include "vtkBitArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkUnsignedCharArray.h"

#include <functional>

using namespace FlipFree;

namespace
{

void AddFieldArray(const char* name, const std::vector<double>& values, vtkDataObject* data)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  data->GetFieldData()->AddArray(array);
}

// The images that no stage takes, with what is said of them after their name.
void ForEachBadImage(const std::function<void(vtkImageData*, const std::string&)>& visit)
{
  visit(vtkNew<vtkImageData>(), "no voxels");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(32, 32, 32);
  visit(bare, "no point scalars");
  visit(ImageOfType(VTK_FLOAT, 2), "2 components");
  const auto bits = ImageOfType(VTK_FLOAT);
  vtkNew<vtkBitArray> array;
  array->SetName("Mask");
  array->SetNumberOfValues(bits->GetNumberOfPoints());
  bits->GetPointData()->SetScalars(array);
  visit(bits, "are of type bit");
  visit(ImageWith(NotANumber), "not a finite number");
  visit(ImageWith(Infinite), "not a finite number");
  const auto flat = SphereImage();
  for (const double spacing : { 0, -3 })
  {
    flat->SetSpacing(3, 3, spacing);
    visit(flat, "has a spacing of (3, 3, ");
  }
}

// The surfaces that no stage takes.
void ForEachBadSurface(const std::function<void(vtkPolyData*, const std::string&)>& visit)
{
  visit(vtkNew<vtkPolyData>(), "no points");
  visit(OpenSphere(), "faces instead of 4");
  visit(TriangulatedBox(), "faces instead of 4");
  visit(SphereWithPointAt(NotANumber), "point 7");
}

void ExpectSeedsRefused(vtkAlgorithm* filter, const std::function<void(double, double)>& setSeed)
{
  setSeed(1000, 10);
  ExpectRefusal(filter, { "(1000, 45, 45) mm", "outside the image on port 0", "physical" });
  setSeed(45, 1);
  ExpectRefusal(filter, { "radius of 1 mm", "below a voxel of the image on port 0", "enlarge" });
}

} // namespace

class SeedRegionDiffusionRefuses : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Filter->SetInputData(SphereImage());
    this->Filter->SetSeedCenter(ExampleCenter.data());
    this->Filter->SetSeedRadius(ExampleRadius);
  }
  vtkNew<vtkSeedRegionDiffusion> Filter;
};

TEST_F(SeedRegionDiffusionRefuses, NothingThatIsGood)
{
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 32 * 32 * 32);
}

TEST_F(SeedRegionDiffusionRefuses, NoInput)
{
  this->Filter->SetInputDataObject(nullptr);
  ExpectPipelineRefusal(this->Filter, "port 0");
}

TEST_F(SeedRegionDiffusionRefuses, BadImages)
{
  ForEachBadImage(
    [this](vtkImageData* image, const std::string& what)
    {
      this->Filter->SetInputData(image);
      ExpectRefusal(this->Filter, { "the image on port 0", what });
    });
}

TEST_F(SeedRegionDiffusionRefuses, SeedsOutsideOrTooSmall)
{
  ExpectSeedsRefused(this->Filter,
    [this](double x, double radius)
    {
      this->Filter->SetSeedCenter(x, 45, 45);
      this->Filter->SetSeedRadius(radius);
    });
}

class FeatureFilterRefuses : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Filter->SetInputData(SphereImage());
    this->Filter->SetSeedCenter(ExampleCenter.data());
    this->Filter->SetSeedRadius(ExampleRadius);
  }
  vtkNew<vtkGMMFeatureFilter> Filter;
};

TEST_F(FeatureFilterRefuses, NothingThatIsGood)
{
  this->Filter->SetSurfaceData(StartSphere(20));
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 32 * 32 * 32);
}

TEST_F(FeatureFilterRefuses, NoInput)
{
  this->Filter->SetInputDataObject(nullptr);
  ExpectPipelineRefusal(this->Filter, "port 0");
}

TEST_F(FeatureFilterRefuses, BadImages)
{
  ForEachBadImage(
    [this](vtkImageData* image, const std::string& what)
    {
      this->Filter->SetInputData(image);
      ExpectRefusal(this->Filter, { "the image on port 0", what });
    });
}

TEST_F(FeatureFilterRefuses, SeedsOutsideOrTooSmall)
{
  ExpectSeedsRefused(this->Filter,
    [this](double x, double radius)
    {
      this->Filter->SetSeedCenter(x, 45, 45);
      this->Filter->SetSeedRadius(radius);
    });
}

TEST_F(FeatureFilterRefuses, NoContrast)
{
  this->Filter->SetInputData(ImageOfType(VTK_SHORT));
  ExpectRefusal(this->Filter, { "no contrast" });
}

TEST_F(FeatureFilterRefuses, AnOpenSurface)
{
  this->Filter->SetSurfaceData(OpenSphere());
  ExpectRefusal(this->Filter, { "the surface on port 1", "closed", "fill holes" });
}

TEST_F(FeatureFilterRefuses, ASurfaceThatIsNone)
{
  this->Filter->SetSurfaceData(vtkNew<vtkPolyData>());
  ExpectRefusal(this->Filter, { "the surface on port 1 has no points" });
  this->Filter->SetSurfaceData(SphereWithPointAt(Infinite));
  ExpectRefusal(this->Filter, { "point 7 of the surface on port 1", "repair" });
}

TEST_F(FeatureFilterRefuses, ASurfaceElsewhere)
{
  const auto moved = StartSphere(20);
  for (vtkIdType point = 0; point < moved->GetNumberOfPoints(); ++point)
  {
    double place[3];
    moved->GetPoint(point, place);
    moved->GetPoints()->SetPoint(point, -place[0], -place[1], place[2]); // as in another frame
  }
  this->Filter->SetSurfaceData(moved);
  ExpectRefusal(this->Filter,
    { "the surface on port 1 holds no voxel of the image on port 0", "physical coordinates" });
}

// It has no part in the feature, and a warning says so.
TEST_F(FeatureFilterRefuses, ButNotASurfaceOfFewVoxels)
{
  this->Filter->Update();
  vtkNew<vtkImageData> ofSeed;
  ofSeed->DeepCopy(this->Filter->GetOutput());
  std::vector<std::string> warnings;
  KeepWarnings(this->Filter, warnings);
  this->Filter->SetSurfaceData(StartSphere(10));
  this->Filter->Update();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("surface on port 1 has no more than 200 voxels"), std::string::npos)
    << warnings[0];
  vtkDataArray* const expected = ofSeed->GetPointData()->GetScalars();
  vtkDataArray* const feature = this->Filter->GetOutput()->GetPointData()->GetScalars();
  ASSERT_EQ(feature->GetNumberOfTuples(), expected->GetNumberOfTuples());
  for (vtkIdType voxel = 0; voxel < feature->GetNumberOfTuples(); ++voxel)
  {
    ASSERT_EQ(feature->GetTuple1(voxel), expected->GetTuple1(voxel));
  }
  // Nor does it hide that the seed has no contrast.
  this->Filter->SetInputData(ImageOfType(VTK_SHORT));
  ExpectRefusal(this->Filter, { "no contrast" });
}

TEST_F(FeatureFilterRefuses, NoiseThatIsNoNumber)
{
  for (const auto& noise : { std::vector<double>{ NotANumber }, { -1 }, { 1, 2 }, {} })
  {
    const auto image = SphereImage();
    AddFieldArray("NoiseStandardDeviation", noise, image);
    this->Filter->SetInputData(image);
    ExpectRefusal(this->Filter, { "NoiseStandardDeviation of the image on port 0", "remove it" });
  }
}

class CorrespondenceSearchRefuses : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Feature = SphereImage(); // as good as any: what counts is its threshold
    AddFieldArray("FeatureThreshold", { 0.5 }, this->Feature);
    this->Filter->SetInputData(StartSphere());
    this->Filter->SetFeatureData(this->Feature);
  }
  vtkNew<vtkCorrespondenceSearch> Filter;
  vtkSmartPointer<vtkImageData> Feature;
};

TEST_F(CorrespondenceSearchRefuses, NothingThatIsGood)
{
  this->Filter->SetEdgeData(SphereImage());
  this->Filter->SetEdgeWindow(3);
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 96);
}

TEST_F(CorrespondenceSearchRefuses, NoSurfaceOrNoFeature)
{
  this->Filter->SetInputDataObject(0, nullptr);
  ExpectPipelineRefusal(this->Filter, "port 0");
  this->Filter->SetInputData(StartSphere());
  this->Filter->SetInputDataObject(1, nullptr);
  ExpectPipelineRefusal(this->Filter, "port 1");
}

TEST_F(CorrespondenceSearchRefuses, BadSurfaces)
{
  ForEachBadSurface(
    [this](vtkPolyData* surface, const std::string& what)
    {
      this->Filter->SetInputData(surface);
      ExpectRefusal(this->Filter, { "the surface on port 0", what });
    });
}

TEST_F(CorrespondenceSearchRefuses, BadFeatures)
{
  ForEachBadImage(
    [this](vtkImageData* image, const std::string& what)
    {
      this->Filter->SetFeatureData(image);
      ExpectRefusal(this->Filter, { "the feature on port 1", what });
    });
}

TEST_F(CorrespondenceSearchRefuses, BadEdges)
{
  this->Filter->SetEdgeWindow(3);
  ExpectRefusal(this->Filter, { "the edge image on port 2", "no voxels", "connect" });
  ForEachBadImage(
    [this](vtkImageData* image, const std::string& what)
    {
      this->Filter->SetEdgeData(image);
      ExpectRefusal(this->Filter, { "the edge image on port 2", what });
    });
}

TEST_F(CorrespondenceSearchRefuses, EdgesOnAnotherGrid)
{
  this->Filter->SetEdgeWindow(3);
  const auto edges = SphereImage();
  edges->SetOrigin(1, 0, 0);
  this->Filter->SetEdgeData(edges);
  ExpectRefusal(this->Filter,
    { "origins", "the edge image on port 2", "the feature on port 1", "resample" });
}

TEST_F(CorrespondenceSearchRefuses, FieldArraysOfAnotherShape)
{
  for (const auto& threshold : { std::vector<double>{ NotANumber }, { 0.2, 0.3 }, { -0.5 } })
  {
    AddFieldArray("FeatureThreshold", threshold, this->Feature);
    this->Filter->Modified();
    ExpectRefusal(this->Filter, { "FeatureThreshold of the feature on port 1", "remove it" });
  }
  AddFieldArray("FeatureThreshold", { 0.5 }, this->Feature);
  for (const auto& ramp : { std::vector<double>{ 0, NotANumber, 1 }, { 0, 1 } })
  {
    AddFieldArray("EdgeRamp", ramp, this->Feature);
    this->Filter->Modified();
    ExpectRefusal(this->Filter, { "EdgeRamp of the feature on port 1", "3 finite", "remove it" });
  }
}

class DeformRefuses : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Surface = StartSphere();
    this->AddArrays<vtkDoubleArray, vtkUnsignedCharArray>(3, 1, 96);
  }
  template <typename DisplacementArray, typename StateArray>
  void AddArrays(int components, int stateComponents, vtkIdType size)
  {
    vtkNew<DisplacementArray> displacement;
    displacement->SetName("Displacement");
    displacement->SetNumberOfComponents(components);
    displacement->SetNumberOfTuples(size);
    displacement->Fill(0.1);
    vtkNew<StateArray> state;
    state->SetName("Correspondence");
    state->SetNumberOfComponents(stateComponents);
    state->SetNumberOfTuples(size);
    state->Fill(1);
    this->Surface->GetPointData()->Initialize();
    this->Surface->GetPointData()->AddArray(displacement);
    this->Surface->GetPointData()->AddArray(state);
  }
  vtkPointData* Arrays() { return this->Surface->GetPointData(); }
  void ExpectRefused(const std::vector<std::string>& parts)
  {
    this->Filter->SetInputData(this->Surface);
    this->Filter->Modified();
    ExpectRefusal(this->Filter, parts);
  }

  vtkNew<vtkFlipFreeDeform> Filter;
  vtkSmartPointer<vtkPolyData> Surface;
};

TEST_F(DeformRefuses, NothingThatIsGood)
{
  this->Filter->SetInputData(this->Surface);
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 96);
}

TEST_F(DeformRefuses, NoInput)
{
  this->Filter->SetInputDataObject(nullptr);
  ExpectPipelineRefusal(this->Filter, "port 0");
}

TEST_F(DeformRefuses, BadSurfaces)
{
  ForEachBadSurface(
    [this](vtkPolyData* surface, const std::string& what)
    {
      this->Surface = surface;
      this->ExpectRefused({ "the surface on port 0", what });
    });
}

TEST_F(DeformRefuses, ASelfIntersectingSurfaceUnlessTheGuardIsOff)
{
  this->Surface->SetPoints(SelfIntersectingSphere()->GetPoints());
  this->ExpectRefused({ "the surface on port 0", "intersects itself", "Guard" });
  this->Filter->GuardOff();
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
}

TEST_F(DeformRefuses, ASurfaceInsideOut)
{
  this->Surface->SetPolys(SphereInsideOut()->GetPolys());
  this->ExpectRefused({ "the surface on port 0", "inside out", "vtkReverseSense" });
}

TEST_F(DeformRefuses, MissingArrays)
{
  this->Arrays()->RemoveArray("Correspondence");
  this->ExpectRefused({ "the surface on port 0", "Correspondence", "vtkCorrespondenceSearch" });
  this->Arrays()->RemoveArray("Displacement");
  this->ExpectRefused({ "the surface on port 0", "Displacement", "vtkCorrespondenceSearch" });
}

TEST_F(DeformRefuses, ArraysOfAnotherTypeOrShape)
{
  this->AddArrays<vtkFloatArray, vtkUnsignedCharArray>(3, 1, 96);
  this->ExpectRefused({ "the surface on port 0", "Displacement", "96 tuples of 3 x float" });
  this->AddArrays<vtkDoubleArray, vtkUnsignedCharArray>(2, 1, 96);
  this->ExpectRefused({ "the surface on port 0", "Displacement", "96 tuples of 2 x double" });
  this->AddArrays<vtkDoubleArray, vtkUnsignedCharArray>(3, 1, 95);
  this->ExpectRefused({ "the surface on port 0", "Displacement", "95 tuples of 3 x double" });
  this->AddArrays<vtkDoubleArray, vtkDoubleArray>(3, 1, 96);
  this->ExpectRefused({ "the surface on port 0", "Correspondence", "96 tuples of 1 x double" });
  this->AddArrays<vtkDoubleArray, vtkUnsignedCharArray>(3, 2, 96);
  this->ExpectRefused({ "the surface on port 0", "Correspondence", "2 x unsigned char" });
}

TEST_F(DeformRefuses, DisplacementsThatAreNotFinite)
{
  for (const double value : { NotANumber, Infinite })
  {
    this->AddArrays<vtkDoubleArray, vtkUnsignedCharArray>(3, 1, 96);
    this->Arrays()->GetArray("Displacement")->SetComponent(11, 1, value);
    this->ExpectRefused(
      { "Displacement of the surface on port 0", "not finite at point 11", "set it to zero" });
  }
}

TEST_F(DeformRefuses, DisplacementsBeyondComputation)
{
  for (const bool guard : { true, false })
  {
    this->Filter->SetGuard(guard);
    this->Arrays()->GetArray("Displacement")->Fill(1e300);
    this->ExpectRefused({ "displacements", "too long", "limit" });
  }
}

TEST_F(DeformRefuses, AStateThatDoesNotExist)
{
  this->Arrays()->GetArray("Correspondence")->SetComponent(12, 0, 3);
  this->ExpectRefused(
    { "Correspondence of the surface on port 0", "value 3 at point 12", "0 for solitary" });
}

TEST_F(DeformRefuses, ButNotASurfaceThatNothingMoves)
{
  this->Arrays()->GetArray("Displacement")->Fill(0);
  this->Arrays()->GetArray("Correspondence")->Fill(0);
  this->Filter->SetInputData(this->Surface);
  this->Filter->SetUniformWeight(0);
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  for (vtkIdType vertex = 0; vertex < 96; ++vertex)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(this->Filter->GetOutput()->GetPoint(vertex)[axis],
        this->Surface->GetPoint(vertex)[axis], 1e-9);
    }
  }
}

TEST(RefinementRefuses, BadSurfaces)
{
  vtkNew<vtkFlipFreeRefinement> filter;
  ForEachBadSurface(
    [&filter](vtkPolyData* surface, const std::string& what)
    {
      filter->SetInputData(surface);
      ExpectRefusal(filter, { "the surface on port 0", what });
    });
  filter->SetInputData(SelfIntersectingSphere());
  ExpectRefusal(filter, { "the surface on port 0", "intersects itself", "Check" });
  filter->SetInputData(SphereInsideOut());
  ExpectRefusal(filter, { "the surface on port 0", "inside out" });
  filter->SetInputDataObject(nullptr);
  ExpectPipelineRefusal(filter, "port 0");
  filter->SetInputData(StartSphere());
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 4 * 96);
}

TEST_F(SeedRegionDiffusionRefuses, PropertiesThatAreNotNumbers)
{
  this->Filter->SetReach(NotANumber);
  ExpectRefusal(this->Filter, { "the property Reach", "NaN" });
}

TEST_F(FeatureFilterRefuses, PropertiesThatAreNotNumbers)
{
  this->Filter->SetForegroundMass(NotANumber);
  ExpectRefusal(this->Filter, { "the property ForegroundMass", "NaN" });
}

TEST_F(CorrespondenceSearchRefuses, PropertiesThatAreNotNumbers)
{
  this->Filter->SetSearchDistance(NotANumber);
  ExpectRefusal(this->Filter, { "the property SearchDistance", "NaN" });
}

TEST_F(DeformRefuses, PropertiesThatAreNotNumbers)
{
  this->Filter->SetUniformWeight(NotANumber);
  this->ExpectRefused({ "the property UniformWeight", "NaN" });
}

#ifdef FLIPFREE_CAN_LIMIT_MEMORY
TEST(QuadSphereSourceRefuses, WhatTheMemoryDoesNotHold)
{
  vtkNew<vtkQuadSphereSource> source;
  source->SetResolution(1024);
  const MemoryLimit limit(32 << 20);
  ExpectRefusal(source, { "No sphere: ", "lower Resolution (1024)" });
}
#endif

TEST(QuadSphereSourceRefuses, NumbersThatAreNotFinite)
{
  vtkNew<vtkQuadSphereSource> source;
  source->SetCenter(0, NotANumber, 0);
  ExpectRefusal(source, { "Center (", "nan", "finite" });
  source->SetCenter(0, 0, 0);
  source->SetRadius(NotANumber);
  ExpectRefusal(source, { "Radius (nan)", "finite" });
  source->SetRadius(1);
  EXPECT_EQ(ErrorOfUpdate(source), "0 errors");
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 6144);
}
