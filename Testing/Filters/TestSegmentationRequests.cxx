// What a pipeline may ask of the segmentation beside the surface: its history as time steps, an end
// before the end, and the same bits from any number of threads.
#include "PhantomCases.h"

#include "vtkCallbackCommand.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

std::vector<double> PointsOf(vtkPolyData* surface)
{
  std::vector<double> coordinates;
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex)
  {
    double point[3];
    surface->GetPoint(vertex, point);
    coordinates.insert(coordinates.end(), point, point + 3);
  }
  return coordinates;
}

std::vector<unsigned char> LabelsOf(vtkImageData* labels)
{
  const auto* first = static_cast<unsigned char*>(labels->GetScalarPointer());
  return std::vector<unsigned char>(first, first + labels->GetNumberOfPoints());
}

class SegmentationRequests : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Phantom->SetDimensions(110, 85, 45);
    this->Phantom->SetSpacing(3, 3, 6);
    this->Phantom->SetShapeToAbdomen();
    FlipFree::StartInside(this->Filter, this->Phantom, vtkPhantomSource::SPLEEN);
    this->Filter->SetResolution(16);
    this->Filter->SetLevels(2);
  }

  vtkNew<vtkPhantomSource> Phantom;
  vtkNew<vtkFlipFreeSegmentation> Filter;
};

/// Aborts a filter as soon as it has come so far, and takes the time from then.
class AbortAt
{
public:
  AbortAt(vtkAlgorithm* filter, double progress)
    : Filter(filter)
    , Progress(progress)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* now)
      { static_cast<AbortAt*>(self)->Look(*static_cast<double*>(now)); });
    filter->AddObserver(vtkCommand::ProgressEvent, this->Command);
  }
  ~AbortAt() { this->Filter->RemoveObserver(this->Command); }
  AbortAt(const AbortAt&) = delete;
  void operator=(const AbortAt&) = delete;

  bool Done = false;
  double Time = 0;

private:
  void Look(double now)
  {
    if (now >= this->Progress && !this->Done)
    {
      this->Done = true;
      this->Time = vtkTimerLog::GetUniversalTime();
      this->Filter->AbortExecuteOn();
    }
  }

  vtkAlgorithm* Filter;
  double Progress;
  vtkNew<vtkCallbackCommand> Command;
};

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

  this->Filter->KeepHistoryOff();
  this->Filter->Update();
  EXPECT_FALSE(info->Has(Pipeline::TIME_STEPS()));
}

TEST_F(SegmentationRequests, TimeStepsComeFromOneRun)
{
  this->Filter->KeepHistoryOn();
  this->Filter->Update();
  double seconds[4];
  this->Filter->GetStageSeconds(seconds);
  this->Filter->UpdateTimeStep(1);
  this->Filter->UpdateTimeStep(3);
  for (int stage = 0; stage < 4; ++stage)
  {
    EXPECT_EQ(this->Filter->GetStageSeconds()[stage], seconds[stage]); // as no two runs take
  }
}

TEST_F(SegmentationRequests, AbortEndsSoonAndLeavesNothingHalfDone)
{
  this->Filter->Update();
  const std::vector<double> result = PointsOf(this->Filter->GetSurface());
  for (const double progress : { 0.05, 0.3, 0.6 })
  {
    SCOPED_TRACE(progress);
    this->Filter->Modified();
    AbortAt abort(this->Filter, progress);
    this->Filter->Update();
    const double seconds = vtkTimerLog::GetUniversalTime() - abort.Time;
    ASSERT_TRUE(abort.Done);
    EXPECT_LT(seconds, 0.5);
    EXPECT_STREQ(this->Filter->GetStopReason(), "aborted");
    EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
    EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints(), 0);
    EXPECT_EQ(this->Filter->GetNumberOfSelfIntersections(), -1);
    EXPECT_LT(this->Filter->GetProgress(), 1);
  }
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_STRNE(this->Filter->GetStopReason(), "aborted");
  EXPECT_EQ(PointsOf(this->Filter->GetSurface()), result);
}

// VTK's backends cut the work differently: in one piece, in a few per thread, in one per slice.
TEST_F(SegmentationRequests, ThreadsDoNotChangeABit)
{
  const std::string usual = vtkSMPTools::GetBackend();
  std::vector<double> surface;
  std::vector<unsigned char> labels;
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
        labels = LabelsOf(this->Filter->GetLabelMap());
        continue;
      }
      EXPECT_EQ(PointsOf(this->Filter->GetSurface()), surface);
      EXPECT_EQ(LabelsOf(this->Filter->GetLabelMap()), labels);
      ++compared;
    }
  }
  vtkSMPTools::SetBackend(usual.c_str());
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(surface.size(), 3u * 6 * 16 * 16);
  EXPECT_GT(compared, 0);
}
