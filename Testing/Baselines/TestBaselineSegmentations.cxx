// What every method has to give: the phantom's organs, in any frame, within the input's geometry,
// with progress, and nothing after an abort.
#include "BaselineMethods.h"
#include "SurfaceHistory.h"

#include "vtkCallbackCommand.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPhantomSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSegmentationMetrics.h"
#include "vtkSurfaceToLabelMap.h"

#include <algorithm>
#include <chrono>
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

std::vector<unsigned char> LabelsOf(vtkImageData* labels)
{
  const auto* first = static_cast<unsigned char*>(labels->GetScalarPointer());
  return std::vector<unsigned char>(first, first + labels->GetNumberOfPoints());
}

class BaselineSegmentation : public testing::TestWithParam<BaselineMethod>
{
protected:
  /// Coarse, so that every method is done in a second or two.
  void SetUp() override
  {
    this->Phantom->SetShapeToAbdomen();
    this->Phantom->SetDimensions(110, 85, 45);
    this->Phantom->SetSpacing(3, 3, 6);
    this->Phantom->Update();
    this->Filter = GetParam().Make();
    this->StartIn(vtkPhantomSource::LIVER);
  }
  void StartIn(int label)
  {
    double seed[4];
    ASSERT_TRUE(this->Phantom->GetSeed(label, seed));
    this->Filter->SetInputConnection(this->Phantom->GetOutputPort());
    this->Filter->SetSeedCenter(seed);
    this->Filter->SetSeedRadius(seed[3]);
  }

  vtkNew<vtkPhantomSource> Phantom;
  vtkSmartPointer<vtkBaselineSegmentation> Filter;
};

/// Aborts a filter as soon as it has come so far.
struct AbortAt
{
  AbortAt(vtkAlgorithm* filter, double progress)
    : Progress(progress)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback(
      [](vtkObject* caller, unsigned long, void* client, void* now)
      {
        auto* self = static_cast<AbortAt*>(client);
        if (!self->Done && *static_cast<double*>(now) >= self->Progress)
        {
          self->Done = true;
          self->When = std::chrono::steady_clock::now();
          vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
        }
      });
    filter->AddObserver(vtkCommand::ProgressEvent, command);
  }

  double Progress;
  bool Done = false;
  std::chrono::steady_clock::time_point When;
};

} // namespace

TEST_P(BaselineSegmentation, FindsThePhantomsLiver)
{
  this->Filter->SetLabelValue(7);
  this->Filter->Update();
  vtkImageData* labels = this->Filter->GetLabelMap();
  vtkImageData* truth = vtkImageData::SafeDownCast(this->Phantom->GetOutputDataObject(1));
  const double dice = Dice(labels, truth, vtkPhantomSource::LIVER);
  std::cout << "Dice " << dice << std::endl;
  EXPECT_GE(dice, GetParam().Dice);
  const std::vector<unsigned char> values = LabelsOf(labels);
  EXPECT_TRUE(std::all_of(values.begin(), values.end(),
    [](unsigned char value) { return value == 0 || value == 7; }));
}

TEST_P(BaselineSegmentation, SurfaceIsClosedAndHoldsTheLabelledVoxels)
{
  this->Filter->Update();
  for (const char* defect : { "BoundaryEdges", "MisorientedEdges" })
  {
    EXPECT_EQ(CountDefects(defect, this->Filter->GetSurface()), 0) << defect;
  }
  vtkNew<vtkSurfaceToLabelMap> voxels;
  voxels->SetInputData(this->Filter->GetSurface());
  voxels->SetReferenceImageData(this->Filter->GetLabelMap());
  voxels->Update();
  // Flying edges puts points where the field is single precision.
  EXPECT_GE(Dice(voxels->GetOutput(), this->Filter->GetLabelMap(), 1), 0.999);
}

TEST_P(BaselineSegmentation, GeometryIsTheInputs)
{
  this->Filter->Update();
  const std::vector<unsigned char> expected = LabelsOf(this->Filter->GetLabelMap());
  vtkNew<vtkImageData> moved;
  moved->DeepCopy(this->Phantom->GetOutput());
  double seed[4];
  this->Phantom->GetSeed(vtkPhantomSource::LIVER, seed);
  double index[3];
  moved->TransformPhysicalPointToContinuousIndex(seed, index);

  // Left-handed and oblique.
  const double direction[9] = { 0, -0.8, 0.6, 1, 0, 0, 0, -0.6, -0.8 };
  moved->SetExtent(5, 114, -3, 81, 7, 51);
  moved->SetOrigin(-300, 40, 900);
  moved->SetDirectionMatrix(direction);
  moved->TransformContinuousIndexToPhysicalPoint(index[0] + 5, index[1] - 3, index[2] + 7, seed);
  this->Filter->SetInputData(moved);
  this->Filter->SetSeedCenter(seed);
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
    EXPECT_EQ(labels->GetDirectionMatrix()->GetData()[i], direction[i]);
  }
  const std::vector<unsigned char> values = LabelsOf(labels);
  std::size_t differ = 0;
  for (std::size_t voxel = 0; voxel < values.size(); ++voxel)
  {
    differ += values[voxel] != expected[voxel];
  }
  // The seed's voxels may differ by rounding.
  EXPECT_LE(differ, expected.size() / 2000);
  vtkNew<vtkSurfaceToLabelMap> voxels;
  voxels->SetInputData(this->Filter->GetSurface());
  voxels->SetReferenceImageData(labels);
  voxels->Update();
  EXPECT_GE(Dice(voxels->GetOutput(), labels, 1), 0.999);
}

TEST_P(BaselineSegmentation, AbortLeavesNothingAndDoesNotWait)
{
  for (const double progress : { 0.05, 0.3 })
  {
    AbortAt abort(this->Filter, progress);
    this->Filter->Modified();
    this->Filter->Update();
    const auto end = std::chrono::steady_clock::now();
    this->Filter->RemoveAllObservers();
    ASSERT_TRUE(abort.Done);
    EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
    EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints(), 0);
    // 100 ms on a machine that is not busy.
    EXPECT_LT(std::chrono::duration<double>(end - abort.When).count(), 1);
  }
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_GT(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
}

TEST_P(BaselineSegmentation, IsTheSameAgain)
{
  this->Filter->Update();
  const std::vector<unsigned char> first = LabelsOf(this->Filter->GetLabelMap());
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_EQ(first, LabelsOf(this->Filter->GetLabelMap()));
}

INSTANTIATE_TEST_SUITE_P(Baselines, BaselineSegmentation, testing::ValuesIn(BaselineMethods()),
  NameOf);
