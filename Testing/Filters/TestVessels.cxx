// The filters for vessels: outputs and their arrays, the path alone, points, aborts, warnings, and
// the errors that only they have. Bad images are in the matrix of TestBadInput.
#include "BadInput.h"
#include "DataValues.h"
#include "ProgressWatch.h"
#include "VesselPhantom.h"

#include "vtkConstraintPointSource.h"
#include "vtkFlipFreeRefinement.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"
#include "vtkQuadTubeSource.h"
#include "vtkSegmentationMetrics.h"
#include "vtkSurfaceValidity.h"
#include "vtkVesselPath.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImplicitPolyDataDistance.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <array>
#include <cmath>

using namespace FlipFree;

namespace
{

class Vessels : public testing::Test
{
protected:
  void SetUp() override
  {
    MakeVesselPhantom(this->Phantom);
    this->Filter->SetInputConnection(this->Phantom->GetOutputPort());
    this->Path->SetInputConnection(this->Phantom->GetOutputPort());
    for (const double place : { -0.9, 0.9 })
    {
      this->AddPoint(this->Filter, place);
      this->AddPoint(this->Path, place);
    }
  }

  void AddPoint(vtkVesselAlgorithm* filter, double place)
  {
    const std::array<double, 3> point = PointOfVessel(this->Phantom, place);
    filter->AddPoint(point[0], point[1], point[2]);
  }

  vtkNew<vtkPhantomSource> Phantom;
  vtkNew<vtkFlipFreeVesselSegmentation> Filter;
  vtkNew<vtkVesselPath> Path;
};

} // namespace

TEST_F(Vessels, AreFoundBetweenTheirPoints)
{
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetNumberOfSelfIntersections(), 0);
  EXPECT_GT(this->Filter->GetConvergence()->GetNumberOfRows(), 3);
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(this->Filter->GetSurface());
  validity->Update();
  EXPECT_EQ(validity->GetMeasures()->GetValueByName(0, "EulerNumber").ToInt(), 2);
  EXPECT_EQ(validity->GetMeasures()->GetValueByName(0, "SelfIntersections").ToInt(), 0);
  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputDataObject(this->Filter->GetLabelMap());
  metrics->SetReferenceData(vtkImageData::SafeDownCast(this->Phantom->GetOutputDataObject(1)));
  metrics->Update();
  // The phantom goes on by a twentieth beyond either point.
  EXPECT_GT(metrics->GetOutput()->GetValueByName(0, "Dice").ToDouble(), 0.88);

  vtkPolyData* line = this->Filter->GetCenterline();
  ASSERT_EQ(line->GetNumberOfLines(), 1);
  const vtkIdType last = line->GetNumberOfPoints() - 1;
  vtkDataArray* radii = line->GetPointData()->GetArray("Radius");
  vtkDataArray* lengths = line->GetPointData()->GetArray("ArcLength");
  EXPECT_EQ(line->GetCellData()->GetArray("Parent")->GetTuple1(0), -1);
  EXPECT_NEAR(radii->GetTuple1(last / 2), 4, 0.5);
  EXPECT_EQ(lengths->GetTuple1(0), 0);
  EXPECT_NEAR(lengths->GetTuple1(last), 92, 8); // of 105 mm
}

TEST_F(Vessels, ThePathAloneIsTheSegmentationsCenterline)
{
  EXPECT_EQ(ErrorOfUpdate(this->Path), "0 errors");
  this->Filter->SetMaximumIterations(0);
  this->Filter->Update();
  EXPECT_EQ(PointsOf(this->Path->GetOutput()), PointsOf(this->Filter->GetCenterline()));
  this->Path->SetWallThickness(1.3);
  const double before = this->Path->GetOutput()->GetPointData()->GetArray("Radius")->GetTuple1(5);
  this->Path->Update();
  const double after = this->Path->GetOutput()->GetPointData()->GetArray("Radius")->GetTuple1(5);
  EXPECT_NEAR(after - before, 1, 0.1);
}

TEST_F(Vessels, AnAbortEndsSoonAndLeavesNothing)
{
  for (const double progress : { 0.1, 0.3, 0.7 })
  {
    SCOPED_TRACE(progress);
    this->Filter->Modified();
    const ProgressWatch watch(this->Filter, progress);
    this->Filter->Update();
    ASSERT_TRUE(watch.StoppedSoon());
    EXPECT_EQ(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::ABORTED);
    for (int port = 0; port < 3; ++port)
    {
      EXPECT_TRUE(IsEmpty(this->Filter->GetOutputDataObject(port))) << port;
    }
  }
  const ProgressWatch watch(this->Path, 0.2);
  this->Path->Update();
  ASSERT_TRUE(watch.Aborted());
  EXPECT_TRUE(IsEmpty(this->Path->GetOutput()));
}

// The tube along the path is a start for the segmentation of organs.
TEST_F(Vessels, ATubeAlongThePathIsAStart)
{
  vtkNew<vtkQuadTubeSource> tube;
  tube->SetInputConnection(this->Path->GetOutputPort());
  EXPECT_EQ(ErrorOfUpdate(tube), "0 errors");
  EXPECT_GT(tube->GetOutput()->GetNumberOfPoints(), 16 * 20);
  vtkNew<vtkFlipFreeRefinement> refinement;
  refinement->SetInputConnection(tube->GetOutputPort());
  EXPECT_EQ(ErrorOfUpdate(refinement), "0 errors");
  tube->SetLineIndex(1);
  ExpectRefusal(tube, { "LineIndex is 1" });
  tube->SetInputData(StartSphere());
  ExpectRefusal(tube, { "the lines on port 0 are 0" });
  tube->SetLineIndex(0);
  vtkNew<vtkPolyData> bare;
  bare->CopyStructure(this->Path->GetOutput());
  tube->SetInputData(bare);
  ExpectRefusal(tube, { "no point array 'Radius'" });
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("Radius");
  radii->SetNumberOfTuples(bare->GetNumberOfPoints());
  radii->Fill(NotANumber);
  bare->GetPointData()->AddArray(radii);
  tube->Modified();
  ExpectRefusal(tube, { "radii positive" });
  radii->Fill(1);
  vtkNew<vtkPoints> points;
  points->DeepCopy(bare->GetPoints());
  points->SetPoint(1, points->GetPoint(0));
  bare->SetPoints(points);
  tube->Modified();
  ExpectRefusal(tube, { "two points at (", "in a row; remove one of them, by vtkCleanPolyData" });
}

TEST_F(Vessels, PointsAreKeptAndForgotten)
{
  EXPECT_EQ(this->Path->GetNumberOfPoints(), 2);
  const vtkMTimeType before = this->Path->GetMTime();
  this->Path->RemoveAllPoints();
  EXPECT_GT(this->Path->GetMTime(), before);
  this->Path->AddPoint(1, 2, 3);
  double point[3];
  this->Path->GetPoint(0, point);
  EXPECT_EQ(point[2], 3);
  this->Path->GetPoint(7, point);
  EXPECT_EQ(point[2], 0);
}

// From the filter, and from a data set on port 1.
TEST_F(Vessels, PointsCorrectThem)
{
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_GT(this->Filter->GetSupport(), 0.9);
  const auto labelAt = [this](const std::array<double, 3>& point)
  {
    vtkImageData* const labels = this->Filter->GetLabelMap();
    const vtkIdType voxel = labels->FindPoint(point[0], point[1], point[2]);
    return labels->GetPointData()->GetScalars()->GetTuple1(voxel);
  };
  std::array<double, 3> beside = PointOfVessel(this->Phantom, 0.0);
  beside[2] += 6.5;
  std::array<double, 3> within = PointOfVessel(this->Phantom, 0.5);
  within[2] += 2;
  std::array<double, 3> onBoundary = PointOfVessel(this->Phantom, -0.5);
  onBoundary[2] += 6.25;
  // Negative inside.
  const auto distanceAt = [this](std::array<double, 3> point)
  {
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputData(this->Filter->GetSurface());
    triangles->Update();
    vtkNew<vtkImplicitPolyDataDistance> distance;
    distance->SetInput(triangles->GetOutput());
    return distance->EvaluateFunction(point.data());
  };
  EXPECT_EQ(labelAt(beside), 0);
  EXPECT_EQ(labelAt(within), 1);
  EXPECT_GT(distanceAt(beside), 0);
  EXPECT_LT(distanceAt(within), 0);
  EXPECT_GT(std::abs(distanceAt(onBoundary)), 1);
  this->Filter->AddInsidePoint(beside[0], beside[1], beside[2]);
  this->Filter->AddBoundaryPoint(onBoundary[0], onBoundary[1], onBoundary[2]);
  vtkNew<vtkPolyData> more;
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  places->InsertNextPoint(within.data());
  more->SetPoints(places);
  vtkNew<vtkUnsignedCharArray> kinds;
  kinds->SetName("Constraint");
  kinds->InsertNextValue(0);
  more->GetPointData()->AddArray(kinds);
  this->Filter->SetConstraintData(more);
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_LT(distanceAt(beside), 0);
  EXPECT_GT(distanceAt(within), 0);
  EXPECT_LE(std::abs(distanceAt(onBoundary)), 0.75); // half a voxel
  EXPECT_EQ(labelAt(beside), 1);
  EXPECT_EQ(this->Filter->GetNumberOfSelfIntersections(), 0);
  EXPECT_EQ(this->Filter->GetNumberOfCorrections(), 2);
  // The same, from a source for each.
  const std::vector<double> corrected = PointsOf(this->Filter->GetSurface());
  this->Filter->RemoveAllCorrections();
  this->Filter->RemoveAllConstraintConnections();
  vtkNew<vtkConstraintPointSource> inside;
  inside->SetKindToInside();
  inside->SetPosition(beside.data());
  vtkNew<vtkConstraintPointSource> outside;
  outside->SetPosition(within.data());
  this->Filter->AddConstraintConnection(outside->GetOutputPort());
  this->Filter->AddConstraintConnection(inside->GetOutputPort());
  vtkNew<vtkConstraintPointSource> boundary;
  boundary->SetKindToBoundary();
  boundary->SetPosition(onBoundary.data());
  this->Filter->AddConstraintConnection(boundary->GetOutputPort());
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(PointsOf(this->Filter->GetSurface()), corrected);
  this->Filter->SetConstraintData(nullptr);
  ASSERT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(labelAt(beside), 0);
  // What cannot be obeyed.
  kinds->SetValue(0, 3);
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("Radius");
  radii->InsertNextValue(5);
  more->GetPointData()->AddArray(radii);
  this->Filter->SetConstraintData(more);
  ExpectRefusal(this->Filter, { "the further seed", "of no use to a vessel" });
  this->Filter->SetConstraintData(nullptr);
  this->Filter->AddBoundaryPoint(500, 0, 0);
  ExpectRefusal(this->Filter, { "the boundary point (500, 0, 0) mm lies outside" });
}

TEST_F(Vessels, BadPointsAreRefused)
{
  const auto refuse = [this](const std::vector<std::string>& words)
  {
    ExpectRefusal(this->Filter, words);
    EXPECT_EQ(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::NOT_RUN);
  };
  this->Filter->AddPoint(500, 0, 0);
  refuse({ "(500, 0, 0) mm lies outside the image on port 0" });
  this->Filter->RemoveAllPoints();
  refuse({ "at least two points, not 0" });
  this->AddPoint(this->Filter, 0);
  refuse({ "at least two points, not 1" });
  this->AddPoint(this->Filter, 0.01);
  refuse({ "closer than 3 mm", "keep one" });
  this->Filter->RemoveAllPoints();
  this->AddPoint(this->Filter, -0.9);
  this->Filter->AddPoint(40, 90, 90);
  refuse({ " mm; put all points into the ", "vessel" });
  this->Filter->RemoveAllPoints();
  this->AddPoint(this->Filter, 0);
  this->Filter->AddPoint(NotANumber, 0, 0);
  refuse({ "nan", "finite numbers" });
  this->Filter->SetRadius(NotANumber);
  refuse({ "the value of Radius", "NaN" });
}

// Where the vessel does, in a bend, the path goes on just outside, and says so.
TEST_F(Vessels, ThatLeaveTheImageAreFoundWithAWarning)
{
  int extent[6];
  this->Phantom->GetOutput()->GetExtent(extent);
  extent[3] = 41; // 62 mm; the vessel's bend reaches 67
  vtkNew<vtkImageData> cropped;
  cropped->DeepCopy(this->Phantom->GetOutput());
  cropped->Crop(extent);
  this->Filter->SetInputData(cropped);
  std::vector<std::string> warnings;
  KeepWarnings(this->Filter, warnings);
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_GT(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings.front().find("the path leaves what looks like the vessel"), std::string::npos)
    << warnings.front();
  EXPECT_NE(warnings.back().find("The path leaves the image near"), std::string::npos)
    << warnings.back();
  EXPECT_NE(warnings.back().find("add a point along the vessel"), std::string::npos);
}
