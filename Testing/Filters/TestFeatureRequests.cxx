// vtkGMMFeatureFilter: progress, and an end before the end.
#include "vtkGMMFeatureFilter.h"
#include "vtkPhantomSource.h"

#include "BadInput.h"
#include "FilterErrors.h"

#include "vtkImageData.h"
#include "vtkTimerLog.h"

using namespace FlipFree;

namespace
{

/// Watches the progress of a filter, and aborts it as soon as it has come so far.
class Watch
{
public:
  Watch(vtkAlgorithm* filter, double abortAt)
    : AbortAt(abortAt)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback([](vtkObject* caller, unsigned long, void* self, void* now)
      { static_cast<Watch*>(self)->Look(caller, *static_cast<double*>(now)); });
    filter->AddObserver(vtkCommand::ProgressEvent, command);
  }
  Watch(const Watch&) = delete;
  void operator=(const Watch&) = delete;

  int AbortAtReport = 0; ///< counted from 1; 0: at none
  int Reports = 0;
  int ReportsAfterAbort = -1; ///< -1: not aborted
  double Time = 0;            ///< of the abort

private:
  void Look(vtkObject* filter, double now)
  {
    EXPECT_GE(now, this->Last);
    this->Last = now;
    ++this->Reports;
    if (this->ReportsAfterAbort >= 0)
    {
      ++this->ReportsAfterAbort;
    }
    else if (now >= this->AbortAt || this->Reports == this->AbortAtReport)
    {
      this->ReportsAfterAbort = 0;
      this->Time = vtkTimerLog::GetUniversalTime();
      vtkAlgorithm::SafeDownCast(filter)->AbortExecuteOn();
    }
  }

  double AbortAt;
  double Last = 0;
};

class FeatureRequests : public testing::Test
{
protected:
  void SetUp() override
  {
    vtkNew<vtkPhantomSource> phantom; // a sphere in 96 x 96 x 96 voxels of 1 mm
    double seed[4];
    ASSERT_TRUE(phantom->GetSeed(1, seed));
    phantom->Update();
    this->Filter->SetInputData(phantom->GetOutput());
    this->Filter->SetSeedCenter(seed);
    this->Filter->SetSeedRadius(10);
    const QuadSphere sphere =
      MakeQuadSphere(8, Eigen::Vector3d(seed), 15, QuadSphereSpacing::Equiangular);
    this->Filter->SetSurfaceData(PolyDataOf(sphere.Points, sphere.Faces));
  }

  vtkNew<vtkGMMFeatureFilter> Filter;
};

} // namespace

TEST_F(FeatureRequests, ProgressIsReportedAllAlong)
{
  Watch watch(this->Filter, 2);
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_GT(watch.Reports, 20);
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 96 * 96 * 96);
}

// From the first question, before the voxels are looked at, to the last, before the output is
// filled: with leak control and without, of the image's own floats and of shorts that are
// converted.
TEST_F(FeatureRequests, AnAbortAtAnyReportLeavesNothing)
{
  auto* const image = vtkImageData::SafeDownCast(this->Filter->GetInputDataObject(0, 0));
  vtkNew<vtkImageData> floats;
  floats->CopyStructure(image);
  floats->AllocateScalars(VTK_FLOAT, 1);
  floats->CopyAndCastFrom(image, image->GetExtent());
  vtkNew<vtkImageData> shorts;
  shorts->CopyStructure(image);
  shorts->AllocateScalars(VTK_SHORT, 1);
  shorts->CopyAndCastFrom(image, image->GetExtent());
  for (const bool leakControl : { true, false })
  {
    this->Filter->SetInputData(leakControl ? floats.Get() : shorts.Get());
    this->Filter->SetLeakControl(leakControl);
    const Watch all(this->Filter, 2);
    this->Filter->Update();
    this->Filter->RemoveAllObservers();
    EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 96 * 96 * 96);
    ASSERT_GT(all.Reports, 10);
    for (int report = 1; report < all.Reports; ++report) // the last is VTK's own, of the end
    {
      this->Filter->Modified();
      Watch watch(this->Filter, 2);
      watch.AbortAtReport = report;
      this->Filter->Update();
      this->Filter->RemoveAllObservers();
      EXPECT_TRUE(IsEmpty(this->Filter->GetOutput())) << "report " << report;
      EXPECT_LE(watch.ReportsAfterAbort, 1) << "report " << report;
    }
  }
}

TEST_F(FeatureRequests, AbortEndsSoonAndLeavesNothing)
{
  for (const double progress : { 0.05, 0.15, 0.3, 0.5, 0.8 })
  {
    SCOPED_TRACE(progress);
    this->Filter->Modified();
    Watch watch(this->Filter, progress);
    FilterErrors errors(this->Filter);
    this->Filter->Update();
    EXPECT_LT(vtkTimerLog::GetUniversalTime() - watch.Time, 0.5);
    this->Filter->RemoveAllObservers();
    EXPECT_EQ(errors.Only(), "0 errors");
    EXPECT_LE(watch.ReportsAfterAbort, 1); // VTK's own, at the end
    EXPECT_GE(watch.ReportsAfterAbort, 0);
    EXPECT_TRUE(IsEmpty(this->Filter->GetOutput()));
  }
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 96 * 96 * 96);
}
