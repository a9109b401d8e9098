// Requests to the segmentation beside the surface: its history as time steps, aborts, the same bits
// for any number of threads, and warnings.
#include "DataValues.h"
#include "FilterErrors.h"
#include "PhantomCases.h"
#include "ProgressWatch.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPhantomSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTriangleFilter.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{

using FlipFree::KeepWarnings;
using FlipFree::PointsOf;
using FlipFree::ProgressWatch;
using Pipeline = vtkStreamingDemandDrivenPipeline;

class SegmentationRequests : public testing::Test
{
protected:
  void SetUp() override
  {
    FlipFree::StartInside(this->Filter, FlipFree::CoarseAbdomen(), vtkPhantomSource::SPLEEN);
    this->Filter->SetResolution(16);
    this->Filter->SetLevels(2);
  }

  vtkNew<vtkFlipFreeSegmentation> Filter;
};

/// Updates a filter and gives the words of its warnings.
std::vector<std::string> WarningsOf(vtkAlgorithm* filter)
{
  std::vector<std::string> warnings;
  KeepWarnings(filter, warnings);
  filter->Update();
  filter->RemoveAllObservers();
  return warnings;
}

void ExpectOneWarning(vtkAlgorithm* filter, const char* words)
{
  const std::vector<std::string> warnings = WarningsOf(filter);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(words), std::string::npos) << warnings[0];
}

bool WarnsOfAir(const std::vector<std::string>& warnings)
{
  return std::any_of(warnings.begin(), warnings.end(),
    [](const std::string& warning) { return warning.find("in air") != std::string::npos; });
}

/// Intensity and noise.
struct Tissue
{
  double Mean;
  double StandardDeviation;
};

/// A cylinder of 30 mm radius along the third axis, in voxels of 2 mm x 2 mm.
vtkSmartPointer<vtkImageData> CylinderImage(int width, double center, int slices, double thickness,
  const Tissue& inside = { 100, 8 }, const Tissue& outside = { 0, 8 })
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, width, slices);
  image->SetSpacing(2, 2, thickness);
  image->AllocateScalars(VTK_SHORT, 1);
  auto* voxels = static_cast<short*>(image->GetScalarPointer());
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    double point[3];
    image->GetPoint(voxel, point);
    const double distance = std::hypot(point[0] - center, point[1] - center);
    const Tissue& here = distance < 30 ? inside : outside;
    voxels[voxel] = static_cast<short>(here.Mean + here.StandardDeviation * normal(random));
  }
  return image;
}

} // namespace

TEST_F(SegmentationRequests, HistoryIsATimeStepPerIteration)
{
  this->Filter->Update();
  EXPECT_FALSE(this->Filter->GetOutputInformation(0)->Has(Pipeline::TIME_STEPS()));
  const std::vector<double> result = PointsOf(this->Filter->GetSurface());

  this->Filter->KeepHistoryOn();
  this->Filter->Update();
  EXPECT_EQ(PointsOf(this->Filter->GetSurface()), result);
  vtkNew<vtkTable> convergence;
  convergence->DeepCopy(this->Filter->GetConvergence());
  double seconds[4];
  this->Filter->GetStageSeconds(seconds);
  vtkInformation* info = this->Filter->GetOutputInformation(0);
  const int size = info->Length(Pipeline::TIME_STEPS());
  ASSERT_GT(size, 2);
  ASSERT_EQ(size, convergence->GetNumberOfRows());
  std::vector<double> before;
  for (int step = 0; step < size; ++step)
  {
    SCOPED_TRACE(step);
    const double time = info->Get(Pipeline::TIME_STEPS(), step);
    EXPECT_EQ(time, convergence->GetValueByName(step, "Iteration").ToDouble());
    this->Filter->UpdateTimeStep(time);
    vtkPolyData* surface = this->Filter->GetSurface();
    EXPECT_EQ(surface->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), time);
    EXPECT_EQ(surface->GetNumberOfPoints(), convergence->GetValueByName(step, "Vertices").ToInt());
    EXPECT_NE(PointsOf(surface), before);
    before = PointsOf(surface);
  }
  EXPECT_EQ(before, result);
  for (int stage = 0; stage < 4; ++stage)
  {
    EXPECT_EQ(this->Filter->GetStageSeconds()[stage], seconds[stage]); // so nothing ran again
  }

  this->Filter->KeepHistoryOff();
  this->Filter->Update();
  EXPECT_FALSE(info->Has(Pipeline::TIME_STEPS()));
}

// Downstream filters learn of times before anything has run.
TEST_F(SegmentationRequests, HistoryReachesThroughOtherFilters)
{
  this->Filter->KeepHistoryOn();
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(this->Filter->GetOutputPort());
  triangles->UpdateTimeStep(1);
  const std::vector<double> first = PointsOf(triangles->GetOutput());
  EXPECT_EQ(first.size(), 3u * 6 * 8 * 8);
  triangles->UpdateTimeStep(3);
  const std::vector<double> third = PointsOf(triangles->GetOutput());
  EXPECT_EQ(third.size(), first.size());
  EXPECT_NE(third, first);
  triangles->UpdateTimeStep(1);
  EXPECT_EQ(PointsOf(triangles->GetOutput()), first);
  // Colors by correspondence in every frame.
  EXPECT_TRUE(triangles->GetOutput()->GetPointData()->HasArray("Correspondence"));
}

TEST_F(SegmentationRequests, AnAbortEndsSoonAndLeavesNothing)
{
  this->Filter->Update();
  const std::vector<double> result = PointsOf(this->Filter->GetSurface());
  for (const double progress : { 0.05, 0.3, 0.55 }) // of two levels, both
  {
    SCOPED_TRACE(progress);
    this->Filter->Modified();
    const ProgressWatch watch(this->Filter, progress);
    this->Filter->Update();
    ASSERT_TRUE(watch.StoppedSoon());
    EXPECT_EQ(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::ABORTED);
    EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
    EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints(), 0);
    EXPECT_EQ(this->Filter->GetNumberOfSelfIntersections(), -1);
  }
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_NE(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::ABORTED);
  EXPECT_EQ(PointsOf(this->Filter->GetSurface()), result);

  // A history that was aborted is made anew.
  this->Filter->KeepHistoryOn();
  {
    const ProgressWatch watch(this->Filter, 0.5);
    this->Filter->Update();
    ASSERT_TRUE(watch.Aborted());
  }
  this->Filter->UpdateTimeStep(2);
  EXPECT_NE(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::ABORTED);
  EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints(), 6 * 8 * 8);
}

// VTK's backends cut the work differently: in one piece, in a few per thread, in one per slice.
TEST_F(SegmentationRequests, ThreadsDoNotChangeABit)
{
  const std::string usual = vtkSMPTools::GetBackend();
  std::vector<double> surface;
  std::vector<double> labels;
  int compared = 0;
  for (const char* backend : { "Sequential", "STDThread", "TBB", "OpenMP" })
  {
    for (int threads = 1; threads <= 2; ++threads)
    {
      if (!vtkSMPTools::SetBackend(backend))
      {
        continue;
      }
      SCOPED_TRACE(std::string(backend) + " with " + std::to_string(threads));
      vtkSMPTools::Initialize(threads);
      this->Filter->Modified();
      this->Filter->Update();
      if (surface.empty())
      {
        surface = PointsOf(this->Filter->GetSurface());
        labels = FlipFree::ValuesOf(this->Filter->GetLabelMap());
        continue;
      }
      EXPECT_EQ(PointsOf(this->Filter->GetSurface()), surface);
      EXPECT_EQ(FlipFree::ValuesOf(this->Filter->GetLabelMap()), labels);
      ++compared;
    }
  }
  vtkSMPTools::SetBackend(usual.c_str());
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(surface.size(), 3u * 6 * 16 * 16);
  EXPECT_GT(compared, 0);
}

TEST_F(SegmentationRequests, LevelsAreLeftOutThatWouldBeginTooCoarse)
{
  this->Filter->SetResolution(10);
  this->Filter->SetLevels(6);
  this->Filter->SetMaximumIterations(1);
  this->Filter->Update();
  EXPECT_EQ(this->Filter->GetConvergence()->GetValueByName(0, "Vertices").ToInt(), 6 * 2 * 2);
  EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints(), 6 * 8 * 8);
}

TEST_F(SegmentationRequests, ASeedOrSurfaceThatReachesTooFarWarns)
{
  EXPECT_EQ(WarningsOf(this->Filter).size(), 0u);
  this->Filter->SetReach(25);
  ExpectOneWarning(this->Filter, "raise Reach");
  this->Filter->SetReach(0);
  this->Filter->SetSeedRadius(160);
  this->Filter->SetMaximumIterations(0);
  const std::vector<std::string> warnings = WarningsOf(this->Filter);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("reaches beyond the image"), std::string::npos) << warnings[0];
}

// Seeds beside a body in air, with the noise of a CT or without.
TEST_F(SegmentationRequests, ASeedInAirWarns)
{
  this->Filter->SetSeedRadius(7);
  for (const auto& [noise, place] : { std::pair(0.0, 10.0), std::pair(20.0, 90.0) })
  {
    SCOPED_TRACE(noise);
    this->Filter->SetInputDataObject(CylinderImage(50, 50, 40, 2, { 40, 10 }, { -1000, noise }));
    this->Filter->SetSeedCenter(place, place, 40);
    ExpectOneWarning(this->Filter, "not in air, or move SeedCenter");
  }
}

// Between an object and the image's end, where some vertices find the object's boundary from
// without.
TEST(SegmentationWarnings, ASurfaceThatFindsNoBoundaryInPlacesWarns)
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetShapeToSphere();
  phantom->Update();
  double bounds[6];
  phantom->GetOutput()->GetBounds(bounds);
  vtkNew<vtkFlipFreeSegmentation> filter;
  filter->SetInputData(phantom->GetOutput());
  filter->SetSeedCenter(0.8 * bounds[0] + 0.2 * bounds[1], 0.8 * bounds[2] + 0.2 * bounds[3],
    0.8 * bounds[4] + 0.2 * bounds[5]);
  filter->SetSeedRadius(5);
  ExpectOneWarning(filter, "% of the surface found no boundary");
}

// More than a quarter of the surface lies where the image's end cuts the organ off.
TEST(SegmentationWarnings, AnOrganThatASlabCutsOffIsNotTakenForAir)
{
  vtkNew<vtkFlipFreeSegmentation> filter;
  filter->SetInputData(CylinderImage(60, 59, 20, 2));
  filter->SetSeedCenter(59, 59, 19);
  filter->SetSeedRadius(12);
  EXPECT_FALSE(WarnsOfAir(WarningsOf(filter)));
  vtkPolyData* surface = filter->GetSurface();
  int atEnds = 0;
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    const double z = surface->GetPoint(vertex)[2];
    atEnds += z < 1 || z > 37;
  }
  EXPECT_GT(4 * atEnds, surface->GetNumberOfPoints());
}

TEST(SegmentationWarnings, AThinStackIsNotTakenForAir)
{
  for (const int slices : { 1, 2 })
  {
    vtkNew<vtkFlipFreeSegmentation> filter;
    filter->SetInputData(CylinderImage(60, 59, slices, 5));
    filter->SetSeedCenter(59, 59, 2.5 * (slices - 1));
    filter->SetSeedRadius(12);
    EXPECT_FALSE(WarnsOfAir(WarningsOf(filter))) << slices << " slices";
    EXPECT_GT(filter->GetSurface()->GetNumberOfPoints(), 0);
  }
}

// Whatever makes vertices of a good seed solitary.
TEST_F(SegmentationRequests, AShortSearchOrManyOutliersAreNotTakenForAir)
{
  const std::vector<std::pair<double, double>> cases{ { 2, 3 }, { 4, 3 }, { 6, 3 }, { 0, 0.5 },
    { 0, 0.01 } };
  int solitary = 0;
  for (const auto& [distance, deviations] : cases)
  {
    this->Filter->SetSearchDistance(distance);
    this->Filter->GetSearch()->SetOutlierStandardDeviations(deviations);
    EXPECT_FALSE(WarnsOfAir(WarningsOf(this->Filter)))
      << distance << " mm, " << deviations << " deviations";
    vtkTable* convergence = this->Filter->GetConvergence();
    const vtkIdType last = convergence->GetNumberOfRows() - 1;
    solitary += 10 * convergence->GetValueByName(last, "Solitary").ToInt() >
      convergence->GetValueByName(last, "Vertices").ToInt();
  }
  EXPECT_GT(solitary, 0);
}

TEST_F(SegmentationRequests, FlipsAreCountedWhetherAvoidedOrNot)
{
  this->Filter->UsePublishedParameters();
  this->Filter->SetResolution(16);
  this->Filter->SetMaximumIterations(3);
  for (const bool avoid : { true, false })
  {
    this->Filter->GetDeform()->SetAvoidFlips(avoid);
    this->Filter->Update();
    vtkTable* convergence = this->Filter->GetConvergence();
    const vtkIdType last = convergence->GetNumberOfRows() - 1;
    const int flipping = convergence->GetValueByName(last, "Flipping").ToInt();
    EXPECT_GT(flipping, 0) << avoid;
    auto* states = this->Filter->GetSurface()->GetPointData()->GetArray("Correspondence");
    int marked = 0;
    for (vtkIdType vertex = 0; vertex < states->GetNumberOfTuples(); ++vertex)
    {
      marked += states->GetTuple1(vertex) == 2;
    }
    EXPECT_EQ(marked, flipping) << avoid;
  }
}
