// Several organs in one filter: blocks, labels and table, points by organ, surfaces at rest, and
// what is refused.
#include "BadInput.h"

#include "vtkCompositeDataSet.h"
#include "vtkConstraintPointSource.h"
#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeOrganGroup.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <array>
#include <sstream>
#include <string>
#include <vector>

using namespace FlipFree;

namespace
{

/// Two balls of one gray value that touch.
vtkSmartPointer<vtkImageData> TwoBalls()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(62, 38, 38);
  image->SetSpacing(2, 2, 2);
  image->AllocateScalars(VTK_SHORT, 1);
  unsigned int state = 1;
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    const Eigen::Vector3d point(image->GetPoint(voxel));
    const bool inside = (point - Eigen::Vector3d(38, 37, 37)).norm() < 22 ||
      (point - Eigen::Vector3d(80, 37, 37)).norm() < 22;
    state = state * 1664525U + 1013904223U;
    image->GetPointData()->GetScalars()->SetTuple1(voxel,
      (inside ? 100 : 0) + static_cast<int>(state >> 28U));
  }
  return image;
}

vtkSmartPointer<vtkFlipFreeOrganGroup> MakeGroup()
{
  auto group = vtkSmartPointer<vtkFlipFreeOrganGroup>::New();
  group->SetInputData(TwoBalls());
  group->GetParameters()->SetResolution(16);
  return group;
}

vtkSmartPointer<vtkFlipFreeOrganGroup> MakePair()
{
  auto group = MakeGroup();
  group->AddOrgan("left", 38, 37, 37, 11);
  group->AddOrgan("right", 80, 37, 37, 10);
  return group;
}

int LabelAt(vtkFlipFreeOrganGroup* group, double x, double y, double z)
{
  double point[3] = { x, y, z };
  vtkImageData* const labels = group->GetLabelMap();
  return static_cast<int>(
    labels->GetPointData()->GetScalars()->GetTuple1(labels->FindPoint(point)));
}

/// Seeds of two organs, with an array that says whose they are.
vtkSmartPointer<vtkPolyData> Seeds(vtkAbstractArray* organs)
{
  auto seeds = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(38, 37, 37);
  points->InsertNextPoint(80, 37, 37);
  points->InsertNextPoint(38, 57, 37);
  seeds->SetPoints(points);
  const double kinds[3] = { 3, 3, 0 };
  const double radii[3] = { 11, 10, 0 };
  for (const auto& [name, values] :
    { std::pair<const char*, const double*>{ "Constraint", kinds }, { "Radius", radii } })
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    for (int row = 0; row < 3; ++row)
    {
      array->InsertNextValue(values[row]);
    }
    seeds->GetPointData()->AddArray(array);
  }
  organs->SetName("Organ");
  seeds->GetPointData()->AddArray(organs);
  return seeds;
}

} // namespace

TEST(OrganGroupFilter, HasABlockALabelAndARowPerOrgan)
{
  const auto group = MakePair();
  group->SetLabelValue(7);
  ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
  vtkMultiBlockDataSet* const surfaces = group->GetOutput();
  ASSERT_EQ(surfaces->GetNumberOfBlocks(), 2u);
  EXPECT_STREQ(surfaces->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "right");
  for (int organ = 0; organ < 2; ++organ)
  {
    vtkPolyData* const surface = group->GetSurface(organ);
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->GetNumberOfPoints(), 6 * 16 * 16);
    EXPECT_TRUE(surface->GetPointData()->GetArray("Confidence"));
    EXPECT_EQ(surface->GetFieldData()->GetArray("Certified")->GetTuple1(0), 1);
    EXPECT_EQ(group->GetNumberOfSelfIntersections(organ), 0);
    EXPECT_GT(group->GetConvergence(organ)->GetNumberOfRows(), 10);
    EXPECT_GT(group->GetConfidence(organ), 0.5);
    EXPECT_NE(group->GetStopReason(organ), vtkFlipFreeSegmentation::NOT_RUN);
  }
  EXPECT_EQ(LabelAt(group, 38, 37, 37), 7);
  EXPECT_EQ(LabelAt(group, 80, 37, 37), 8);
  EXPECT_EQ(LabelAt(group, 2, 2, 2), 0);
  vtkTable* const table = group->GetTable();
  ASSERT_EQ(table->GetNumberOfRows(), 2);
  EXPECT_EQ(table->GetValueByName(1, "Organ").ToString(), "right");
  EXPECT_EQ(table->GetValueByName(1, "Label").ToInt(), 8);
  EXPECT_NEAR(table->GetValueByName(0, "Milliliters").ToDouble(), 44, 3);
  EXPECT_EQ(table->GetValueByName(0, "SelfIntersections").ToInt(), 0);
  // What there is not.
  EXPECT_EQ(group->GetSurface(2), nullptr);
  EXPECT_EQ(group->GetConvergence(-1), nullptr);
  EXPECT_EQ(group->GetConfidence(2), -1);
  EXPECT_EQ(group->GetStopReason(2), vtkFlipFreeSegmentation::NOT_RUN);
}

// By name or by number, as by the functions.
TEST(OrganGroupFilter, TakesPointsFromItsPort)
{
  const auto pair = MakePair();
  pair->AddOutsidePoint("left", 38, 57, 37);
  ASSERT_EQ(ErrorOfUpdate(pair), "0 errors");
  EXPECT_EQ(LabelAt(pair, 38, 57, 37), 0);
  vtkNew<vtkStringArray> names;
  vtkNew<vtkIntArray> numbers;
  for (const int organ : { 0, 1, 0 })
  {
    names->InsertNextValue(organ == 0 ? "left" : "right");
    numbers->InsertNextValue(organ + 1);
  }
  for (vtkAbstractArray* organs :
    { static_cast<vtkAbstractArray*>(names), static_cast<vtkAbstractArray*>(numbers) })
  {
    const auto group = MakeGroup();
    group->SetConstraintData(Seeds(organs));
    ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
    EXPECT_EQ(group->GetTable()->GetValueByName(1, "Organ").ToString(),
      organs == names ? "right" : "organ 2");
    for (int organ = 0; organ < 2; ++organ)
    {
      const Eigen::Vector3d expected(pair->GetSurface(organ)->GetPoint(99));
      EXPECT_EQ(Eigen::Vector3d(group->GetSurface(organ)->GetPoint(99)), expected);
    }
  }
}

TEST(OrganGroupFilter, TakesAnyNumberOfPointSources)
{
  const auto pair = MakePair();
  pair->AddOutsidePoint("left", 38, 57, 37);
  ASSERT_EQ(ErrorOfUpdate(pair), "0 errors");
  const auto source = [](int kind, int organ, const std::array<double, 3>& place, double radius)
  {
    auto made = vtkSmartPointer<vtkConstraintPointSource>::New();
    made->SetKind(kind);
    made->SetOrgan(organ);
    made->SetPosition(place.data());
    made->SetRadius(radius);
    return made;
  };
  const auto outside = source(vtkConstraintPointSource::OUTSIDE, 1, { 38, 57, 37 }, 10);
  const auto left = source(vtkConstraintPointSource::SEED, 1, { 38, 37, 37 }, 11);
  const auto right = source(vtkConstraintPointSource::SEED, 2, { 80, 37, 37 }, 10);
  const std::vector<vtkConstraintPointSource*> orders[2] = { { outside, left, right },
    { right, left, outside } };
  for (const auto& order : orders)
  {
    const auto group = MakeGroup();
    for (vtkConstraintPointSource* point : order)
    {
      group->AddConstraintConnection(point->GetOutputPort());
    }
    ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
    for (int organ = 0; organ < 2; ++organ)
    {
      const Eigen::Vector3d expected(pair->GetSurface(organ)->GetPoint(99));
      EXPECT_EQ(Eigen::Vector3d(group->GetSurface(organ)->GetPoint(99)), expected);
    }
  }
  // Names count before numbers, wherever they are connected.
  vtkNew<vtkStringArray> names;
  for (const char* name : { "a", "b", "a" })
  {
    names->InsertNextValue(name);
  }
  const auto group = MakeGroup();
  right->SetKindToInside();
  right->SetPosition(90, 37, 37);
  right->SetOrgan(4);
  group->AddConstraintConnection(right->GetOutputPort());
  group->AddConstraintData(Seeds(names));
  ExpectRefusal(group,
    { "'Organ' of the point set 1 on port 1 is 4", "at point 0", "without gaps" });
  right->SetOrgan(2);
  ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
  EXPECT_EQ(group->GetTable()->GetNumberOfRows(), 2);
  EXPECT_EQ(group->GetTable()->GetValueByName(1, "Organ").ToString(), "b");
  group->RemoveAllConstraintConnections();
  ExpectRefusal(group, { "there is no organ" });
}

TEST(OrganGroupFilter, KeepsOffSurfacesAtRest)
{
  const auto pair = MakePair();
  ASSERT_EQ(ErrorOfUpdate(pair), "0 errors");
  vtkNew<vtkPolyData> right;
  right->DeepCopy(pair->GetSurface(1));
  const auto group = MakeGroup();
  group->AddOrgan("left", 38, 37, 37, 11);
  group->AddFixedData(right);
  ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
  for (vtkIdType voxel = 0; voxel < pair->GetLabelMap()->GetNumberOfPoints(); ++voxel)
  {
    ASSERT_FALSE(pair->GetLabelMap()->GetPointData()->GetScalars()->GetTuple1(voxel) == 2 &&
      group->GetLabelMap()->GetPointData()->GetScalars()->GetTuple1(voxel) == 1);
  }
  group->RemoveAllFixed();
  EXPECT_EQ(group->GetNumberOfInputConnections(2), 0);
}

TEST(OrganGroupFilter, RunsAgainWhenItsParametersChange)
{
  const auto group = MakePair();
  ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
  group->GetParameters()->SetResolution(8);
  ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
  EXPECT_EQ(group->GetSurface(0)->GetNumberOfPoints(), 6 * 8 * 8);
  vtkNew<vtkFlipFreeSegmentation> other;
  group->SetParameters(other);
  EXPECT_EQ(group->GetParameters(), other.Get());
  group->SetParameters(nullptr);
  EXPECT_NE(group->GetParameters(), nullptr);
  group->RemoveAllOrgans();
  EXPECT_EQ(group->GetNumberOfOrgans(), 0);
}

TEST(OrganGroupFilter, RefusesByName)
{
  ExpectRefusal(MakeGroup(), { "there is no organ" });
  auto group = MakePair();
  group->AddOrgan("right", 80, 37, 60, 3);
  ExpectRefusal(group, { "two organs are named 'right'" });
  group = MakePair();
  group->AddInsidePoint("left", 80, 37, 38);
  ExpectRefusal(group, { "of 'left' lies in the seed of 'right'" });
  group = MakePair();
  group->GetParameters()->SetGuard(false);
  ExpectRefusal(group, { "switch Guard and Carving on" });
  group = MakePair();
  group->GetParameters()->SetSeedRadius(7);
  ExpectRefusal(group,
    { "GetParameters() has a seed sphere, which is not used; give it to AddOrgan()" });
  group = MakePair();
  group->GetParameters()->SetSeedCenter(0, 0, 7);
  ExpectRefusal(group, { "GetParameters() has a seed sphere" });
  group = MakePair();
  group->GetParameters()->SetInputDataObject(group->GetInputDataObject(0, 0));
  ExpectRefusal(group, { "GetParameters() has an input on port 0, which is not used" });
  group = MakePair();
  group->GetParameters()->AddInsidePoint(1, 2, 3);
  ExpectRefusal(group, { "GetParameters() has points, which are not used" });
  group = MakePair();
  group->GetParameters()->GetFeature()->SetSeedCenter(1, 2, 3);
  ExpectRefusal(group, { "GetFeature() of GetParameters() has a seed sphere, which is not used" });
  group = MakePair();
  group->GetParameters()->GetSearch()->SetThreshold(0.4);
  ExpectRefusal(group, { "GetSearch() of GetParameters() has a Threshold, which is not used" });
  group = MakePair();
  group->SetLabelValue(255);
  ExpectRefusal(group, { "labels go up to 255, which leaves none for 'right'" });
  group = MakePair();
  FilterErrors errors(group);
  group->AddSeed("middle", 1, 2, 3, 4);
  EXPECT_NE(errors.Only().find("there is no organ named 'middle'"), std::string::npos);

  vtkNew<vtkIntArray> numbers;
  for (const int organ : { 1, 3, 1 })
  {
    numbers->InsertNextValue(organ);
  }
  group = MakeGroup();
  group->SetConstraintData(Seeds(numbers));
  ExpectRefusal(group, { "'Organ'", "is 3", "at point 1" });
  group = MakeGroup();
  const auto seeds = Seeds(numbers);
  seeds->GetPointData()->RemoveArray("Organ");
  group->SetConstraintData(seeds);
  ExpectRefusal(group, { "has no point array 'Organ'" });
  vtkNew<vtkStringArray> names;
  for (const char* name : { "left", "right", "third" })
  {
    names->InsertNextValue(name);
  }
  group = MakeGroup();
  group->SetConstraintData(Seeds(names));
  ExpectRefusal(group, { "'third' has no seed" });
}

// Arrays of another form than one value per point.
TEST(OrganGroupFilter, RefusesShortAndWideArrays)
{
  const auto shortened = [](vtkAbstractArray* array)
  {
    array->SetNumberOfTuples(2);
    return array;
  };
  vtkNew<vtkStringArray> names;
  names->SetNumberOfValues(3);
  auto group = MakeGroup();
  group->SetConstraintData(Seeds(shortened(names)));
  ExpectRefusal(group, { "'Organ'", "has 2 values for 3 points" });
  vtkNew<vtkStringArray> wide;
  wide->SetNumberOfComponents(2);
  wide->SetNumberOfTuples(3);
  group = MakeGroup();
  group->SetConstraintData(Seeds(wide));
  ExpectRefusal(group, { "'Organ'", "has 2 components" });
  vtkNew<vtkIntArray> numbers;
  numbers->SetNumberOfValues(3);
  group = MakeGroup();
  group->SetConstraintData(Seeds(shortened(numbers)));
  ExpectRefusal(group, { "'Organ'", "has 2 values for 3 points" });
  for (const char* array : { "Constraint", "Radius" })
  {
    vtkNew<vtkIntArray> organs;
    for (const int organ : { 1, 2, 1 })
    {
      organs->InsertNextValue(organ);
    }
    const auto seeds = Seeds(organs);
    shortened(seeds->GetPointData()->GetArray(array));
    group = MakeGroup();
    group->SetConstraintData(seeds);
    ExpectRefusal(group, { array, "has 2 values for 3 points" });
  }
}

TEST(OrganGroupFilter, PrintsSeedsAndPoints)
{
  const auto group = MakePair();
  group->AddOutsidePoint("left", 38, 57, 37);
  std::ostringstream text;
  group->Print(text);
  for (const char* part : { "Organ: left", "a seed at (80, 37, 37) mm, Radius: 10",
         "the outside point (38, 57, 37) mm", "StageSeconds: 0 0 0 0" })
  {
    EXPECT_NE(text.str().find(part), std::string::npos) << part;
  }
}

TEST(OrganGroupFilter, CanBeAborted)
{
  const auto group = MakePair();
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* const filter = static_cast<vtkAlgorithm*>(caller);
      if (filter->GetProgress() > 0.6)
      {
        filter->SetAbortExecute(1);
      }
    });
  group->AddObserver(vtkCommand::ProgressEvent, abort);
  group->Update();
  EXPECT_EQ(group->GetStopReason(0), vtkFlipFreeSegmentation::ABORTED);
  EXPECT_STREQ(group->GetStopReasonAsString(1), "aborted");
  EXPECT_EQ(group->GetNumberOfSelfIntersections(0), -1);
  EXPECT_EQ(group->GetConfidence(0), -1);
  for (int port = 0; port < 3; ++port)
  {
    EXPECT_TRUE(IsEmpty(group->GetOutputDataObject(port))) << port;
  }
}
