// The whole pipeline on phantoms with exact ground truth: accuracy, and validity of the surface.
#include "PhantomCases.h"
#include "SurfaceHistory.h"

#include "vtkSegmentationMetrics.h"
#include "vtkSurfaceValidity.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{

class PhantomSegmentation : public testing::Test
{
protected:
  double Measure(vtkSegmentationMetrics* metrics, int label)
  {
    metrics->SetInputConnection(this->Filter->GetOutputPort());
    metrics->SetReferenceConnection(this->Phantom->GetOutputPort(1));
    metrics->SetReferenceLabel(label);
    metrics->Update();
    return metrics->GetDice();
  }

  void ExpectValid(int vertices)
  {
    vtkPolyData* surface = this->Filter->GetSurface();
    EXPECT_EQ(surface->GetNumberOfPoints(), vertices) << this->Filter->GetStopReasonAsString();
    EXPECT_EQ(this->Filter->GetNumberOfSelfIntersections(), 0);
    for (const char* defect :
      { "SelfIntersections", "BoundaryEdges", "NonManifoldEdges", "MisorientedEdges" })
    {
      EXPECT_EQ(FlipFree::CountDefects(defect, surface), 0) << defect;
    }
    EXPECT_EQ(FlipFree::CountDefects("EulerNumber", surface), 2);
  }

  /// The mean distance to the targets falls within each level.
  void ExpectConverged()
  {
    vtkTable* table = this->Filter->GetConvergence();
    const auto value = [table](vtkIdType row, const char* column)
    { return table->GetValueByName(row, column).ToDouble(); };
    double first = value(0, "MeanDistance");
    for (vtkIdType row = 1; row < table->GetNumberOfRows(); ++row)
    {
      const bool begins = value(row, "Level") > value(row - 1, "Level");
      const bool ends =
        row + 1 == table->GetNumberOfRows() || value(row + 1, "Level") > value(row, "Level");
      first = begins ? value(row, "MeanDistance") : first;
      EXPECT_TRUE(!ends || begins || value(row, "MeanDistance") < first) << "iteration " << row;
    }
  }

  int FlippedCorners()
  {
    const auto surfaces = FlipFree::HistoryOf(this->Filter);
    EXPECT_GT(surfaces.size(), 2u);
    return FlipFree::CountFlippedCorners(surfaces);
  }

  vtkNew<vtkPhantomSource> Phantom;
  vtkNew<vtkFlipFreeSegmentation> Filter;
  vtkNew<vtkSegmentationMetrics> Metrics;
};

} // namespace

TEST_F(PhantomSegmentation, CupFromOutside)
{
  FlipFree::SegmentCup(this->Filter, this->Phantom);
  EXPECT_GE(this->Measure(this->Metrics, 1), 0.985); // measured 0.991
  EXPECT_LE(this->Metrics->GetASD(), 0.25);          // 0.18 mm
  EXPECT_LE(this->Metrics->GetHD(), 1.8);            // 1.3 mm
  EXPECT_EQ(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::CONVERGED);
  this->ExpectValid(6144);
}

TEST_F(PhantomSegmentation, UTubeFromOutside)
{
  FlipFree::SegmentUTube(this->Filter, this->Phantom);
  EXPECT_GE(this->Measure(this->Metrics, 1), 0.975); // measured 0.988
  EXPECT_LE(this->Metrics->GetASD(), 0.4);           // 0.23 mm
  // The rest of the web between the legs encloses no voxel, but lies up to 9 mm from the tube.
  EXPECT_LE(this->Metrics->GetHD95(), 2); // 0.9 mm
  EXPECT_EQ(this->Filter->GetStopReason(), vtkFlipFreeSegmentation::CONVERGED);
  this->ExpectValid(6144);
}

TEST_F(PhantomSegmentation, ThinVesselFromInside)
{
  FlipFree::SegmentVessel(this->Filter, this->Phantom);
  EXPECT_GE(this->Measure(this->Metrics, 1), 0.85); // measured 0.892
  EXPECT_LE(this->Metrics->GetASD(), 0.7);          // 0.46 mm
  EXPECT_LE(this->Metrics->GetHD(), 9);             // 6.5 mm: both ends are reached
  this->ExpectValid(6 * 64 * 64);
}

TEST_F(PhantomSegmentation, StepsFlipNoCorner)
{
  FlipFree::SegmentUTube(this->Filter, this->Phantom);
  this->Filter->SetResolution(16);
  this->Filter->SetLevels(3);
  this->Filter->KeepHistoryOn();
  this->Filter->Update();
  EXPECT_EQ(this->FlippedCorners(), 0);
  this->ExpectValid(6 * 16 * 16);
}

TEST_F(PhantomSegmentation, NaiveMethodFlipsAndIntersectsItself)
{
  FlipFree::SegmentCup(this->Filter, this->Phantom);
  FlipFree::MakeNaive(this->Filter);
  this->Filter->KeepHistoryOn();
  this->Filter->Update();
  EXPECT_GT(this->Filter->GetNumberOfSelfIntersections(), 1000); // measured 12,000
  EXPECT_EQ(FlipFree::CountDefects("SelfIntersections", this->Filter->GetSurface()),
    this->Filter->GetNumberOfSelfIntersections());
  EXPECT_GT(this->FlippedCorners(), 1000);
}

namespace
{

// Bounds a little below what the default parameters reach.
struct Organ
{
  const char* Name;
  int Label;
  double Dice;
  double ASD;
};

class AbdomenSegmentation
  : public PhantomSegmentation
  , public testing::WithParamInterface<Organ>
{
};

} // namespace

// Search lines of 1.6 seed radii would end within the liver.
TEST_F(PhantomSegmentation, LiverFromASeedOfHalfItsRadius)
{
  this->Phantom->SetShapeToAbdomen();
  FlipFree::StartInside(this->Filter, this->Phantom, vtkPhantomSource::LIVER);
  this->Filter->SetSeedRadius(this->Filter->GetSeedRadius() / 2);
  EXPECT_GE(this->Measure(this->Metrics, vtkPhantomSource::LIVER), 0.935); // measured 0.942
  this->ExpectConverged();
  this->ExpectValid(6144);
}

TEST_P(AbdomenSegmentation, OrganFromItsSeedWithDefaults)
{
  this->Phantom->SetShapeToAbdomen();
  FlipFree::StartInside(this->Filter, this->Phantom, GetParam().Label);
  EXPECT_GE(this->Measure(this->Metrics, GetParam().Label), GetParam().Dice);
  EXPECT_LE(this->Metrics->GetASD(), GetParam().ASD);
  this->ExpectConverged();
  this->ExpectValid(6144);
}

INSTANTIATE_TEST_SUITE_P(PhantomSegmentation, AbdomenSegmentation,
  testing::Values(Organ{ "Liver", vtkPhantomSource::LIVER, 0.94, 2.3 },
    Organ{ "Spleen", vtkPhantomSource::SPLEEN, 0.92, 1.5 },
    Organ{ "LeftKidney", vtkPhantomSource::LEFT_KIDNEY, 0.94, 0.9 }),
  [](const testing::TestParamInfo<Organ>& organ) { return organ.param.Name; });
