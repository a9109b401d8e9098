#include "vtkSegmentationMetrics.h"

#include "ExamplePolyData.h"
#include "FilterErrors.h"
#include "LabelAdapter.h"
#include "Measures/MaskSurface.h"
#include "Mesh/SurfaceVoxelization.h"
#include "ProgressWatch.h"

#include "vtkDiscreteFlyingEdges3D.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkShortArray.h"
#include "vtkStructuredData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace FlipFree;

namespace
{

const Eigen::Vector3d Center(-30, 20, 150);

// A label map of whole numbers, in a type that is not the one that the kernels work on.
vtkSmartPointer<vtkImageData> LabelMapOf(const Surface& surface, vtkImageData* grid,
  short label = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(grid);
  vtkNew<vtkShortArray> labels;
  labels->SetNumberOfValues(image->GetNumberOfPoints());
  labels->FillValue(0);
  const ImageGeometry geometry = GeometryOf(image);
  FillRuns<short>(VoxelizeSurface(surface.Points, surface.Triangles, geometry), label, geometry,
    labels->GetPointer(0));
  image->GetPointData()->SetScalars(labels);
  return image;
}

vtkSmartPointer<vtkImageData> Grid(const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity())
{
  return ImageAround(Center, { 60, 50, 40 }, { 1, 1.2, 1.5 }, direction);
}

vtkSmartPointer<vtkSegmentationMetrics> Scores(vtkDataObject* segmentation, vtkImageData* reference)
{
  auto metrics = vtkSmartPointer<vtkSegmentationMetrics>::New();
  metrics->SetInputDataObject(segmentation);
  metrics->SetReferenceData(reference);
  metrics->Update();
  return metrics;
}

} // namespace

TEST(MaskSurface, OfABlockIsClosedAndLiesHalfwayToItsNeighbors)
{
  for (const auto& [name, direction] : ExampleDirections())
  {
    ImageGeometry geometry;
    geometry.Dimensions = { { 7, 6, 5 } };
    geometry.Spacing = { 1, 2, 3 };
    geometry.Direction = direction;
    geometry.Origin = { 100, -50, 20 };
    BitMask mask(geometry);
    for (int row = 0; row < 6; ++row) // touches the image's border
    {
      mask.InsertRun(3, 7, 1 + row % 3, row / 3);
    }
    const MaskSurface surface = SurfaceOf(mask);
    EXPECT_NO_THROW(
      RequireClosed(static_cast<int>(surface.Points.rows()), surface.Triangles, "it"));
    double greatest = 0;
    for (Eigen::Index point = 0; point < surface.Points.rows(); ++point)
    {
      const Eigen::Vector3d index = geometry.ToIndex(surface.Points.row(point));
      const Eigen::Vector3d outside =
        (index - Eigen::Vector3d(4.5, 2, 0.5)).cwiseAbs() - Eigen::Vector3d(2, 1.5, 1);
      greatest = std::max(greatest, std::abs(outside.maxCoeff()));
    }
    EXPECT_LT(greatest, 1e-12) << name;
    // A block of 4 x 3 x 2 voxels less its bevelled edges, outwards positive in any frame.
    const double volume = EnclosedVolume({ surface.Points, surface.Triangles });
    EXPECT_LT(volume, 4 * 3 * 2 * 6.0) << name;
    EXPECT_GT(volume, 0.8 * 4 * 3 * 2 * 6.0) << name;
  }
}

// Up to where each triangle begins, and the order of all.
TEST(MaskSurface, HasTheTrianglesOfVTKsFlyingEdges)
{
  std::mt19937 random(3);
  for (const double part : { 0.15, 0.5, 0.85 })
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(14, 11, 9);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    auto* const voxels = static_cast<unsigned char*>(image->GetScalarPointer());
    std::bernoulli_distribution coin(part);
    for (int k = 0; k < 9; ++k)
    {
      for (int j = 0; j < 11; ++j)
      {
        for (int i = 0; i < 14; ++i)
        {
          const bool isInner = i > 0 && j > 0 && k > 0 && i < 13 && j < 10 && k < 8;
          voxels[i + 14 * (j + 11 * k)] = isInner && coin(random) ? 1 : 0;
        }
      }
    }
    vtkNew<vtkDiscreteFlyingEdges3D> contour;
    contour->SetInputData(image);
    contour->SetValue(0, 1);
    contour->Update();
    const MaskSurface surface = SurfaceOf(LabelVolumeOf(image, "it").MaskOf(1));
    using Corners = std::multiset<std::array<double, 9>>;
    const auto cornersOf = [](const PointList& points, const TriangleList& triangles)
    {
      Corners corners;
      for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
      {
        std::array<std::array<double, 3>, 3> places;
        for (int corner = 0; corner < 3; ++corner)
        {
          const auto point = points.row(triangles(triangle, corner));
          places[corner] = { { point[0], point[1], point[2] } };
        }
        std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
        std::array<double, 9> all;
        for (int number = 0; number < 9; ++number)
        {
          all[number] = places[number / 3][number % 3];
        }
        corners.insert(all);
      }
      return corners;
    };
    vtkPolyData* const wanted = contour->GetOutput();
    EXPECT_EQ(cornersOf(surface.Points, surface.Triangles),
      cornersOf(CopyPoints(wanted), Triangulate(CopyPolys(wanted))));
  }
}

// Each type compares in its own way; what is asked for may lie beyond what it can hold.
TEST(MaskOf, IsThatOfComparingNumbersInAnyType)
{
  for (const int type : { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,
         VTK_UNSIGNED_SHORT, VTK_INT, VTK_UNSIGNED_INT, VTK_LONG_LONG, VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(137, 11, 5); // two whole words to a row, and a part of one
    image->AllocateScalars(type, 1);
    vtkDataArray* scalars = image->GetPointData()->GetScalars();
    for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
    {
      scalars->SetTuple1(voxel, static_cast<double>(voxel * 7919 % 251 % 128));
    }
    if (type == VTK_FLOAT || type == VTK_DOUBLE)
    {
      scalars->SetTuple1(3, 5.5);
    }
    for (const int label : { -1, 0, 5, 127, 128, 256, 261, 65541, 1 << 30 })
    {
      const BitMask mask = LabelVolumeOf(image, "the labels").MaskOf(label);
      for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
      {
        const double value = scalars->GetTuple1(voxel);
        int place[3];
        vtkStructuredData::ComputePointStructuredCoords(voxel, image->GetDimensions(), place);
        ASSERT_EQ(mask(place[0], place[1], place[2]), label < 0 ? value != 0 : value == label)
          << image->GetScalarTypeAsString() << " label " << label << " voxel " << voxel;
      }
    }
  }
}

namespace
{

// Calls body with VTK's threads as each of its backends makes them.
template <typename Body>
void WithEachBackend(const Body& body)
{
  for (const char* backend : { "Sequential", "STDThread", "TBB" })
  {
    SCOPED_TRACE(backend);
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ 2, backend, false }, body);
  }
}

// As the first voxels of the slices, one each in turn; the others are 0.
vtkSmartPointer<vtkImageData> ImageOfValues(int type, const std::vector<double>& values)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(20, 20, 40);
  image->AllocateScalars(type, 1);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars->Fill(0);
  vtkIdType place = 0;
  for (const double value : values)
  {
    scalars->SetTuple1(400 * (place % 40) + 2 * (place / 40), value);
    ++place;
  }
  return image;
}

std::vector<double> Downwards(double from, double to)
{
  std::vector<double> values;
  for (double value = from; value >= to; --value)
  {
    values.push_back(value);
  }
  return values;
}

LabelValues ValuesIn(vtkImageData* image)
{
  return LabelVolumeOf(image, "it").Values();
}

} // namespace

TEST(LabelsOf, AreTheLowestOfAllSlices)
{
  const auto labelsOf = [](const std::vector<double>& values)
  { return TextOf(ValuesIn(ImageOfValues(VTK_SHORT, values)).Labels); };
  const std::string twenty =
    "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20";
  WithEachBackend(
    [&]
    {
      EXPECT_EQ(labelsOf({}), "");
      EXPECT_EQ(labelsOf({ 6, 2, 6, 2, 1 }), "1, 2, 6");
      EXPECT_EQ(labelsOf(Downwards(20, 1)), twenty);
      EXPECT_EQ(labelsOf(Downwards(21, 1)), twenty + " and more");
      EXPECT_EQ(labelsOf(Downwards(300, 1)), twenty + " and more");
    });
}

TEST(LabelsOf, AreWholeNumbersFromOneWithAllTheirDigits)
{
  const LabelValues values = ValuesIn(
    ImageOfValues(VTK_DOUBLE, { 614454277, 0.5, 312782546, -5, 2147483647, 3e9, 312782546 }));
  EXPECT_EQ(TextOf(values.Labels), "312782546, 614454277, 2147483647");
  EXPECT_EQ(TextOf(values.Others), "-5, 0.5, 3000000000");
  EXPECT_TRUE(values.AreSeveral());
  EXPECT_FALSE(ValuesIn(ImageOfValues(VTK_DOUBLE, { -5, -5 })).AreSeveral());
  EXPECT_TRUE(ValuesIn(ImageOfValues(VTK_DOUBLE, { -5, 7 })).AreSeveral());
}

TEST(LabelsOf, AreFewWhereEveryVoxelHasItsOwn)
{
  std::vector<double> values;
  for (int step = 8000; step > 0; --step)
  {
    values.push_back(step / 8000.0);
  }
  WithEachBackend(
    [&]
    {
      const LabelValues found = ValuesIn(ImageOfValues(VTK_DOUBLE, values));
      EXPECT_EQ(TextOf(found.Labels), "1");
      EXPECT_EQ(TextOf(found.Others), "0.000125, 0.00025, 0.000375 and more");
    });
}

TEST(SegmentationMetrics, OfShiftedCubesAreClosedForm)
{
  // 20 mm cubes on voxels of 1 x 2 x 4 mm, shifted along x by 4 mm.
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(40, 20, 10);
  grid->SetSpacing(1, 2, 4);
  const Eigen::Vector3d low(4, 4, 4);
  const auto reference = LabelMapOf(Box(low, low + Eigen::Vector3d::Constant(20)), grid);
  const auto shifted =
    LabelMapOf(Box(low + Eigen::Vector3d(4, 0, 0), low + Eigen::Vector3d(24, 20, 20)), grid);
  const auto metrics = Scores(shifted, reference);
  EXPECT_DOUBLE_EQ(metrics->GetDice(), 0.8);
  EXPECT_DOUBLE_EQ(metrics->GetJaccard(), 16.0 / 24);
  EXPECT_EQ(metrics->GetRelativeVolumeDifference(), 0);
  EXPECT_DOUBLE_EQ(metrics->GetReferenceVolume(), 8);
  EXPECT_DOUBLE_EQ(metrics->GetSegmentationVolume(), 8);
  EXPECT_NEAR(metrics->GetHD(), 4, 1e-6);
  EXPECT_NEAR(metrics->GetHD95(), 4, 1e-6);
  // Of the six sides, two are 4 mm apart, one of them only away from its rim; the others coincide
  // but for strips (worked out in the test of the kernel). Bevelled edges change little.
  EXPECT_NEAR(metrics->GetASD(), (400 * 4 + 400 * 4 * 0.6 + 4 * 20 * 8) / 2400.0, 0.1);
}

TEST(SegmentationMetrics, OfConcentricSpheresAreTheDifferenceOfRadii)
{
  const auto reference = LabelMapOf(Sphere(32, Center, 18), Grid());
  const auto larger = LabelMapOf(Sphere(32, Center, 21), Grid());
  const auto ofLabels = Scores(larger, reference);
  EXPECT_NEAR(ofLabels->GetDice(), 2 * std::pow(18, 3) / (std::pow(18, 3) + std::pow(21, 3)), 5e-3);
  EXPECT_NEAR(ofLabels->GetRelativeVolumeDifference(), std::pow(21 / 18.0, 3) - 1, 1e-2);
  EXPECT_EQ(ofLabels->GetOverlapOf(), "label map");
  EXPECT_EQ(ofLabels->GetDistanceOf(), "surface of label map");
  // The steps of voxels reach toward each other.
  EXPECT_NEAR(ofLabels->GetASD(), 3, 0.25);
  ofLabels->SetLabelSmoothing(20);
  ofLabels->Update();
  EXPECT_NEAR(ofLabels->GetASD(), 3, 0.05);

  const auto ofMesh = Scores(PolyDataOf(Sphere(32, Center, 21)), reference);
  EXPECT_NEAR(ofMesh->GetASD(), 3, 0.15);
  EXPECT_EQ(ofMesh->GetDice(), ofLabels->GetDice());
  EXPECT_EQ(ofMesh->GetSegmentationVolume(), ofLabels->GetSegmentationVolume());
  EXPECT_EQ(ofMesh->GetOverlapOf(), "voxelized mesh");
  EXPECT_EQ(ofMesh->GetDistanceOf(), "mesh");
  ofMesh->SetLabelSmoothing(20);
  ofMesh->Update();
  EXPECT_NEAR(ofMesh->GetASD(), 3, 0.05);

  ofMesh->ScoreVoxelizationOn();
  ofMesh->Update();
  EXPECT_EQ(ofMesh->GetASD(), ofLabels->GetASD());
  EXPECT_EQ(ofMesh->GetHD(), ofLabels->GetHD());
  EXPECT_EQ(ofMesh->GetDistanceOf(), "surface of voxelized mesh");
}

TEST(SegmentationMetrics, AreTheSameInAnyFrame)
{
  const Surface potato = Potato(12, Center, 15);
  const Surface sphere = Sphere(12, Center, 16);
  const auto expected = Scores(LabelMapOf(potato, Grid()), LabelMapOf(sphere, Grid()));
  for (const auto& [name, direction] : ExampleDirections())
  {
    // Everything turns about the center, so that the voxels stay the same.
    const Eigen::Vector3d shift = Center - direction * Center;
    const auto reference = LabelMapOf(Moved(sphere, direction, shift), Grid(direction));
    const auto metrics =
      Scores(LabelMapOf(Moved(potato, direction, shift), Grid(direction)), reference);
    EXPECT_EQ(metrics->GetDice(), expected->GetDice()) << name;
    EXPECT_NEAR(metrics->GetASD(), expected->GetASD(), 1e-9) << name;
    EXPECT_NEAR(metrics->GetRMS(), expected->GetRMS(), 1e-9) << name;
    EXPECT_NEAR(metrics->GetHD(), expected->GetHD(), 1e-9) << name;
    EXPECT_NEAR(metrics->GetHD95(), expected->GetHD95(), 1e-3) << name;
    const auto ofMesh = Scores(PolyDataOf(Moved(potato, direction, shift)), reference);
    EXPECT_EQ(ofMesh->GetDice(), expected->GetDice()) << name;
  }
}

TEST(SegmentationMetrics, VolumesOfAShearedGridAreThoseOfItsVoxels)
{
  const double tilt = 40 * std::atan(1.0) / 45;
  Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity();
  sheared.col(2) << 0, std::sin(tilt), std::cos(tilt);
  const Surface sphere = Sphere(12, Center, 14);
  const auto grid = ImageAround(Center, { 60, 60, 60 }, { 0.8, 0.8, 0.8 }, sheared);
  const auto metrics = Scores(PolyDataOf(sphere), LabelMapOf(sphere, grid));
  EXPECT_EQ(metrics->GetDice(), 1);
  EXPECT_NEAR(metrics->GetSegmentationVolume(), EnclosedVolume(sphere) / 1000, 0.1);
  EXPECT_EQ(metrics->GetReferenceVolume(), metrics->GetSegmentationVolume());
  EXPECT_LT(metrics->GetHD(), 1); // a voxel
}

TEST(SegmentationMetrics, OfAnisotropicVoxelsAreThoseOfFineOnes)
{
  const auto fine = ImageAround(Center, { 90, 90, 90 }, { 0.6, 0.6, 0.6 }, ObliqueRotation());
  const auto coarse = ImageAround(Center, { 60, 60, 20 }, { 0.9, 0.9, 2.7 }, ObliqueRotation());
  const Surface potato = Potato(24, Center, 15);
  const Surface sphere = Sphere(24, Center, 17);
  const auto a = Scores(LabelMapOf(potato, fine), LabelMapOf(sphere, fine));
  const auto b = Scores(LabelMapOf(potato, coarse), LabelMapOf(sphere, coarse));
  EXPECT_NEAR(a->GetASD(), b->GetASD(), 0.1 * a->GetASD());
  EXPECT_NEAR(a->GetDice(), b->GetDice(), 5e-3);
  EXPECT_NEAR(a->GetReferenceVolume(), b->GetReferenceVolume(), 0.01 * a->GetReferenceVolume());
}

TEST(SegmentationMetrics, ScoreTheLabelAskedFor)
{
  const auto grid = Grid();
  const auto both = LabelMapOf(Sphere(8, Center, 10), grid, 5);
  auto* labels = vtkShortArray::SafeDownCast(both->GetPointData()->GetScalars());
  const auto other = LabelMapOf(Sphere(8, Center + Eigen::Vector3d(22, 0, 0), 6), grid, 2);
  auto* otherLabels = vtkShortArray::SafeDownCast(other->GetPointData()->GetScalars());
  for (vtkIdType voxel = 0; voxel < labels->GetNumberOfValues(); ++voxel)
  {
    labels->SetValue(voxel, labels->GetValue(voxel) + otherLabels->GetValue(voxel));
  }
  const auto metrics = Scores(other, both);
  EXPECT_LT(metrics->GetDice(), 0.5);
  metrics->SetReferenceLabel(2);
  metrics->Update();
  EXPECT_EQ(metrics->GetDice(), 1);
  metrics->SetSegmentationLabel(2);
  metrics->Update();
  EXPECT_EQ(metrics->GetDice(), 1);
  metrics->SetReferenceLabel(5);
  metrics->Update();
  EXPECT_EQ(metrics->GetDice(), 0);
}

TEST(SegmentationMetrics, FillTheTable)
{
  const auto metrics =
    Scores(PolyDataOf(Sphere(12, Center, 16)), LabelMapOf(Potato(12, Center, 15), Grid()));
  vtkTable* table = metrics->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 1);
  EXPECT_EQ(table->GetNumberOfColumns(), 11);
  const std::pair<const char*, double> columns[] = { { "Dice", metrics->GetDice() },
    { "Jaccard", metrics->GetJaccard() },
    { "RelativeVolumeDifference", metrics->GetRelativeVolumeDifference() },
    { "ASD", metrics->GetASD() }, { "RMS", metrics->GetRMS() }, { "HD95", metrics->GetHD95() },
    { "HD", metrics->GetHD() }, { "SegmentationVolume", metrics->GetSegmentationVolume() },
    { "ReferenceVolume", metrics->GetReferenceVolume() } };
  for (const auto& [name, value] : columns)
  {
    EXPECT_EQ(table->GetValueByName(0, name).ToDouble(), value) << name;
  }
  EXPECT_EQ(table->GetValueByName(0, "OverlapOf").ToString(), "voxelized mesh");
  EXPECT_EQ(table->GetValueByName(0, "DistanceOf").ToString(), "mesh");
}

TEST(SegmentationMetrics, AreSummedUpOnceThereAreAny)
{
  vtkNew<vtkSegmentationMetrics> metrics;
  EXPECT_EQ(metrics->GetSummary(), "");
  metrics->SetInputData(LabelMapOf(Sphere(6, Center, 9), Grid()));
  metrics->SetReferenceData(LabelMapOf(Sphere(6, Center, 10), Grid()));
  EXPECT_EQ(metrics->GetSummary(), "");
  metrics->Update();
  EXPECT_NE(metrics->GetSummary().find("Dice"), std::string::npos) << metrics->GetSummary();
}

TEST(SegmentationMetrics, DoNotDependOnThreads)
{
  const auto segmentation = PolyDataOf(Sphere(12, Center, 16));
  const auto reference = LabelMapOf(Potato(12, Center, 15), Grid());
  std::vector<std::array<double, 5>> results;
  WithEachBackend(
    [&]
    {
      const auto metrics = Scores(segmentation, reference);
      results.push_back({ metrics->GetDice(), metrics->GetASD(), metrics->GetRMS(),
        metrics->GetHD95(), metrics->GetHD() });
    });
  EXPECT_EQ(results[1], results[0]);
  EXPECT_EQ(results[2], results[0]);
}

TEST(SegmentationMetrics, StopWhenAborted)
{
  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputData(LabelMapOf(Potato(12, Center, 15), Grid()));
  metrics->SetReferenceData(LabelMapOf(Sphere(12, Center, 16), Grid()));
  metrics->SetSampleSpacing(0.05);
  {
    const ProgressWatch watch(metrics, 0.01);
    metrics->Update();
    EXPECT_LT(watch.ProgressOfAbort, 0.5);
    EXPECT_TRUE(watch.StoppedSoon());
  }
  EXPECT_EQ(metrics->GetOutput()->GetNumberOfRows(), 0);
  EXPECT_TRUE(std::isnan(metrics->GetDice()));
  EXPECT_EQ(metrics->GetSummary(), "");
  metrics->SetSampleSpacing(2);
  metrics->Update();
  EXPECT_EQ(metrics->GetOutput()->GetNumberOfRows(), 1);
}

TEST(SegmentationMetrics, MoveOnToImagesOfAnotherSize)
{
  vtkNew<vtkSegmentationMetrics> metrics;
  for (const int size : { 30, 50, 20 })
  {
    const auto grid =
      ImageAround(Center, { size, size, size }, { 1, 1, 1 }, Eigen::Matrix3d::Identity());
    metrics->SetInputData(LabelMapOf(Sphere(8, Center, 0.4 * size), grid));
    metrics->SetReferenceData(LabelMapOf(Sphere(8, Center, 0.45 * size), grid));
    EXPECT_EQ(ErrorOfUpdate(metrics), "0 errors");
    EXPECT_GT(metrics->GetDice(), 0.7);
  }
}

TEST(SegmentationMetrics, WarnOfAReferenceOfSeveralLabels)
{
  const auto one = LabelMapOf(Sphere(6, Center, 9), Grid());
  const auto several = LabelMapOf(Sphere(6, Center, 10), Grid());
  for (int label = 2; label < 30; ++label)
  {
    several->GetPointData()->GetScalars()->SetComponent(label, 0, label);
  }
  vtkNew<vtkSegmentationMetrics> metrics;
  std::vector<std::string> warnings;
  FlipFree::KeepWarnings(metrics, warnings);
  metrics->SetInputData(one);
  metrics->SetReferenceData(several);
  metrics->Update();
  ASSERT_EQ(warnings.size(), 1U);
  for (const char* part :
    { "The reference has the labels 1, 2, 3, ", ", 20 and more", "set ReferenceLabel" })
  {
    EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
  }
  metrics->SetReferenceLabel(1);
  metrics->Update();
  metrics->SetReferenceLabel(-1);
  metrics->SetInputData(several); // both of the same kind
  metrics->Update();
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(SegmentationMetrics, WarnOfASegmentationOfSeveralLabels)
{
  const auto one = LabelMapOf(Sphere(6, Center, 9), Grid());
  const auto several = LabelMapOf(Sphere(6, Center, 10), Grid());
  several->GetPointData()->GetScalars()->SetComponent(2, 0, 2);
  vtkNew<vtkSegmentationMetrics> metrics;
  std::vector<std::string> warnings;
  FlipFree::KeepWarnings(metrics, warnings);
  metrics->SetInputData(several);
  metrics->SetReferenceData(one);
  metrics->Update();
  metrics->SetReferenceData(several); // of which one label is chosen
  metrics->SetReferenceLabel(1);
  metrics->Update();
  ASSERT_EQ(warnings.size(), 2U);
  for (const std::string& warning : warnings)
  {
    for (const char* part : { "The segmentation has the labels 1, 2;", "set SegmentationLabel" })
    {
      EXPECT_NE(warning.find(part), std::string::npos) << warning;
    }
  }
  metrics->SetSegmentationLabel(1);
  metrics->Update();
  EXPECT_EQ(warnings.size(), 2U);
}

TEST(SegmentationMetrics, WarnOfNegativeNumbersBesideLabels)
{
  const auto one = LabelMapOf(Sphere(6, Center, 9), Grid());
  const auto marked = LabelMapOf(Sphere(6, Center, 10), Grid(), -1);
  marked->GetPointData()->GetScalars()->SetComponent(5, 0, 40);
  for (const bool isReference : { true, false })
  {
    const std::string name = isReference ? "the reference on port 1" : "the segmentation on port 0";
    vtkNew<vtkSegmentationMetrics> metrics;
    std::vector<std::string> warnings;
    FlipFree::KeepWarnings(metrics, warnings);
    metrics->SetInputData(isReference ? one : marked);
    metrics->SetReferenceData(isReference ? marked : one);
    metrics->Update();
    isReference ? metrics->SetReferenceLabel(40) : metrics->SetSegmentationLabel(40);
    metrics->Update();
    ASSERT_EQ(warnings.size(), 2U);
    const std::string beginning = "Of the values of " + name + ", -1 are not valid labels; ";
    EXPECT_NE(warnings[0].find(beginning + "every nonzero voxel counts as inside; give"),
      std::string::npos)
      << warnings[0];
    EXPECT_NE(warnings[1].find(beginning + "only a voxel of exactly 40"), std::string::npos)
      << warnings[1];
  }
}

class SegmentationMetricsRefuse : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Reference = LabelMapOf(Sphere(6, Center, 10), Grid());
    this->Segmentation = LabelMapOf(Sphere(6, Center, 9), Grid());
  }
  void ExpectError(vtkDataObject* segmentation, vtkImageData* reference, const std::string& part)
  {
    this->Metrics->SetInputDataObject(segmentation);
    this->Metrics->SetReferenceData(reference);
    this->Metrics->Modified();
    const std::string message = ErrorOfUpdate(this->Metrics);
    EXPECT_NE(message.find(part), std::string::npos) << part << " not in: " << message;
    EXPECT_EQ(this->Metrics->GetOutput()->GetNumberOfColumns(), 0);
    EXPECT_TRUE(std::isnan(this->Metrics->GetDice()));
    EXPECT_TRUE(std::isnan(this->Metrics->GetASD()));
    EXPECT_EQ(this->Metrics->GetDistanceOf(), "");
    EXPECT_EQ(this->Metrics->GetSummary(), "");
  }

  vtkNew<vtkSegmentationMetrics> Metrics;
  vtkSmartPointer<vtkImageData> Reference;
  vtkSmartPointer<vtkImageData> Segmentation;
};

TEST_F(SegmentationMetricsRefuse, EmptyMasks)
{
  this->Metrics->SetReferenceLabel(9);
  this->ExpectError(this->Segmentation, this->Reference,
    "the reference on port 1 is empty: no voxel has the label 9; set ReferenceLabel to one of 1");
  this->Metrics->SetReferenceLabel(1);
  this->Metrics->SetSegmentationLabel(9);
  this->ExpectError(this->Segmentation, this->Reference,
    "the segmentation on port 0 is empty: no voxel has the label 9; set SegmentationLabel to one "
    "of 1");
  this->Metrics->SetSegmentationLabel(1);
  this->Metrics->Update();
  EXPECT_GT(this->Metrics->GetDice(), 0.8);
  this->Metrics->SetSegmentationLabel(-1);
  this->Segmentation->GetPointData()->GetScalars()->Fill(0);
  this->Segmentation->Modified();
  this->ExpectError(this->Segmentation, this->Reference,
    "the segmentation is empty: no voxel is inside; ");
}

TEST_F(SegmentationMetricsRefuse, LabelsOfWhatIsNoLabelMap)
{
  this->Metrics->SetReferenceLabel(9);
  const std::string none = "the reference on port 1 is empty: no voxel has the label 9";
  vtkDataArray* voxels = this->Reference->GetPointData()->GetScalars();
  voxels->Fill(0);
  this->ExpectError(this->Segmentation, this->Reference, none + ", all are 0");
  voxels->Fill(-1000);
  voxels->SetComponent(7, 0, -990);
  this->ExpectError(this->Segmentation, this->Reference,
    none + "; it is not a label map; it contains -1000, -990, but a label map contains only whole");
  voxels->SetComponent(8, 0, 40);
  this->ExpectError(this->Segmentation, this->Reference,
    none + "; set ReferenceLabel to one of 40, if it is a label map: it also contains -1000, -990");
}

TEST_F(SegmentationMetricsRefuse, GrayValuesWhateverTheLabel)
{
  const std::string needs = ", but a label map contains only whole numbers from 0 up";
  const std::size_t most = LabelValues::Most;
  const auto expectWith = [&](const std::vector<int>& labels, std::size_t count, double first,
                            double step, const std::string& said)
  {
    vtkNew<vtkImageData> gray;
    gray->DeepCopy(this->Reference);
    vtkNew<vtkFloatArray> values;
    values->DeepCopy(this->Reference->GetPointData()->GetScalars());
    for (std::size_t voxel = 0; voxel < count; ++voxel)
    {
      values->SetValue(static_cast<vtkIdType>(voxel),
        static_cast<float>(first + step * static_cast<double>(voxel)));
    }
    gray->GetPointData()->SetScalars(values);
    for (const int label : labels)
    {
      this->Metrics->SetReferenceLabel(label);
      this->ExpectError(this->Segmentation, gray,
        "the reference on port 1 is not a label map; it contains " + said + needs);
      this->Metrics->SetReferenceLabel(-1);
      this->Metrics->SetSegmentationLabel(label);
      this->ExpectError(gray, this->Reference,
        "the segmentation on port 0 is not a label map; it contains " + said + needs);
      this->Metrics->SetSegmentationLabel(-1);
    }
  };
  expectWith({ -1, 1 }, 2, 0.25, 0.25, "0.25, 0.5");
  expectWith({ -1, 1 }, 4, -1000, 10, "-1000, -990, -980 and more");
  expectWith({ 1 }, most, 2, 1, "more than 1000 different values"); // and 1
  expectWith({ -1 }, LabelValues::MostOrgans, 2, 1, "more than 255 different values");
  // As many as there may be, and what is one mask of any value.
  this->Metrics->SetInputData(this->Segmentation);
  const vtkSmartPointer<vtkDataArray> voxels = this->Reference->GetPointData()->GetScalars();
  vtkNew<vtkShortArray> many;
  many->DeepCopy(voxels);
  for (std::size_t voxel = 0; voxel < most - 1; ++voxel)
  {
    many->SetValue(static_cast<vtkIdType>(voxel), static_cast<short>(2 + voxel));
  }
  this->Reference->GetPointData()->SetScalars(many);
  this->Metrics->SetReferenceData(this->Reference);
  this->Metrics->SetReferenceLabel(1);
  this->Metrics->Modified();
  EXPECT_EQ(ErrorOfUpdate(this->Metrics), "0 errors");
  vtkNew<vtkFloatArray> half;
  half->DeepCopy(voxels);
  for (vtkIdType voxel = 0; voxel < half->GetNumberOfTuples(); ++voxel)
  {
    half->SetValue(voxel, 0.5F * half->GetValue(voxel));
  }
  this->Reference->GetPointData()->SetScalars(half);
  this->Metrics->SetReferenceLabel(-1);
  this->Metrics->Modified();
  EXPECT_EQ(ErrorOfUpdate(this->Metrics), "0 errors");
  EXPECT_GT(this->Metrics->GetDice(), 0.8);
}

TEST_F(SegmentationMetricsRefuse, OtherGeometriesNamingThePorts)
{
  const std::string ports =
    "The segmentation (port 0) and the reference (port 1) cannot be compared";
  const auto smaller = LabelMapOf(Sphere(6, Center, 9),
    ImageAround(Center, { 50, 50, 41 }, { 1, 1.3, 1.5 }, Eigen::Matrix3d::Identity()));
  this->ExpectError(smaller, this->Reference, ports);
  this->ExpectError(smaller, this->Reference,
    "spacings of the segmentation on port 0 (1, 1.3, 1.5) mm");
  // An error is enough: there is no warning of several labels.
  std::vector<std::string> warnings;
  FlipFree::KeepWarnings(this->Metrics, warnings);
  this->Reference->GetPointData()->GetScalars()->SetComponent(0, 0, 2);
  const Eigen::Vector3d origin(this->Segmentation->GetOrigin());
  this->Segmentation->SetOrigin(origin[0] + 0.4, origin[1], origin[2]);
  this->ExpectError(this->Segmentation, this->Reference, "differ by a shift of (0.4, 0, 0) voxels");
  this->Segmentation->SetOrigin(origin[0] + 900, origin[1], origin[2]);
  this->ExpectError(this->Segmentation, this->Reference, "do not overlap");
  EXPECT_TRUE(warnings.empty());
  this->ExpectError(LabelMapOf(Sphere(6, Center, 9), Grid(ObliqueRotation())), this->Reference,
    "differ");
}
