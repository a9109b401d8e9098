// What every method has to give: the phantom's organ, in any frame, within the input's geometry,
// with progress, and nothing after an abort.
#include "BaselineMethods.h"
#include "DataValues.h"
#include "PhantomCases.h"
#include "ProgressWatch.h"
#include "SurfaceHistory.h"

#include "vtkCell.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSegmentationMetrics.h"
#include "vtkSurfaceToLabelMap.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace FlipFree;

namespace
{

double Dice(vtkImageData* labels, vtkImageData* reference, int label)
{
  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetInputData(labels);
  metrics->SetReferenceData(reference);
  metrics->SetReferenceLabel(label);
  metrics->Update();
  return metrics->GetDice();
}

class BaselineSegmentation : public testing::TestWithParam<BaselineMethod>
{
protected:
  /// Coarse, so that every method is done in a second or two.
  void SetUp() override
  {
    double seed[4];
    ASSERT_TRUE(this->Phantom->GetSeed(this->Organ, seed));
    this->Filter->SetInputConnection(this->Phantom->GetOutputPort());
    this->Filter->SetSeedCenter(seed);
    this->Filter->SetSeedRadius(seed[3]);
  }
  /// Left-handed and oblique, and the seed with it.
  vtkSmartPointer<vtkImageData> MoveImage()
  {
    auto moved = vtkSmartPointer<vtkImageData>::New();
    moved->DeepCopy(this->Phantom->GetOutput());
    double seed[4];
    this->Phantom->GetSeed(this->Organ, seed);
    double index[3];
    moved->TransformPhysicalPointToContinuousIndex(seed, index);
    const double direction[9] = { 0, -0.8, 0.6, 1, 0, 0, 0, -0.6, -0.8 };
    moved->SetExtent(5, 114, -3, 81, 7, 51);
    moved->SetOrigin(-300, 40, 900);
    moved->SetDirectionMatrix(direction);
    moved->TransformContinuousIndexToPhysicalPoint(index[0] + 5, index[1] - 3, index[2] + 7, seed);
    this->Filter->SetInputData(moved);
    this->Filter->SetSeedCenter(seed);
    return moved;
  }

  vtkPhantomSource* Phantom = CoarseAbdomen();
  /// The snake would cling to the liver's vessels.
  int Organ = GetParam().Plane ? vtkPhantomSource::SPLEEN : vtkPhantomSource::LIVER;
  vtkSmartPointer<vtkBaselineSegmentation> Filter = GetParam().Make();
};

/// What is said of surfaces.
class BaselineSurface : public BaselineSegmentation
{
};

/// What is said of outlines.
class BaselineOutline : public BaselineSegmentation
{
};

/// The labels of one slice; those of the others are zero.
vtkSmartPointer<vtkImageData> OnlySlice(vtkImageData* labels, int k)
{
  auto slice = vtkSmartPointer<vtkImageData>::New();
  slice->DeepCopy(labels);
  auto* values = static_cast<unsigned char*>(slice->GetScalarPointer());
  const int* size = slice->GetDimensions();
  const vtkIdType plane = static_cast<vtkIdType>(size[0]) * size[1];
  std::fill(values, values + plane * k, 0);
  std::fill(values + plane * (k + 1), values + slice->GetNumberOfPoints(), 0);
  return slice;
}

} // namespace

TEST_P(BaselineSegmentation, FindsThePhantomsOrganAndTheSameAgain)
{
  this->Filter->SetLabelValue(7);
  this->Filter->Update();
  vtkImageData* labels = this->Filter->GetLabelMap();
  vtkImageData* truth = vtkImageData::SafeDownCast(this->Phantom->GetOutputDataObject(1));
  vtkSmartPointer<vtkImageData> reference = truth;
  if (GetParam().Plane)
  {
    double index[3];
    truth->TransformPhysicalPointToContinuousIndex(this->Filter->GetSeedCenter(), index);
    reference = OnlySlice(truth, static_cast<int>(std::lround(index[2])));
  }
  const double dice = Dice(labels, reference, this->Organ);
  std::cout << "Dice " << dice << std::endl;
  EXPECT_GE(dice, GetParam().Dice);
  const std::vector<double> values = ValuesOf(labels);
  EXPECT_TRUE(std::all_of(values.begin(), values.end(),
    [](double value) { return value == 0 || value == 7; }));
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_EQ(values, ValuesOf(this->Filter->GetLabelMap()));
}

TEST_P(BaselineSurface, IsClosedAndHoldsTheLabeledVoxelsInAnyFrame)
{
  for (const bool moved : { false, true })
  {
    if (moved)
    {
      this->MoveImage();
    }
    this->Filter->Update();
    for (const char* defect : { "BoundaryEdges", "MisorientedEdges" })
    {
      EXPECT_EQ(CountDefects(defect, this->Filter->GetSurface()), 0) << defect;
    }
    vtkNew<vtkSurfaceToLabelMap> voxels;
    voxels->SetInputData(this->Filter->GetSurface());
    voxels->SetReferenceImageData(this->Filter->GetLabelMap());
    voxels->Update();
    // Flying edges rounds the points' positions to single precision.
    EXPECT_GE(Dice(voxels->GetOutput(), this->Filter->GetLabelMap(), 1), 0.999);
  }
}

TEST_P(BaselineOutline, IsOneClosedLineInTheSeedsSlice)
{
  const auto moved = this->MoveImage();
  this->Filter->Update();
  vtkPolyData* outline = this->Filter->GetSurface();
  ASSERT_EQ(outline->GetNumberOfLines(), 1);
  EXPECT_EQ(outline->GetNumberOfPolys(), 0);
  vtkCell* line = outline->GetCell(0);
  EXPECT_EQ(line->GetNumberOfPoints(), outline->GetNumberOfPoints() + 1);
  EXPECT_EQ(line->GetPointId(0), line->GetPointId(static_cast<int>(line->GetNumberOfPoints() - 1)));
  double index[3];
  moved->TransformPhysicalPointToContinuousIndex(this->Filter->GetSeedCenter(), index);
  const auto slice = static_cast<int>(std::lround(index[2]));
  double area = 0; // of the outline, in voxels
  double first[3];
  moved->TransformPhysicalPointToContinuousIndex(outline->GetPoint(0), first);
  for (vtkIdType i = 0; i < outline->GetNumberOfPoints(); ++i)
  {
    double next[3];
    moved->TransformPhysicalPointToContinuousIndex(
      outline->GetPoint((i + 1) % outline->GetNumberOfPoints()), next);
    EXPECT_NEAR(next[2], slice, 1e-6);
    area += (first[0] * next[1] - next[0] * first[1]) / 2;
    std::copy(next, next + 3, first);
  }
  const std::vector<double> labels = ValuesOf(this->Filter->GetLabelMap());
  const auto plane = static_cast<std::ptrdiff_t>(labels.size()) / 45;
  const auto begin = labels.begin() + plane * (slice - 7);
  const auto inside = std::count(begin, begin + plane, 1);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 1), inside);
  EXPECT_NEAR(static_cast<double>(inside) / std::abs(area), 1, 0.05);
}

TEST_P(BaselineSegmentation, GeometryIsTheInputs)
{
  this->Filter->Update();
  const std::vector<double> expected = ValuesOf(this->Filter->GetLabelMap());
  const auto moved = this->MoveImage();
  this->Filter->Update();
  vtkImageData* labels = this->Filter->GetLabelMap();
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(labels->GetExtent()[i], moved->GetExtent()[i]);
  }
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(labels->GetOrigin()[i], moved->GetOrigin()[i]);
    EXPECT_EQ(labels->GetSpacing()[i], moved->GetSpacing()[i]);
  }
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_EQ(labels->GetDirectionMatrix()->GetData()[i],
      moved->GetDirectionMatrix()->GetData()[i]);
  }
  const std::vector<double> values = ValuesOf(labels);
  EXPECT_GT(std::count(values.begin(), values.end(), 1), 100);
  std::size_t differ = 0;
  for (std::size_t voxel = 0; voxel < values.size(); ++voxel)
  {
    differ += values[voxel] != expected[voxel];
  }
  // The seed's voxels may differ by rounding, and a mesh lies otherwise in an image that is turned.
  EXPECT_LE(differ, expected.size() / 500);
}

TEST_P(BaselineSegmentation, AbortLeavesNothingAndEndsTheWork)
{
  for (const double progress : { 0.05, 0.3 })
  {
    const ProgressWatch watch(this->Filter, progress);
    this->Filter->Modified();
    this->Filter->Update();
    ASSERT_TRUE(watch.Aborted());
    EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
    EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints(), 0);
    EXPECT_TRUE(watch.StoppedSoon());
  }
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_GT(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
}

INSTANTIATE_TEST_SUITE_P(Baselines, BaselineSurface, testing::ValuesIn(VolumeMethods()), NameOf);
INSTANTIATE_TEST_SUITE_P(Baselines, BaselineOutline, testing::Values(BaselineMethods().back()),
  NameOf);
INSTANTIATE_TEST_SUITE_P(Baselines, BaselineSegmentation, testing::ValuesIn(BaselineMethods()),
  NameOf);
