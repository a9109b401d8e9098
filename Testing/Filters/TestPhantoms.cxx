#include "vtkPhantomSource.h"

#include "DataValues.h"
#include "FilterErrors.h"
#include "MemoryLimit.h"
#include "ProgressWatch.h"

#include "vtkFeatureEdges.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace FlipFree;

namespace
{

const double Oblique[9] = { 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6 };

double SignedVolume(vtkPolyData* surface)
{
  double volume = 0;
  vtkNew<vtkIdList> face;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, face);
    double points[3][3];
    for (int corner = 0; corner < 3; ++corner)
    {
      surface->GetPoint(face->GetId(corner), points[corner]);
    }
    volume += vtkMath::Determinant3x3(points[0], points[1], points[2]) / 6;
  }
  return volume;
}

// Every voxel whose center lies in the ball has the label.
void ExpectBallInside(vtkImageData* labels, const double ball[4], int label)
{
  int inside = 0;
  for (vtkIdType point = 0; point < labels->GetNumberOfPoints(); ++point)
  {
    double x[3];
    labels->GetPoint(point, x);
    if (std::hypot(x[0] - ball[0], x[1] - ball[1], x[2] - ball[2]) < ball[3])
    {
      EXPECT_EQ(labels->GetPointData()->GetScalars()->GetComponent(point, 0), label);
      ++inside;
    }
  }
  EXPECT_GT(inside, 0);
}

void ExpectRefusal(vtkPhantomSource* source, const std::string& part)
{
  const std::string message = ErrorOfUpdate(source);
  EXPECT_NE(message.find(part), std::string::npos) << part << " not in: " << message;
  for (int port = 0; port < 3; ++port)
  {
    EXPECT_TRUE(IsEmpty(source->GetOutputDataObject(port))) << port;
  }
}

} // namespace

TEST(PhantomSource, MakesBothVolumesInTheSameGeometry)
{
  vtkNew<vtkPhantomSource> source;
  source->SetShapeToCup();
  source->SetDimensions(30, 40, 20);
  source->SetSpacing(1, 0.75, 2);
  source->SetOrigin(-5, 7, 100);
  source->SetDirection(Oblique);
  source->Update();
  for (vtkImageData* image : { source->GetOutput(), source->GetLabelMap() })
  {
    EXPECT_EQ(image->GetDimensions()[0], 30);
    EXPECT_EQ(image->GetDimensions()[1], 40);
    EXPECT_EQ(image->GetDimensions()[2], 20);
    EXPECT_EQ(image->GetSpacing()[1], 0.75);
    EXPECT_EQ(image->GetOrigin()[2], 100);
    for (int i = 0; i < 9; ++i)
    {
      EXPECT_EQ(image->GetDirectionMatrix()->GetData()[i], Oblique[i]);
    }
  }
  EXPECT_EQ(source->GetOutput()->GetScalarType(), VTK_SHORT);
  EXPECT_STREQ(source->GetOutput()->GetPointData()->GetScalars()->GetName(), "Intensity");
  EXPECT_EQ(source->GetLabelMap()->GetScalarType(), VTK_UNSIGNED_CHAR);
  EXPECT_STREQ(source->GetLabelMap()->GetPointData()->GetScalars()->GetName(), "Labels");
}

TEST(PhantomSource, DefaultIsASphereOfTheDocumentedSize)
{
  vtkNew<vtkPhantomSource> source;
  source->Update();
  EXPECT_EQ(source->GetOutput()->GetDimensions()[0], 96);
  EXPECT_EQ(source->GetOutput()->GetSpacing()[2], 1);
  const std::vector<double> labels = ValuesOf(source->GetLabelMap());
  EXPECT_NEAR(std::count(labels.begin(), labels.end(), 1), 4.18879 * 27000, 300);
}

TEST(PhantomSource, IntensitiesAreForegroundAndBackgroundWithTheNoiseAsked)
{
  vtkNew<vtkPhantomSource> source;
  source->SetForeground(150);
  source->SetBackground(-40);
  source->SetNoiseStandardDeviation(25);
  source->PartialVolumeOff();
  source->Update();
  const std::vector<double> intensities = ValuesOf(source->GetOutput());
  const std::vector<double> labels = ValuesOf(source->GetLabelMap());
  for (int label : { 0, 1 })
  {
    double count = 0;
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      if (labels[i] == label)
      {
        ++count;
        sum += intensities[i];
        squares += intensities[i] * intensities[i];
      }
    }
    EXPECT_NEAR(sum / count, label ? 150 : -40, 0.5);
    EXPECT_NEAR(std::sqrt(squares / count - std::pow(sum / count, 2)), 25, 0.25);
  }
}

TEST(PhantomSource, DirectionTurnsThePhantomAndChangesNoVoxel)
{
  vtkNew<vtkPhantomSource> straight;
  vtkNew<vtkPhantomSource> turned;
  for (vtkPhantomSource* source : { straight.Get(), turned.Get() })
  {
    source->SetShapeToUTube();
    source->SetDimensions(40, 40, 24);
    source->SetSpacing(1, 1, 2);
  }
  turned->SetDirection(Oblique);
  straight->Update();
  turned->Update();
  EXPECT_EQ(ValuesOf(straight->GetOutput()), ValuesOf(turned->GetOutput()));
  EXPECT_EQ(ValuesOf(straight->GetLabelMap()), ValuesOf(turned->GetLabelMap()));
}

TEST(PhantomSource, SeedsAndEnclosingSpheresFollowTheGrid)
{
  for (int shape = vtkPhantomSource::SPHERE; shape <= vtkPhantomSource::VESSEL; ++shape)
  {
    vtkNew<vtkPhantomSource> source;
    source->SetShape(shape);
    source->SetDimensions(80, 60, 30);
    source->SetSpacing(1, 1.25, 2.5);
    source->SetOrigin(10, -20, 30);
    source->SetDirection(Oblique);
    source->Update();
    double seed[4];
    ASSERT_TRUE(source->GetSeed(vtkPhantomSource::OBJECT, seed));
    ExpectBallInside(source->GetLabelMap(), seed, 1);
    double sphere[4];
    ASSERT_TRUE(source->GetEnclosingSphere(sphere));
    vtkImageData* labels = source->GetLabelMap();
    for (vtkIdType point = 0; point < labels->GetNumberOfPoints(); ++point)
    {
      if (labels->GetPointData()->GetScalars()->GetComponent(point, 0) == 1)
      {
        double x[3];
        labels->GetPoint(point, x);
        EXPECT_LT(std::hypot(x[0] - sphere[0], x[1] - sphere[1], x[2] - sphere[2]), sphere[3]);
      }
    }
    EXPECT_FALSE(source->GetSeed(77, seed));
  }
}

// Closed, on the right side of its normals, of the closed form's volume.
TEST(PhantomSource, SurfaceIsThatOfTheShapeInAnyFrame)
{
  const double mirrored[9] = { 0, -1, 0, -1, 0, 0, 0, 0, 1 };
  const double leftHanded[9] = { 0, 1, 0, 1, 0, 0, 0, 0, 1 };
  const double* directions[] = { Oblique, mirrored, leftHanded };
  for (const double* direction : directions)
  {
    vtkNew<vtkPhantomSource> source;
    source->SetShapeToSphere();
    source->SetDirection(direction);
    source->SetOrigin(7, -8, 9);
    source->GenerateSurfaceOn();
    source->Update();
    double seed[4];
    ASSERT_TRUE(source->GetSeed(vtkPhantomSource::OBJECT, seed));
    vtkPolyData* surface = source->GetSurface();
    ASSERT_GT(surface->GetNumberOfPoints(), 10000);
    for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
    {
      double x[3];
      surface->GetPoint(point, x);
      ASSERT_NEAR(std::hypot(x[0] - seed[0], x[1] - seed[1], x[2] - seed[2]), 30, 1e-6);
    }
    EXPECT_NEAR(SignedVolume(surface), 4.18879 * 27000, 100);
  }
}

TEST(PhantomSource, SurfacesOfAllPlainShapesAreClosedAndOfTheirVolume)
{
  const double expected[] = { 4.18879 * 27000, 52 * 52 * 52, 133116, 32711.7, 5629.9 };
  for (int shape = vtkPhantomSource::SPHERE; shape <= vtkPhantomSource::VESSEL; ++shape)
  {
    vtkNew<vtkPhantomSource> source;
    source->SetShape(shape);
    source->GenerateSurfaceOn();
    source->Update();
    vtkPolyData* surface = source->GetSurface();
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputData(surface);
    edges->FeatureEdgesOff();
    edges->Update();
    EXPECT_EQ(edges->GetOutput()->GetNumberOfCells(), 0) << shape;
    EXPECT_NEAR(SignedVolume(surface) / expected[shape], 1, 0.006) << shape;
  }
}

TEST(PhantomSource, AbdomenComesOnItsOwnGrid)
{
  vtkNew<vtkPhantomSource> source;
  source->SetShapeToAbdomen();
  source->UpdateInformation();
  vtkInformation* info = source->GetOutputInformation(0);
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  EXPECT_EQ(extent[1], 219);
  EXPECT_EQ(extent[3], 169);
  EXPECT_EQ(extent[5], 89);
  EXPECT_EQ(info->Get(vtkDataObject::SPACING())[0], 1.5);
  EXPECT_EQ(info->Get(vtkDataObject::SPACING())[2], 3);
}

TEST(PhantomSource, DependsOnTheSeedNotOnTheNumberOfThreads)
{
  std::vector<std::vector<double>> results;
  for (const auto& [threads, seed] : { std::pair(1, 42), std::pair(2, 42), std::pair(2, 43) })
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkPhantomSource> source;
    source->SetShapeToAbdomen();
    source->SetDimensions(55, 43, 15);
    source->SetSpacing(6, 6, 12);
    source->SetNumberOfLesions(3);
    source->SetRandomSeed(seed);
    source->Update();
    results.push_back(ValuesOf(source->GetOutput()));
    EXPECT_EQ(ValuesOf(source->GetLabelMap()).size(), results.back().size());
  }
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_NE(results[1], results[2]);
}

TEST(PhantomSource, AbdomenHasSeedsButNoEnclosingSphere)
{
  vtkNew<vtkPhantomSource> source;
  source->SetShapeToAbdomen();
  source->SetDimensions(110, 85, 45);
  source->SetSpacing(3, 3, 6);
  source->SetDirection(Oblique);
  source->SetOrigin(5, 6, 7);
  source->PartialVolumeOff(); // which takes long, and changes no label
  source->Update();
  for (int label = vtkPhantomSource::SPLEEN; label <= vtkPhantomSource::PANCREAS; ++label)
  {
    double seed[4];
    ASSERT_TRUE(source->GetSeed(label, seed)) << label;
    ExpectBallInside(source->GetLabelMap(), seed, label);
  }
  double ball[4];
  EXPECT_FALSE(source->GetSeed(12, ball));
  EXPECT_FALSE(source->GetEnclosingSphere(ball));
  double ends[6];
  EXPECT_FALSE(source->GetVesselEnds(ends));
}

TEST(PhantomSource, VesselsHaveTwoEndsOnTheirAxis)
{
  vtkNew<vtkPhantomSource> source;
  source->SetShapeToVessel();
  source->SetDirection(Oblique);
  source->Update();
  double ends[6];
  ASSERT_TRUE(source->GetVesselEnds(ends));
  for (const double* end : { ends, ends + 3 })
  {
    const double ball[4] = { end[0], end[1], end[2], 1 };
    ExpectBallInside(source->GetLabelMap(), ball, 1);
  }
  source->SetShapeToSphere();
  EXPECT_FALSE(source->GetVesselEnds(ends));
}

TEST(PhantomSource, WorksOnASingleSliceAndASingleVoxel)
{
  vtkNew<vtkPhantomSource> source;
  source->SetDimensions(32, 32, 1);
  source->SetSpacing(1, 1, 40);
  source->Update();
  const std::vector<double> labels = ValuesOf(source->GetLabelMap());
  EXPECT_NEAR(std::count(labels.begin(), labels.end(), 1), 314, 10);
  source->SetDimensions(1, 1, 1);
  source->Update();
  EXPECT_EQ(ValuesOf(source->GetLabelMap()), std::vector<double>{ 1 });
}

TEST(PhantomSource, RefusesBadInputOneByOne)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [](const std::string& part, auto&& breakIt)
  {
    vtkNew<vtkPhantomSource> source;
    source->SetDimensions(8, 8, 8);
    source->GenerateSurfaceOn();
    source->Update();
    EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 512);
    breakIt(source.Get());
    ExpectRefusal(source, part);
  };
  // The other errors of the grid are tested with the kernel.
  refuse("2^31", [](auto* source) { source->SetDimensions(3000, 3000, 3000); });
  refuse("spacing of axis 0", [=](auto* source) { source->SetSpacing(nan, 1, 1); });
  refuse("Foreground", [=](auto* source) { source->SetForeground(nan); });
  refuse("Background", [](auto* source) { source->SetBackground(1e6); });
  refuse("deviation of the noise", [](auto* source) { source->SetNoiseStandardDeviation(-1); });
  refuse("correlation", [](auto* source) { source->SetNoiseCorrelation(0.9); });
}

#ifdef FLIPFREE_CAN_LIMIT_MEMORY
TEST(PhantomSource, RefusesWhatTheMemoryDoesNotHold)
{
  vtkNew<vtkPhantomSource> source;
  source->SetDimensions(512, 512, 512);
  const MemoryLimit limit(32 << 20);
  ExpectRefusal(source, "No phantom: ");
}
#endif

TEST(PhantomSource, SaysWhyThereIsNoSeed)
{
  vtkNew<vtkPhantomSource> source;
  source->SetSpacing(1, 1, -1);
  const FilterErrors errors(source);
  double ball[4];
  EXPECT_FALSE(source->GetSeed(1, ball));
  EXPECT_FALSE(source->GetEnclosingSphere(ball));
  ASSERT_EQ(errors.OfFilter.size(), 2U);
  for (const std::string& error : errors.OfFilter)
  {
    EXPECT_NE(error.find("spacing of axis 2"), std::string::npos) << error;
  }
}

TEST(PhantomSource, CanBeAborted)
{
  vtkNew<vtkPhantomSource> source;
  const ProgressWatch watch(source, 0);
  EXPECT_EQ(ErrorOfUpdate(source), "0 errors");
  EXPECT_TRUE(IsEmpty(source->GetOutput()));
}
