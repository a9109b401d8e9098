// Points that correct vtkFlipFreeSegmentation: by its methods, by its port, from a source for each,
// and what is refused.
#include "BadInput.h"

#include "vtkConstraintPointSource.h"
#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkImplicitPolyDataDistance.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace FlipFree;

namespace
{

using Row = std::array<double, 5>; // kind, place, radius

vtkSmartPointer<vtkPolyData> PointsFrom(const std::vector<Row>& rows)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkUnsignedCharArray> kinds;
  kinds->SetName("Constraint");
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("Radius");
  for (const Row& row : rows)
  {
    points->InsertNextPoint(row[1], row[2], row[3]);
    kinds->InsertNextValue(static_cast<unsigned char>(row[0]));
    radii->InsertNextValue(row[4]);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(kinds);
  data->GetPointData()->AddArray(radii);
  return data;
}

vtkSmartPointer<vtkFlipFreeSegmentation> MakeFilter()
{
  auto filter = vtkSmartPointer<vtkFlipFreeSegmentation>::New();
  filter->SetInputData(SphereImage());
  filter->SetSeedCenter(ExampleCenter[0], ExampleCenter[1], ExampleCenter[2]);
  filter->SetSeedRadius(ExampleRadius);
  filter->SetResolution(16);
  return filter;
}

std::vector<double> PlacesOf(vtkFlipFreeSegmentation* filter)
{
  filter->Update();
  vtkPolyData* const surface = filter->GetSurface();
  std::vector<double> places;
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    const double* const place = surface->GetPoint(point);
    places.insert(places.end(), place, place + 3);
  }
  return places;
}

// By VTK's own test, which needs triangles; negative inside.
double SignedDistanceOf(vtkFlipFreeSegmentation* filter, double x, double y, double z)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(filter->GetSurface());
  triangles->Update();
  vtkNew<vtkImplicitPolyDataDistance> distance;
  distance->SetInput(triangles->GetOutput());
  return distance->EvaluateFunction(x, y, z);
}

vtkSmartPointer<vtkConstraintPointSource> SourceOf(int kind, double x, double y, double z,
  double radius = 10)
{
  auto source = vtkSmartPointer<vtkConstraintPointSource>::New();
  source->SetKind(kind);
  source->SetPosition(x, y, z);
  source->SetRadius(radius);
  return source;
}

} // namespace

TEST(Corrections, AreTheSameByMethodsAndByThePort)
{
  const auto filter = MakeFilter();
  const std::vector<double> free = PlacesOf(filter);
  filter->AddInsidePoint(82, 46.5, 46.5);
  filter->AddOutsidePoint(46.5, 71.5, 46.5);
  filter->AddBoundaryPoint(46.5, 46.5, 79.5);
  filter->AddSeed(13.5, 46.5, 46.5, 5);
  EXPECT_EQ(filter->GetNumberOfCorrections(), 4);
  const std::vector<double> corrected = PlacesOf(filter);
  EXPECT_NE(corrected, free);
  EXPECT_EQ(filter->GetNumberOfSelfIntersections(), 0);
  EXPECT_LT(SignedDistanceOf(filter, 82, 46.5, 46.5), 0);
  EXPECT_LT(SignedDistanceOf(filter, 13.5, 46.5, 46.5), 0);
  EXPECT_GT(SignedDistanceOf(filter, 46.5, 71.5, 46.5), 0);
  EXPECT_LE(std::abs(SignedDistanceOf(filter, 46.5, 46.5, 79.5)), 1.5);

  const auto other = MakeFilter();
  other->SetConstraintData(PointsFrom({ { 3, 13.5, 46.5, 46.5, 5 }, { 2, 46.5, 46.5, 79.5, 0 },
    { 0, 46.5, 71.5, 46.5, 0 }, { 1, 82, 46.5, 46.5, 0 } }));
  EXPECT_EQ(PlacesOf(other), corrected);
  other->SetConstraintData(nullptr);
  EXPECT_EQ(PlacesOf(other), free);
  filter->RemoveAllCorrections();
  EXPECT_EQ(PlacesOf(filter), free);
}

TEST(Corrections, LeaveNoTraceWhateverIsKept)
{
  const auto filter = MakeFilter();
  filter->KeepForCorrectionsOn();
  const std::vector<double> free = PlacesOf(filter);
  filter->AddOutsidePoint(46.5, 71.5, 46.5);
  const std::vector<double> one = PlacesOf(filter);
  filter->AddInsidePoint(82, 46.5, 46.5);
  EXPECT_NE(PlacesOf(filter), one);
  filter->RemoveLastCorrection();
  EXPECT_EQ(PlacesOf(filter), one);
  filter->RemoveLastCorrection();
  filter->RemoveLastCorrection();
  EXPECT_EQ(PlacesOf(filter), free);
  // What is kept is of one image.
  const auto image = ImageOfType(VTK_SHORT);
  filter->SetInputData(image);
  EXPECT_NE(ErrorOfUpdate(filter).find("No segmentation"), std::string::npos);
  filter->SetInputData(SphereImage());
  EXPECT_EQ(PlacesOf(filter), free);
  filter->SetSeedRadius(ExampleRadius - 1);
  EXPECT_NE(PlacesOf(filter), free);
}

TEST(Corrections, ComeFromASourceEachInAnyOrder)
{
  const auto filter = MakeFilter();
  const std::vector<double> free = PlacesOf(filter);
  filter->AddInsidePoint(82, 46.5, 46.5);
  filter->AddOutsidePoint(46.5, 71.5, 46.5);
  filter->AddSeed(13.5, 46.5, 46.5, 5);
  const std::vector<double> corrected = PlacesOf(filter);
  filter->RemoveAllCorrections();

  const auto inside = SourceOf(vtkConstraintPointSource::INSIDE, 82, 46.5, 46.5);
  const auto outside = SourceOf(vtkConstraintPointSource::OUTSIDE, 46.5, 71.5, 46.5);
  const auto seed = SourceOf(vtkConstraintPointSource::SEED, 13.5, 46.5, 46.5, 5);
  for (const bool history : { false, true })
  {
    filter->SetKeepHistory(history);
    filter->SetConstraintConnection(inside->GetOutputPort());
    filter->AddConstraintConnection(seed->GetOutputPort());
    filter->AddConstraintConnection(outside->GetOutputPort());
    EXPECT_EQ(filter->GetNumberOfInputConnections(2), 3);
    EXPECT_EQ(PlacesOf(filter), corrected);
    filter->SetConstraintData(PointsFrom({ { 1, 82, 46.5, 46.5, 0 } }));
    filter->AddConstraintData(PointsFrom({ { 0, 46.5, 71.5, 46.5, 0 } }));
    filter->AddConstraintConnection(seed->GetOutputPort());
    EXPECT_EQ(PlacesOf(filter), corrected);
    // Any of them can be moved.
    seed->SetPosition(20, 46.5, 46.5);
    const std::vector<double> moved = PlacesOf(filter);
    EXPECT_NE(moved, corrected);
    seed->SetPosition(13.5, 46.5, 46.5);
    EXPECT_EQ(PlacesOf(filter), corrected);
    // Off, they are as if they were not connected.
    seed->EnabledOff();
    filter->SetConstraintConnection(seed->GetOutputPort());
    EXPECT_EQ(PlacesOf(filter), free);
    seed->EnabledOn();
    EXPECT_NE(PlacesOf(filter), free);
    filter->RemoveAllConstraintConnections();
    EXPECT_EQ(PlacesOf(filter), free);
  }
}

// By gray values that are no longer those of the image, of which the filter is not told.
TEST(Corrections, CanBeConnectedWithoutLosingWhatIsKept)
{
  const auto outside = SourceOf(vtkConstraintPointSource::OUTSIDE, 46.5, 71.5, 46.5);
  const auto expected = MakeFilter();
  expected->AddConstraintConnection(outside->GetOutputPort());
  const std::vector<double> corrected = PlacesOf(expected);
  for (const bool keeps : { true, false })
  {
    const auto image = SphereImage();
    const auto filter = MakeFilter();
    filter->SetInputData(image);
    filter->SetKeepForCorrections(keeps);
    const std::vector<double> free = PlacesOf(filter);
    ASSERT_EQ(image->GetScalarType(), VTK_SHORT);
    auto* const voxels = static_cast<short*>(image->GetScalarPointer());
    std::fill_n(voxels, image->GetNumberOfPoints(), short{ 1 });
    filter->AddConstraintConnection(outside->GetOutputPort());
    if (!keeps)
    {
      EXPECT_NE(ErrorOfUpdate(filter).find("no contrast"), std::string::npos);
      continue;
    }
    EXPECT_EQ(PlacesOf(filter), corrected);
    filter->RemoveAllConstraintConnections();
    EXPECT_EQ(PlacesOf(filter), free);
    // A parameter is none of what may change.
    filter->SetResolution(8);
    EXPECT_NE(ErrorOfUpdate(filter).find("no contrast"), std::string::npos);
  }
}

TEST(Corrections, OfASourceAreSinglePoints)
{
  vtkNew<vtkConstraintPointSource> source;
  const auto value = [&source](const char* array)
  { return source->GetOutput()->GetPointData()->GetArray(array)->GetTuple1(0); };
  source->SetPosition(1, -2, 3.25);
  source->SetOrgan(4);
  for (int kind = 0; kind < 4; ++kind)
  {
    source->SetKind(kind);
    source->Update();
    ASSERT_EQ(source->GetOutput()->GetNumberOfPoints(), 1);
    EXPECT_EQ(source->GetOutput()->GetNumberOfVerts(), 1);
    EXPECT_EQ(Eigen::Vector3d(source->GetOutput()->GetPoint(0)), Eigen::Vector3d(1, -2, 3.25));
    EXPECT_EQ(value("Constraint"), kind);
    EXPECT_EQ(value("Radius"), kind == 3 ? 10 : 0);
    EXPECT_EQ(value("Organ"), 4);
  }
  source->SetKindToOutside();
  EXPECT_EQ(source->GetKind(), 0);
  source->SetKindToInside();
  EXPECT_EQ(source->GetKind(), 1);
  source->SetKindToBoundary();
  EXPECT_EQ(source->GetKind(), 2);
  source->SetKindToSeed();
  source->SetRadius(NotANumber);
  ExpectRefusal(source, { "No point: Radius (nan) of a seed", "finite" });
  source->SetKindToInside(); // which has no radius
  EXPECT_EQ(ErrorOfUpdate(source), "0 errors");
  source->SetPosition(0, Infinite, 0);
  ExpectRefusal(source, { "No point: Position (", "inf", "finite" });
  source->SetKind(9);
  source->SetOrgan(0);
  EXPECT_EQ(source->GetKind(), 3);
  EXPECT_EQ(source->GetOrgan(), 1);
}

TEST(Corrections, OfTheWrongKindAreRefused)
{
  const auto expect = [](vtkPolyData* points, const std::string& words)
  {
    const auto filter = MakeFilter();
    filter->SetConstraintData(points);
    const std::string error = ErrorOfUpdate(filter);
    EXPECT_NE(error.find(words), std::string::npos) << error;
    EXPECT_EQ(filter->GetSurface()->GetNumberOfPoints(), 0);
  };
  const auto without = [](const char* array)
  {
    auto points = PointsFrom({ { 3, 46.5, 46.5, 46.5, 5 } });
    points->GetPointData()->RemoveArray(array);
    return points;
  };
  expect(without("Constraint"),
    "the point set on port 2 has no point array 'Constraint'; add it: 0 for a point outside");
  expect(without("Radius"), "has no point array 'Radius'; add it: the radii of the seeds");
  expect(PointsFrom({ { 4, 46.5, 46.5, 46.5, 0 } }),
    "at point 0; it can be 0 (outside), 1 (inside)");
  expect(PointsFrom({ { 3, 46.5, 46.5, 46.5, 0 } }),
    "has a radius of 0 mm, where at least a voxel of the image on port 0 (3 mm) is needed");
  expect(PointsFrom({ { 1, 500, 46.5, 46.5, 0 } }),
    "the inside point (500, 46.5, 46.5) mm lies outside the image on port 0, which spans ");
  expect(PointsFrom({ { 0, 46.5, 46.5, 46.5, 0 } }), "lies in the inner half of the seed sphere");
  expect(PointsFrom({ { 0, 80, 46.5, 46.5, 0 }, { 2, 80, 46.5, 46.5, 0 } }),
    "are in the same place");
  auto pairs = PointsFrom({ { 1, 46.5, 46.5, 46.5, 0 } });
  vtkNew<vtkDoubleArray> two;
  two->SetName("Constraint");
  two->SetNumberOfComponents(2);
  two->SetNumberOfTuples(1);
  two->Fill(1);
  pairs->GetPointData()->AddArray(two);
  expect(pairs, "has 2 components; it needs one");

  const auto filter = MakeFilter();
  const auto inside = SourceOf(vtkConstraintPointSource::INSIDE, 82, 46.5, 46.5);
  filter->SetConstraintConnection(inside->GetOutputPort());
  filter->AddConstraintData(without("Radius"));
  EXPECT_NE(ErrorOfUpdate(filter).find("the point set 2 on port 2 has no point array 'Radius'"),
    std::string::npos);
  filter->RemoveAllConstraintConnections();
  filter->GetDeform()->GuardOff();
  filter->AddInsidePoint(50, 46.5, 46.5);
  EXPECT_NE(ErrorOfUpdate(filter).find("can only be obeyed under the guard"), std::string::npos);
}
