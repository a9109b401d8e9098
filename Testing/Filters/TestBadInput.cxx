// Every filter of the method against the matrix of bad input, and what is wrong with the input of
// one filter alone: a single error that says what, where, and what to do; and empty outputs. Good
// input then gives the same as before.
#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeRefinement.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkQuadSphereSource.h"
#include "vtkSeedRegionDiffusion.h"
#include "vtkSegmentationMetrics.h"
#include "vtkSurfaceToLabelMap.h"
#include "vtkSurfaceValidity.h"
#include "vtkVesselPath.h"

#include "BadInput.h"
#include "FlipFreeErrorCode.h"
#include "MemoryLimit.h"

#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkTable.h"
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

// Each filter with good input.

template <typename Filter>
vtkSmartPointer<Filter> MakeSeeded()
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputDataObject(0, SphereImage());
  filter->SetSeedCenter(ExampleCenter.data());
  filter->SetSeedRadius(ExampleRadius);
  return filter;
}

vtkSmartPointer<vtkFlipFreeSegmentation> MakeSegmentation()
{
  auto filter = MakeSeeded<vtkFlipFreeSegmentation>();
  filter->SetResolution(8);
  filter->SetLevels(2);
  filter->SetMaximumIterations(3);
  return filter;
}

vtkSmartPointer<vtkFlipFreeSegmentation> MakeStartedSegmentation()
{
  auto filter = MakeSegmentation();
  filter->SetStartData(StartSphere());
  return filter;
}

template <typename Filter>
vtkSmartPointer<Filter> MakeVessel()
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputDataObject(0, SphereImage());
  for (const double offset : { -10.0, 10.0 })
  {
    filter->AddPoint(ExampleCenter[0] + offset, ExampleCenter[1], ExampleCenter[2]);
  }
  return filter;
}

vtkSmartPointer<vtkCorrespondenceSearch> MakeSearch()
{
  const auto feature = SphereImage(); // as good as any: what counts is its threshold
  AddFieldArray("FeatureThreshold", { 0.5 }, feature);
  auto filter = vtkSmartPointer<vtkCorrespondenceSearch>::New();
  filter->SetInputData(StartSphere());
  filter->SetFeatureData(feature);
  filter->SetEdgeData(SphereImage());
  return filter;
}

template <typename DisplacementArray = vtkDoubleArray, typename StateArray = vtkUnsignedCharArray>
vtkSmartPointer<vtkPolyData> SphereWithDisplacements(int components = 3, int stateComponents = 1,
  vtkIdType size = 96)
{
  const auto sphere = StartSphere();
  vtkNew<DisplacementArray> displacement;
  displacement->SetName("Displacement");
  displacement->SetNumberOfComponents(components);
  displacement->SetNumberOfTuples(size);
  displacement->Fill(0.1);
  sphere->GetPointData()->AddArray(displacement);
  vtkNew<StateArray> state;
  state->SetName("Correspondence");
  state->SetNumberOfComponents(stateComponents);
  state->SetNumberOfTuples(size);
  state->Fill(1);
  sphere->GetPointData()->AddArray(state);
  return sphere;
}

vtkSmartPointer<vtkFlipFreeDeform> MakeDeform()
{
  auto filter = vtkSmartPointer<vtkFlipFreeDeform>::New();
  filter->SetInputData(SphereWithDisplacements());
  return filter;
}

vtkSmartPointer<vtkFlipFreeRefinement> MakeRefinement()
{
  auto filter = vtkSmartPointer<vtkFlipFreeRefinement>::New();
  filter->SetInputData(StartSphere());
  return filter;
}

vtkSmartPointer<vtkSegmentationMetrics> MakeMetrics()
{
  auto filter = vtkSmartPointer<vtkSegmentationMetrics>::New();
  filter->SetInputData(StartSphere());
  filter->SetReferenceData(SphereLabels());
  filter->SetSampleSpacing(10);
  return filter;
}

vtkSmartPointer<vtkSurfaceToLabelMap> MakeLabelMap()
{
  auto filter = vtkSmartPointer<vtkSurfaceToLabelMap>::New();
  filter->SetInputData(StartSphere());
  filter->SetReferenceImageData(SphereImage());
  return filter;
}

vtkSmartPointer<vtkSurfaceValidity> MakeValidity()
{
  auto filter = vtkSmartPointer<vtkSurfaceValidity>::New();
  filter->SetInputData(StartSphere());
  return filter;
}

// The points, polygons and arrays of all outputs, bit by bit, but for measured times.
std::string BytesOf(vtkAlgorithm* filter)
{
  std::string bytes;
  const auto append = [&bytes](vtkAbstractArray* array)
  {
    auto* numbers = vtkDataArray::SafeDownCast(array);
    const std::string name = numbers && numbers->GetName() ? numbers->GetName() : "";
    if (numbers && name.find("Seconds") == std::string::npos)
    {
      bytes.append(static_cast<const char*>(numbers->GetVoidPointer(0)),
        numbers->GetNumberOfValues() * numbers->GetDataTypeSize());
    }
  };
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = filter->GetOutputDataObject(port);
    for (const int type : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::ROW })
    {
      vtkFieldData* arrays = output->GetAttributesAsFieldData(type);
      for (int array = 0; arrays && array < arrays->GetNumberOfArrays(); ++array)
      {
        append(arrays->GetAbstractArray(array));
      }
    }
    auto* surface = vtkPolyData::SafeDownCast(output);
    if (surface && surface->GetPoints())
    {
      append(surface->GetPoints()->GetData());
      append(surface->GetPolys()->GetConnectivityArray());
    }
  }
  return bytes;
}

// The filter has good input on the port, which works again after each that was refused.
template <typename Data>
void ExpectRefusedAndRecovered(const std::vector<Bad<Data>>& inputs, vtkAlgorithm* filter, int port,
  const std::string& noun)
{
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  const std::string expected = BytesOf(filter);
  EXPECT_FALSE(expected.empty());
  const vtkSmartPointer<vtkDataObject> good =
    filter->GetNumberOfInputConnections(port) > 0 ? filter->GetInputDataObject(port, 0) : nullptr;
  for (const Bad<Data>& bad : inputs)
  {
    SCOPED_TRACE(bad.Name);
    ExpectRefused<Data>({ bad }, filter, port, noun);
    filter->SetInputDataObject(port, good);
    EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
    EXPECT_TRUE(BytesOf(filter) == expected);
  }
}

constexpr vtkIdType Any = -1;

struct Port
{
  const char* Name;
  std::function<vtkSmartPointer<vtkAlgorithm>()> Make;
  int Index;
  const char* Noun; ///< by which messages call it
  vtkIdType Points; ///< of the first output, for good input; Any where that is no matter
  bool Optional = false;
};

void PrintTo(const Port& port, std::ostream* stream)
{
  *stream << port.Name;
}

std::string NameOf(const testing::TestParamInfo<Port>& port)
{
  return port.param.Name;
}

class AnyPort : public testing::TestWithParam<Port>
{
protected:
  vtkSmartPointer<vtkAlgorithm> Filter = GetParam().Make();
};
using ImagePort = AnyPort;

class SurfacePort : public AnyPort
{
};

class PolygonPort : public AnyPort
{
};

constexpr vtkIdType Voxels = 32 * 32 * 32;
const Port ImagePorts[] = {
  { "Diffusion", MakeSeeded<vtkSeedRegionDiffusion>, 0, "the image on port 0", Voxels },
  { "Feature", MakeSeeded<vtkGMMFeatureFilter>, 0, "the image on port 0", Voxels },
  { "SearchFeature", MakeSearch, 1, "the feature on port 1", 96 },
  { "SearchEdges", MakeSearch, 2, "the edge image on port 2", 96, true },
  { "Segmentation", MakeSegmentation, 0, "the image on port 0", 6 * 8 * 8 },
  { "VesselPath", MakeVessel<vtkVesselPath>, 0, "the image on port 0", Any },
  { "VesselSegmentation", MakeVessel<vtkFlipFreeVesselSegmentation>, 0, "the image on port 0",
    Any },
};
const Port SurfacePorts[] = {
  { "Search", MakeSearch, 0, "the surface on port 0", 96 },
  { "Deform", MakeDeform, 0, "the surface on port 0", 96 },
  { "Refinement", MakeRefinement, 0, "the surface on port 0", 4 * 96 },
  { "Segmentation", MakeSegmentation, 1, "the start surface on port 1", 6 * 8 * 8, true },
  { "StartedSegmentation", MakeStartedSegmentation, 1, "the start surface on port 1", 6 * 8 * 8,
    true },
};
const Port PolygonPorts[] = {
  { "LabelMap", MakeLabelMap, 0, "the surface on port 0", Voxels },
  { "Validity", MakeValidity, 0, "the surface on port 0", 96 },
  { "ValidityReference", MakeValidity, 1, "the reference surface on port 1", 96, true },
};

void ExpectGoodInputAccepted(vtkAlgorithm* filter, const Port& port)
{
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  const vtkIdType points =
    filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT);
  EXPECT_TRUE(port.Points == Any ? points > 0 : points == port.Points) << points;
}

void ExpectMissingOrOtherTypeRefused(const Port& port, vtkDataObject* other)
{
  const vtkSmartPointer<vtkAlgorithm> filter = port.Make();
  filter->SetInputDataObject(port.Index, other);
  ExpectPipelineRefusal(filter, "port");
  if (!port.Optional)
  {
    filter->SetInputDataObject(port.Index, nullptr);
    ExpectPipelineRefusal(filter, "port " + std::to_string(port.Index));
  }
}

} // namespace

TEST_P(ImagePort, RefusesBadImagesAlone)
{
  ExpectGoodInputAccepted(this->Filter, GetParam());
  ExpectRefusedAndRecovered(BadImages(), this->Filter, GetParam().Index, GetParam().Noun);
  ExpectMissingOrOtherTypeRefused(GetParam(), StartSphere());
}

TEST_P(ImagePort, TakesVoxelsWithoutData)
{
  for (const double value : { NotANumber, Infinite, -Infinite })
  {
    const auto image = SphereImage();
    image->SetScalarComponentFromDouble(0, 0, 0, 0, value);
    this->Filter->SetInputDataObject(GetParam().Index, image);
    EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors") << value;
  }
}

TEST(BadInput, SeedsThatTouchVoxelsWithoutDataAreRefused)
{
  const vtkSmartPointer<vtkAlgorithm> filters[] = { MakeSeeded<vtkSeedRegionDiffusion>(),
    MakeSeeded<vtkGMMFeatureFilter>(), MakeSegmentation() };
  for (const auto& filter : filters)
  {
    ExpectRefusedAndRecovered(ImagesWithoutData(), filter.Get(), 0,
      "the seed sphere touches a voxel without data");
  }
}

TEST_P(SurfacePort, RefusesBadSurfacesAlone)
{
  ExpectGoodInputAccepted(this->Filter, GetParam());
  ExpectRefusedAndRecovered(BadSurfaces(), this->Filter, GetParam().Index, GetParam().Noun);
  ExpectMissingOrOtherTypeRefused(GetParam(), SphereImage());
}

TEST_P(PolygonPort, RefusesBadPolygonsAlone)
{
  ExpectGoodInputAccepted(this->Filter, GetParam());
  ExpectRefusedAndRecovered(BadPolygons(), this->Filter, GetParam().Index, GetParam().Noun);
  ExpectMissingOrOtherTypeRefused(GetParam(), SphereImage());
}

// The segmentation may be a label map or a surface, which has to enclose voxels.
TEST(BadInput, SegmentationsToMeasure)
{
  const auto metrics = MakeMetrics();
  std::vector<Bad<vtkImageData>> labelMaps = BadGrids();
  labelMaps.insert(labelMaps.end(),
    {
      { "too few scalars", ImageWithArray<vtkDoubleArray>(100), { "no scalars", "active" } },
      { "several components", ImageOfType(VTK_SHORT, 3), { "of one component", "active" } },
      { "bits", ImageWithArray<vtkBitArray>(32 * 32 * 32), { "are of type bit", "unsigned char" } },
      { "not finite", ImageWith(NotANumber), { "(45, 48, 51) mm", "not a finite number" } },
    });
  ExpectRefusedAndRecovered(labelMaps, metrics, 1, "the reference on port 1");
  metrics->SetReferenceData(SphereLabels());
  const std::string noun = "the segmentation on port 0";
  ExpectRefusedAndRecovered(labelMaps, metrics, 0, noun);
  ExpectRefusedAndRecovered(BadPolygons(), metrics, 0, noun);
  metrics->SetInputDataObject(OpenSphere());
  ExpectRefusal(metrics, { "not closed", "fill holes" });
  const auto elsewhere = StartSphere();
  elsewhere->SetPoints(MakePoints(PointList(-CopyPoints(elsewhere))));
  metrics->SetInputDataObject(elsewhere);
  ExpectRefusal(metrics,
    { "the segmentation, a surface, encloses no voxel center of the reference on port 1",
      "physical coordinates" });
  metrics->SetInputDataObject(vtkSmartPointer<vtkTable>::New());
  ExpectPipelineRefusal(metrics, "input port index 0");
  metrics->SetInputDataObject(nullptr);
  ExpectPipelineRefusal(metrics, "port 0");
}

TEST(BadInput, GridsAndSurfacesOfALabelMap)
{
  const auto labelMap = MakeLabelMap();
  ExpectRefusedAndRecovered(BadGrids(), labelMap, 1, "the reference image on port 1");
  labelMap->SetReferenceImageData(SphereImage());
  labelMap->SetInputData(OpenSphere());
  ExpectRefusal(labelMap, { "not closed", "fill holes" });
  labelMap->SetInputData(StartSphere());
  EXPECT_EQ(ErrorOfUpdate(labelMap), "0 errors");
}

TEST(BadInput, ReferencesOfOtherTopology)
{
  const auto validity = MakeValidity();
  validity->SetReferenceSurfaceData(OpenSphere());
  ExpectRefusal(validity, { "the reference surface on port 1 has other polygons", "connect" });
}

INSTANTIATE_TEST_SUITE_P(BadInput, PolygonPort, testing::ValuesIn(PolygonPorts), NameOf);
INSTANTIATE_TEST_SUITE_P(BadInput, ImagePort, testing::ValuesIn(ImagePorts), NameOf);
INSTANTIATE_TEST_SUITE_P(BadInput, SurfacePort, testing::ValuesIn(SurfacePorts), NameOf);

// The stages move the very vertices that they are given; the others take any closed mesh.
TEST(BadInput, SurfacesThatAreNotFourValent)
{
  for (const vtkSmartPointer<vtkAlgorithm>& stage :
    { vtkSmartPointer<vtkAlgorithm>(MakeSearch()), vtkSmartPointer<vtkAlgorithm>(MakeDeform()) })
  {
    stage->SetInputDataObject(0, TriangulatedBox());
    ExpectRefusal(stage, { "the surface on port 0", "vertex 0", "four neighbors" });
  }
  const auto refinement = MakeRefinement();
  refinement->SetInputDataObject(TriangulatedBox());
  EXPECT_EQ(ErrorOfUpdate(refinement), "0 errors");
  EXPECT_EQ(refinement->GetOutput()->GetNumberOfPoints(), 4 * 18); // of the edges' midpoints
  const auto segmentation = MakeSegmentation();
  segmentation->SetStartData(TriangulatedBox());
  EXPECT_EQ(ErrorOfUpdate(segmentation), "0 errors");
  EXPECT_EQ(segmentation->GetNumberOfSelfIntersections(), 0);
}

// Where the guard relies on it.
TEST(BadInput, SurfacesThatAreNotEmbedded)
{
  const auto deform = MakeDeform();
  const auto refinement = MakeRefinement();
  const auto segmentation = MakeSegmentation();
  const auto expect = [](vtkSmartPointer<vtkPolyData> surface, vtkAlgorithm* filter, int port,
                        const std::vector<std::string>& words)
  {
    surface->GetPointData()->ShallowCopy(SphereWithDisplacements()->GetPointData());
    ExpectRefusedAndRecovered<vtkPolyData>({ { words[1], surface, words } }, filter, port, "");
  };
  const auto crossed = SelfIntersectingSphere();
  expect(crossed, deform, 0, { "the surface on port 0", "intersects itself", "Guard" });
  expect(crossed, refinement, 0, { "the surface on port 0", "intersects itself", "Check" });
  expect(crossed, segmentation, 1,
    { "the start surface on port 1", "intersects itself", "near (", "embedded" });
  const auto turned = SphereInsideOut();
  expect(turned, deform, 0, { "the surface on port 0", "inside out", "vtkReverseSense" });
  expect(turned, refinement, 0, { "the surface on port 0", "inside out" });
  expect(turned, segmentation, 1,
    { "the start surface on port 1", "inside out", "vtkReverseSense" });

  deform->GuardOff();
  deform->SetInputDataObject(crossed);
  EXPECT_EQ(ErrorOfUpdate(deform), "0 errors");
}

// Code that asks for the kind of an error relies on it.
TEST(BadInput, HasTheCodeOfItsKind)
{
  const auto codeOf = [](vtkAlgorithm* filter)
  {
    EXPECT_EQ(ErrorOfUpdate(filter).find(" errors"), std::string::npos);
    return static_cast<ErrorCode>(filter->GetErrorCode() - vtkErrorCode::UserError);
  };
  const auto deform = MakeDeform();
  deform->SetInputDataObject(SelfIntersectingSphere());
  EXPECT_EQ(codeOf(deform), ErrorCode::SelfIntersecting);
  deform->GuardOff();
  EXPECT_EQ(codeOf(deform), ErrorCode::InvalidInput); // it has no displacements
  const auto refinement = MakeRefinement();
  refinement->SetInputDataObject(SelfIntersectingSphere());
  EXPECT_EQ(codeOf(refinement), ErrorCode::SelfIntersecting);
  refinement->SetInputDataObject(SphereInsideOut());
  EXPECT_EQ(codeOf(refinement), ErrorCode::InsideOut);
  refinement->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  EXPECT_EQ(codeOf(refinement), ErrorCode::InvalidMesh);
  const auto segmentation = MakeSegmentation();
  segmentation->SetSeedCenter(-1000, 0, 0);
  EXPECT_EQ(codeOf(segmentation), ErrorCode::OutOfRange);
  segmentation->SetSeedCenter(ExampleCenter.data());
  segmentation->SetInputDataObject(vtkSmartPointer<vtkImageData>::New());
  EXPECT_EQ(codeOf(segmentation), ErrorCode::InvalidGeometry);
}

TEST(BadInput, Seeds)
{
  ExpectBadSeedsRefused(MakeSeeded<vtkSeedRegionDiffusion>().Get());
  ExpectBadSeedsRefused(MakeSeeded<vtkGMMFeatureFilter>().Get());
  const auto segmentation = MakeSegmentation();
  ExpectBadSeedsRefused(segmentation.Get());
  ExpectSeedBetweenSlicesRefused(segmentation.Get());
}

TEST(BadInput, PropertiesThatAreNotNumbers)
{
  const auto diffusion = MakeSeeded<vtkSeedRegionDiffusion>();
  diffusion->SetReach(NotANumber);
  ExpectRefusal(diffusion, { "the value of Reach", "NaN", "set it" });
  const auto feature = MakeSeeded<vtkGMMFeatureFilter>();
  feature->SetForegroundMass(NotANumber);
  ExpectRefusal(feature, { "the value of ForegroundMass", "NaN", "set it" });
  const auto search = MakeSearch();
  search->SetSearchDistance(NotANumber);
  ExpectRefusal(search, { "the value of SearchDistance", "NaN", "set it" });
  const auto deform = MakeDeform();
  deform->SetUniformWeight(NotANumber);
  ExpectRefusal(deform, { "the value of UniformWeight", "NaN", "set it" });
  const auto metrics = MakeMetrics();
  metrics->SetSampleSpacing(NotANumber);
  ExpectRefusal(metrics, { "the value of SampleSpacing", "NaN", "set it" });
  vtkNew<vtkQuadSphereSource> sphere;
  sphere->SetCenter(0, NotANumber, 0);
  ExpectRefusal(sphere, { "Center (", "nan", "finite" });
  sphere->SetCenter(0, 0, 0);
  sphere->SetRadius(NotANumber);
  ExpectRefusal(sphere, { "Radius (nan)", "finite" });
  sphere->SetRadius(1);
  EXPECT_EQ(ErrorOfUpdate(sphere), "0 errors");
}

TEST(BadInput, ImagesWithoutContrast)
{
  const auto feature = MakeSeeded<vtkGMMFeatureFilter>();
  feature->SetInputData(ImageOfType(VTK_SHORT));
  ExpectRefusal(feature, { "no contrast" });
  feature->CarvingOff();
  feature->SetSurfaceData(StartSphere(10)); // of so few voxels that it has no part in the feature
  ExpectRefusal(feature, { "no contrast" });
  const auto segmentation = MakeSegmentation();
  segmentation->SetInputDataObject(ImageOfType(VTK_FLOAT));
  ExpectRefusal(segmentation, { "no contrast", "32768 voxels", "check" });
}

#ifdef FLIPFREE_CAN_LIMIT_MEMORY
TEST(BadInput, SpheresBeyondTheMemory)
{
  vtkNew<vtkQuadSphereSource> source;
  source->SetResolution(1024);
  const MemoryLimit limit(32 << 20);
  ExpectRefusal(source, { "No sphere: ", "lower Resolution (1024)" });
}
#endif

TEST(BadInput, SurfacesOfTheFeature)
{
  const auto filter = MakeSeeded<vtkGMMFeatureFilter>();
  filter->SetSurfaceData(StartSphere(20));
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  const auto elsewhere = StartSphere(20);
  for (vtkIdType point = 0; point < elsewhere->GetNumberOfPoints(); ++point)
  {
    const Eigen::Vector3d place(elsewhere->GetPoint(point));
    elsewhere->GetPoints()->SetPoint(point, -place.x(), -place.y(), place.z()); // RAS for LPS
  }
  ExpectRefusedAndRecovered<vtkPolyData>(
    {
      { "open", OpenSphere(), { "closed", "fill holes" } },
      { "no points", vtkSmartPointer<vtkPolyData>::New(), { "has no points" } },
      { "not finite", SphereWithPointAt(Infinite), { "point 7", "repair" } },
      { "elsewhere", elsewhere,
        { "holds no voxel of the image on port 0", "physical coordinates" } },
    },
    filter, 1, "the surface on port 1");
}

// It is left out, with a warning.
TEST(BadInput, ASurfaceOfFewVoxelsChangesNoFeature)
{
  const auto filter = MakeSeeded<vtkGMMFeatureFilter>();
  filter->CarvingOff();
  filter->Update();
  vtkNew<vtkImageData> expected;
  expected->DeepCopy(filter->GetOutput());
  std::vector<std::string> warnings;
  KeepWarnings(filter, warnings);
  filter->SetSurfaceData(StartSphere(10));
  filter->Update();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("surface on port 1 has no more than 200 voxels"), std::string::npos)
    << warnings[0];
  ASSERT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfTuples(), Voxels);
  for (vtkIdType voxel = 0; voxel < Voxels; ++voxel)
  {
    ASSERT_EQ(filter->GetOutput()->GetPointData()->GetScalars()->GetTuple1(voxel),
      expected->GetPointData()->GetScalars()->GetTuple1(voxel));
  }
}

TEST(BadInput, FieldArrays)
{
  const auto feature = MakeSeeded<vtkGMMFeatureFilter>();
  for (const auto& noise : { std::vector<double>{ NotANumber }, { -1 }, { 1, 2 }, {} })
  {
    const auto image = SphereImage();
    AddFieldArray("NoiseStandardDeviation", noise, image);
    feature->SetInputData(image);
    ExpectRefusal(feature, { "NoiseStandardDeviation of the image on port 0", "remove it" });
  }
  const auto search = MakeSearch();
  const auto expect = [&search](const char* name, const std::vector<double>& values)
  {
    const auto image = SphereImage();
    AddFieldArray("FeatureThreshold", { 0.5 }, image);
    AddFieldArray(name, values, image);
    search->SetFeatureData(image);
    ExpectRefusal(search, { std::string(name) + " of the feature on port 1", "remove it" });
  };
  for (const auto& threshold : { std::vector<double>{ NotANumber }, { 0.2, 0.3 }, { -0.5 } })
  {
    expect("FeatureThreshold", threshold);
  }
  for (const auto& radius : { std::vector<double>{ NotANumber }, { 10, 20 }, { -5 } })
  {
    expect("SeedRadius", radius);
  }
  for (const auto& ramp : { std::vector<double>{ 0, NotANumber, 1 }, { 0, 1 } })
  {
    expect("EdgeRamp", ramp);
  }
}

TEST(BadInput, EdgesOfTheSearch)
{
  const auto filter = MakeSearch();
  const auto moved = SphereImage();
  moved->SetOrigin(1, 0, 0);
  filter->SetEdgeData(moved);
  ExpectRefusal(filter,
    { "origins", "the edge image on port 2", "the feature on port 1", "resample" });
  filter->SetEdgeWindow(0);
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  filter->SetEdgeWindow(3);
  filter->SetEdgeData(nullptr);
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
}

TEST(BadInput, DisplacementsOfTheDeformation)
{
  const auto changed = [](const char* array, int tuple, int component, double value)
  {
    auto sphere = SphereWithDisplacements();
    sphere->GetPointData()->GetArray(array)->SetComponent(tuple, component, value);
    return sphere;
  };
  const auto without = [](const char* array)
  {
    auto sphere = SphereWithDisplacements();
    sphere->GetPointData()->RemoveArray(array);
    return sphere;
  };
  const std::vector<std::string> notFinite{ "Displacement of", "not finite at point 11",
    "set it to zero" };
  ExpectRefusedAndRecovered<vtkPolyData>(
    {
      { "no states", without("Correspondence"), { "Correspondence", "vtkCorrespondenceSearch" } },
      { "no displacements", without("Displacement"),
        { "Displacement", "vtkCorrespondenceSearch" } },
      { "float", SphereWithDisplacements<vtkFloatArray>(),
        { "Displacement", "96 tuples of 3 x float" } },
      { "in a plane", SphereWithDisplacements(2), { "Displacement", "96 tuples of 2 x double" } },
      { "too few", SphereWithDisplacements(3, 1, 95),
        { "Displacement", "95 tuples of 3 x double" } },
      { "states of double", SphereWithDisplacements<vtkDoubleArray, vtkDoubleArray>(),
        { "Correspondence", "96 tuples of 1 x double" } },
      { "pairs of states", SphereWithDisplacements(3, 2),
        { "Correspondence", "2 x unsigned char" } },
      { "NaN", changed("Displacement", 11, 1, NotANumber), notFinite },
      { "infinite", changed("Displacement", 11, 1, Infinite), notFinite },
      { "unknown state", changed("Correspondence", 12, 0, 3),
        { "Correspondence of", "value 3 at point 12", "0 for solitary" } },
    },
    MakeDeform(), 0, "the surface on port 0");
}

TEST(BadInput, DisplacementsTooLongToComputeWith)
{
  const auto filter = MakeDeform();
  const auto sphere = SphereWithDisplacements();
  sphere->GetPointData()->GetArray("Displacement")->Fill(1e300);
  for (const bool guard : { true, false })
  {
    filter->SetGuard(guard);
    ExpectRefusedAndRecovered<vtkPolyData>(
      { { "too long", sphere, { "no finite solution", "limit" } } }, filter, 0, "displacements");
  }
}

TEST(GoodInput, ASurfaceThatNothingMovesRemains)
{
  const auto filter = MakeDeform();
  const auto sphere = SphereWithDisplacements();
  sphere->GetPointData()->GetArray("Displacement")->Fill(0);
  sphere->GetPointData()->GetArray("Correspondence")->Fill(0);
  filter->SetInputData(sphere);
  filter->SetUniformWeight(0);
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_LE((CopyPoints(filter->GetOutput()) - CopyPoints(sphere)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(GoodInput, NoDataFarFromTheSeedAndSeedsOfOneValueAreSegmented)
{
  const auto filter = MakeSegmentation();
  const auto image = ImageWith(0);
  image->SetScalarComponentFromDouble(0, 0, 0, 0, NotANumber);
  filter->SetInputDataObject(image);
  vtkNew<vtkPhantomSource> noiseless;
  noiseless->SetDimensions(32, 32, 32);
  noiseless->SetSpacing(3, 3, 3);
  noiseless->SetNoiseStandardDeviation(0);
  noiseless->Update();
  for (vtkDataObject* good :
    { static_cast<vtkDataObject*>(image), noiseless->GetOutputDataObject(0) })
  {
    filter->SetInputDataObject(good);
    EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
    EXPECT_EQ(filter->GetSurface()->GetNumberOfPoints(), 6 * 8 * 8);
    EXPECT_EQ(filter->GetLabelMap()->GetNumberOfPoints(), Voxels);
    EXPECT_GT(filter->GetConvergence()->GetNumberOfRows(), 0);
    EXPECT_EQ(filter->GetNumberOfSelfIntersections(), 0);
    EXPECT_NE(filter->GetStopReason(), vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND);
  }
}

TEST(BadInput, LeavesNothingOfTheFormerSegmentationAndCanBeMended)
{
  const auto filter = MakeSegmentation();
  for (const bool history : { false, true })
  {
    filter->SetKeepHistory(history);
    filter->SetSeedCenter(ExampleCenter.data());
    EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
    EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    EXPECT_EQ(filter->GetNumberOfSelfIntersections(), 0);
    filter->SetSeedCenter(-1000, 0, 0);
    ExpectRefusal(filter, { "outside the image" });
    EXPECT_EQ(filter->GetErrorCode(),
      vtkErrorCode::UserError + static_cast<unsigned long>(ErrorCode::OutOfRange));
    EXPECT_EQ(filter->GetNumberOfSelfIntersections(), -1);
    EXPECT_EQ(filter->GetStopReason(), vtkFlipFreeSegmentation::NOT_RUN);
  }
}

// Nothing is wrong with it, but nothing is found either: the reason says so.
TEST(GoodInput, AStartThatSeesNoBoundary)
{
  const auto filter = MakeSegmentation();
  filter->SetStartData(StartSphere(2));
  filter->SetSearchDistance(3);
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_EQ(filter->GetStopReason(), vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND);
}
