// Progress and aborts of vtkGMMFeatureFilter.
#include "vtkGMMFeatureFilter.h"
#include "vtkPhantomSource.h"

#include "BadInput.h"
#include "ProgressWatch.h"

#include "vtkImageData.h"

using namespace FlipFree;

namespace
{

class FeatureRequests : public testing::Test
{
protected:
  void SetUp() override
  {
    vtkNew<vtkPhantomSource> phantom; // a sphere
    phantom->SetDimensions(48, 48, 48);
    phantom->SetSpacing(2, 2, 2);
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

// With leak control and without, of the image's own floats and of shorts that are converted: at
// every report, from the first, before any voxel is read, to the last, before the output is filled.
TEST_F(FeatureRequests, AnAbortAtAnyReportEndsSoonAndLeavesNothing)
{
  const vtkSmartPointer<vtkImageData> image =
    vtkImageData::SafeDownCast(this->Filter->GetInputDataObject(0, 0));
  for (const bool leakControl : { true, false })
  {
    vtkNew<vtkImageData> converted;
    converted->CopyStructure(image);
    converted->AllocateScalars(leakControl ? VTK_FLOAT : VTK_SHORT, 1);
    converted->CopyAndCastFrom(image, image->GetExtent());
    this->Filter->SetInputData(converted);
    this->Filter->SetLeakControl(leakControl);
    int reports = 0;
    {
      const ProgressWatch watch(this->Filter);
      EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
      reports = watch.Reports;
    }
    EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 48 * 48 * 48);
    ASSERT_GT(reports, leakControl ? 20 : 10);
    for (int report = 1; report < reports; ++report) // the last is VTK's own, at the end
    {
      SCOPED_TRACE(report);
      this->Filter->Modified();
      const ProgressWatch watch(this->Filter, NoAbort, report);
      EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
      EXPECT_TRUE(watch.StoppedSoon());
      EXPECT_TRUE(IsEmpty(this->Filter->GetOutput()));
    }
  }
}
