// A label map in place of a seed: the surface fills it, points correct it, and what is refused.
#include "BadInput.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

using namespace FlipFree;

namespace
{

using Shape = std::function<bool(const Eigen::Vector3d&)>;

/// Voxels of 2 mm; the value 3 inside the shape.
vtkSmartPointer<vtkImageData> LabelsOfShape(const Shape& shape)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(48, 48, 48);
  image->SetSpacing(2, 2, 2);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    const Eigen::Vector3d point(image->GetPoint(voxel));
    image->GetPointData()->GetScalars()->SetTuple1(voxel, shape(point) ? 3 : 0);
  }
  return image;
}

bool IsInBall(const Eigen::Vector3d& point, const Eigen::Vector3d& center, double radius)
{
  return (point - center).norm() <= radius;
}

/// Two balls that overlap; nothing that a sphere of intensities would find.
bool IsInPear(const Eigen::Vector3d& point)
{
  return IsInBall(point, { 40, 47, 47 }, 24) || IsInBall(point, { 66, 50, 44 }, 14);
}

/// An image of nothing but noise, which no method could segment.
vtkSmartPointer<vtkImageData> Noise()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(48, 48, 48);
  image->SetSpacing(2, 2, 2);
  image->AllocateScalars(VTK_SHORT, 1);
  unsigned int state = 1;
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    state = state * 1664525U + 1013904223U;
    image->GetPointData()->GetScalars()->SetTuple1(voxel, state >> 24U);
  }
  return image;
}

vtkSmartPointer<vtkFlipFreeSegmentation> MakeFilter(vtkImageData* labels)
{
  auto filter = vtkSmartPointer<vtkFlipFreeSegmentation>::New();
  filter->SetInputData(Noise());
  filter->SetStartLabelsData(labels);
  filter->SetStartLabel(3);
  return filter;
}

double DiceOf(vtkImageData* result, vtkImageData* labels)
{
  double both = 0;
  double sum = 0;
  for (vtkIdType voxel = 0; voxel < labels->GetNumberOfPoints(); ++voxel)
  {
    const bool found = result->GetPointData()->GetScalars()->GetTuple1(voxel) != 0;
    const bool given = labels->GetPointData()->GetScalars()->GetTuple1(voxel) == 3;
    both += found && given ? 1 : 0;
    sum += (found ? 1 : 0) + (given ? 1 : 0);
  }
  return 2 * both / sum;
}

} // namespace

TEST(StartLabels, AreFilledWhateverTheImageShows)
{
  const auto labels = LabelsOfShape(IsInPear);
  const auto filter = MakeFilter(labels);
  std::vector<std::string> warnings;
  KeepWarnings(filter, warnings);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  // There is no organ to be seen.
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("The result is doubtful: its confidence is 0."), std::string::npos)
    << warnings[0];
  EXPECT_EQ(filter->GetNumberOfSelfIntersections(), 0);
  EXPECT_EQ(DiceOf(filter->GetLabelMap(), labels), 1);

  // The seed has no part in it.
  const vtkIdType points = filter->GetSurface()->GetNumberOfPoints();
  const Eigen::Vector3d first(filter->GetSurface()->GetPoint(0));
  filter->SetSeedCenter(1e4, 0, 0);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_EQ(filter->GetSurface()->GetNumberOfPoints(), points);
  EXPECT_EQ(Eigen::Vector3d(filter->GetSurface()->GetPoint(0)), first);

  // All values but 0, which are the same here.
  filter->SetStartLabel(0);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_EQ(Eigen::Vector3d(filter->GetSurface()->GetPoint(0)), first);
}

TEST(StartLabels, AreCorrectedByPoints)
{
  const auto labels = LabelsOfShape(IsInPear);
  const auto filter = MakeFilter(labels);
  filter->Update();
  const double before = DiceOf(filter->GetLabelMap(), labels);
  filter->AddOutsidePoint(76, 50, 44); // in the small ball
  filter->AddInsidePoint(40, 47, 78);  // beyond the large one
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  const auto labelAt = [&](int i, int j, int k)
  { return filter->GetLabelMap()->GetScalarComponentAsDouble(i, j, k, 0); };
  EXPECT_EQ(labelAt(38, 25, 22), 0);
  EXPECT_EQ(labelAt(20, 23, 39), 1);
  EXPECT_EQ(filter->GetNumberOfSelfIntersections(), 0);
  EXPECT_LT(DiceOf(filter->GetLabelMap(), labels), before);
}

TEST(StartLabels, KeepTheirPartsAndHollows)
{
  const auto labels = LabelsOfShape(
    [](const Eigen::Vector3d& point)
    {
      return (IsInBall(point, { 30, 47, 47 }, 24) && !IsInBall(point, { 30, 47, 47 }, 14)) ||
        IsInBall(point, { 76, 47, 47 }, 12);
    });
  const auto filter = MakeFilter(labels);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_EQ(DiceOf(filter->GetLabelMap(), labels), 1);
  EXPECT_EQ(filter->GetNumberOfSelfIntersections(), 0);
}

TEST(StartLabels, ThatAreProbabilitiesGiveAWarning)
{
  const auto labels = LabelsOfShape(IsInPear);
  vtkNew<vtkFloatArray> probabilities;
  probabilities->DeepCopy(labels->GetPointData()->GetScalars());
  for (vtkIdType voxel = 0; voxel < 10; ++voxel)
  {
    probabilities->SetValue(voxel, 0.1F * static_cast<float>(voxel));
  }
  labels->GetPointData()->SetScalars(probabilities);
  for (const int label : { 3, 0 })
  {
    const auto filter = MakeFilter(labels);
    filter->SetStartLabel(label);
    std::vector<std::string> warnings;
    KeepWarnings(filter, warnings);
    filter->Update();
    const std::string text =
      label == 0 ? "every nonzero voxel is filled" : "only a voxel of exactly 3";
    const auto count = std::count_if(warnings.begin(), warnings.end(),
      [&text](const std::string& warning)
      {
        return warning.find("the start labels on port 3") != std::string::npos &&
          warning.find("are not valid labels") != std::string::npos &&
          warning.find(text) != std::string::npos;
      });
    EXPECT_EQ(count, 1);
  }
}

TEST(StartLabels, ThatCannotBeUsedAreRefused)
{
  const auto expect = [](vtkImageData* labels, int label, const std::string& words)
  {
    const auto filter = MakeFilter(labels);
    filter->SetStartLabel(label);
    const std::string error = ErrorOfUpdate(filter);
    EXPECT_NE(error.find("the start labels on port 3"), std::string::npos) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
    EXPECT_EQ(filter->GetSurface()->GetNumberOfPoints(), 0);
  };
  const auto labels = LabelsOfShape(IsInPear);
  expect(labels, 1, "have no voxels with the value 1; they have 3");
  const auto none = LabelsOfShape([](const Eigen::Vector3d&) { return false; });
  expect(none, 0, "have no nonzero voxels");
  expect(SphereImage(), 3, "differ; resample one onto the grid of the other");
  labels->SetOrigin(0.8, 0, 0);
  expect(labels, 3,
    "differ by a shift of (0.4, 0, 0) voxels; resample one onto the grid of the other");
  labels->SetOrigin(200, 0, 0);
  expect(labels, 3, "do not overlap");
  expect(ImageOfType(VTK_SHORT, 3), 3, "of one component");
}

// A cache of the history must not outlive a change of any input.
TEST(StartLabels, AndPointsThatChangeAreSeenWhereTheHistoryIsKept)
{
  const auto labels = LabelsOfShape(IsInPear);
  const auto filter = MakeFilter(labels);
  filter->SetResolution(8);
  filter->KeepHistoryOn();
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPoints> places;
  places->InsertNextPoint(40, 47, 78);
  vtkNew<vtkDoubleArray> kinds;
  kinds->SetName("Constraint");
  kinds->InsertNextValue(1);
  points->SetPoints(places);
  points->GetPointData()->AddArray(kinds);
  filter->SetConstraintData(points);
  filter->Update();
  const Eigen::Vector3d first(filter->GetSurface()->GetPoint(0));
  const double with = DiceOf(filter->GetLabelMap(), labels);
  places->SetPoint(0, 40, 47, 50); // inside anyway
  places->Modified();
  filter->Update();
  EXPECT_GT(DiceOf(filter->GetLabelMap(), labels), with);
  labels->GetPointData()->GetScalars()->Fill(0);
  labels->GetPointData()->GetScalars()->Modified();
  labels->Modified();
  EXPECT_NE(ErrorOfUpdate(filter).find("no voxels with the value 3"), std::string::npos);
}
