// The questions of vtkFlipFreeSegmentation: a table whose first row is the warning, and points that
// answer them.
#include "BadInput.h"

#include "vtkDoubleArray.h"
#include "vtkFlipFreeOrganGroup.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace
{

// A ball with a lobe on a neck, as in Testing/Support/lobed_ball.py. Of the same gray value, the
// lobe is kept; a little brighter, it is cut off.
vtkSmartPointer<vtkImageData> LobedBall(int brighter)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(80, 48, 48);
  image->SetSpacing(2, 2, 2);
  image->AllocateScalars(VTK_SHORT, 1);
  auto* voxel = static_cast<short*>(image->GetScalarPointer());
  std::uint32_t state = 1;
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    double at[3];
    image->GetPoint(point, at);
    const double x = at[0];
    const double offAxis = std::hypot(at[1] - 47, at[2] - 47);
    const bool behind = x > 78 && (std::hypot(x - 106, offAxis) < 24 || (x < 106 && offAxis < 11));
    const bool inside =
      behind || std::hypot(x - 48, offAxis) < 30 || (x > 48 && x < 106 && offAxis < 11);
    state = state * 1664525U + 1013904223U;
    const int noise = static_cast<int>((state >> 16) % 25) - 12;
    *voxel++ = static_cast<short>(20 + (inside ? 80 : 0) + (behind ? brighter : 0) + noise);
  }
  return image;
}

struct Questions : testing::Test
{
  vtkNew<vtkFlipFreeSegmentation> Filter;
  std::vector<std::string> Warnings;

  Questions()
  {
    this->Filter->SetSeedCenter(48, 47, 47);
    this->Filter->SetSeedRadius(18);
    this->Filter->SetResolution(16);
    FlipFree::KeepWarnings(this->Filter, this->Warnings);
  }

  void Segment(int brighter)
  {
    this->Warnings.clear();
    this->Filter->SetInputData(LobedBall(brighter));
    ASSERT_EQ(FlipFree::ErrorOfUpdate(this->Filter), "0 errors");
  }

  double Number(const char* column) const
  {
    return this->Filter->GetQuestions()->GetValueByName(0, column).ToDouble();
  }

  double Milliliters() const
  {
    vtkDataArray* const labels = this->Filter->GetLabelMap()->GetPointData()->GetScalars();
    double sum = 0;
    for (vtkIdType voxel = 0; voxel < labels->GetNumberOfTuples(); ++voxel)
    {
      sum += labels->GetTuple1(voxel);
    }
    return 0.008 * sum;
  }

  void ExpectTheLobe() const
  {
    ASSERT_EQ(this->Filter->GetQuestions()->GetNumberOfRows(), 1);
    EXPECT_NEAR(this->Number("x"), 100, 8);
    EXPECT_NEAR(this->Number("y"), 47, 8);
    EXPECT_NEAR(this->Number("z"), 47, 8);
    EXPECT_NEAR(this->Number("volume_ml"), 32, 8);
    EXPECT_GT(this->Number("margin"), 0);
  }
};

// A preview of a point: milliliters, and how many voxels of the image change.
struct Previewed
{
  double Milliliters;
  vtkIdType Voxels;
};

Previewed PreviewOf(vtkFlipFreeSegmentation* filter, bool inside, double x)
{
  vtkNew<vtkImageData> changed;
  const double volume = inside ? filter->PreviewInsidePoint(x, 47, 47, changed)
                               : filter->PreviewOutsidePoint(x, 47, 47, changed);
  vtkDataArray* const scalars = changed->GetPointData()->GetScalars();
  Previewed previewed{ volume, 0 };
  for (vtkIdType voxel = 0; scalars && voxel < scalars->GetNumberOfTuples(); ++voxel)
  {
    previewed.Voxels += scalars->GetTuple1(voxel) > 0 ? 1 : 0;
  }
  return previewed;
}

} // namespace

TEST_F(Questions, APreviewIsWhatThePointDoes)
{
  this->Filter->KeepForCorrectionsOn();
  this->Segment(12);
  const double before = this->Milliliters();
  const Previewed lobe = PreviewOf(this->Filter, true, 100);
  EXPECT_NEAR(lobe.Milliliters, 58, 6); // a ball of 24 mm
  EXPECT_NEAR(lobe.Milliliters, 0.008 * static_cast<double>(lobe.Voxels), 1e-9);
  EXPECT_EQ(PreviewOf(this->Filter, true, 40).Milliliters, 0); // is inside

  this->Filter->AddInsidePoint(100, 47, 47);
  ASSERT_EQ(FlipFree::ErrorOfUpdate(this->Filter), "0 errors");
  // So coarse a mesh does not fill all of it.
  EXPECT_NEAR(this->Milliliters() - before, 0.85 * lobe.Milliliters, 0.15 * lobe.Milliliters);
  EXPECT_EQ(PreviewOf(this->Filter, true, 100).Milliliters, 0);
  EXPECT_GT(PreviewOf(this->Filter, false, 118).Milliliters, 1);
}

TEST_F(Questions, APreviewLeavesNoTrace)
{
  this->Filter->KeepForCorrectionsOn();
  this->Segment(12);
  PreviewOf(this->Filter, true, 100);
  PreviewOf(this->Filter, false, 70);
  this->Filter->AddInsidePoint(100, 47, 47);
  ASSERT_EQ(FlipFree::ErrorOfUpdate(this->Filter), "0 errors");
  vtkNew<vtkDoubleArray> previewed;
  previewed->DeepCopy(this->Filter->GetOutput()->GetPoints()->GetData());

  this->Filter->KeepForCorrectionsOff();
  this->Filter->Modified();
  ASSERT_EQ(FlipFree::ErrorOfUpdate(this->Filter), "0 errors");
  vtkDataArray* const afresh = this->Filter->GetOutput()->GetPoints()->GetData();
  ASSERT_EQ(afresh->GetNumberOfValues(), previewed->GetNumberOfValues());
  for (vtkIdType point = 0; point < afresh->GetNumberOfTuples(); ++point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(afresh->GetComponent(point, axis), previewed->GetComponent(point, axis));
    }
  }
}

TEST_F(Questions, APreviewIsUnknownWhereNothingTells)
{
  EXPECT_EQ(PreviewOf(this->Filter, true, 100).Milliliters, -1); // no Update() yet
  this->Filter->KeepForCorrectionsOn();
  this->Segment(12);
  EXPECT_EQ(PreviewOf(this->Filter, false, 48).Milliliters, -1);  // in the seed
  EXPECT_EQ(PreviewOf(this->Filter, true, 1000).Milliliters, -1); // outside the image
  this->Filter->UsePublishedParameters();                         // without carving
  this->Filter->Update();
  EXPECT_EQ(PreviewOf(this->Filter, true, 100).Milliliters, -1);
  this->Filter->UseDefaultParameters();
  this->Filter->KeepForCorrectionsOff();
  this->Filter->Update();
  EXPECT_EQ(PreviewOf(this->Filter, true, 100).Milliliters, -1);
}

TEST_F(Questions, TheFirstIsTheWarningAndAPointAnswersIt)
{
  this->Segment(0);
  this->ExpectTheLobe();
  EXPECT_EQ(this->Number("included"), 1);
  EXPECT_GT(this->Milliliters(), 140);
  ASSERT_EQ(this->Warnings.size(), 1U);
  EXPECT_NE(this->Warnings[0].find("Is the part of "), std::string::npos) << this->Warnings[0];
  EXPECT_NE(this->Warnings[0].find("organ? AddOutsidePoint "), std::string::npos)
    << this->Warnings[0];

  this->Filter->AddOutsidePoint(this->Number("x"), this->Number("y"), this->Number("z"));
  this->Segment(0);
  EXPECT_EQ(this->Filter->GetQuestions()->GetNumberOfRows(), 0);
  EXPECT_EQ(this->Filter->GetQuestions()->GetNumberOfColumns(), 6);
  EXPECT_LT(this->Milliliters(), 120);
  EXPECT_TRUE(this->Warnings.empty());
}

TEST_F(Questions, AskForWhatWasLeftOut)
{
  this->Segment(6);
  this->ExpectTheLobe();
  EXPECT_EQ(this->Number("included"), 0);
  EXPECT_LT(this->Milliliters(), 120);
  ASSERT_EQ(this->Warnings.size(), 1U);
  EXPECT_NE(this->Warnings[0].find(" adds it."), std::string::npos) << this->Warnings[0];
  this->Filter->KeepForCorrectionsOn();
  this->Filter->AddInsidePoint(this->Number("x"), this->Number("y"), this->Number("z"));
  this->Segment(6);
  EXPECT_EQ(this->Filter->GetQuestions()->GetNumberOfRows(), 0);
  EXPECT_GT(this->Milliliters(), 140);
  // What a run has kept asks the same questions again, once the answer is taken back.
  this->Filter->RemoveAllCorrections();
  this->Filter->Update();
  this->ExpectTheLobe();
}

TEST_F(Questions, ThereAreNoneWithoutCarvingAndAfterErrors)
{
  this->Segment(6);
  ASSERT_EQ(this->Filter->GetQuestions()->GetNumberOfRows(), 1);
  this->Filter->SetSeedCenter(500, 0, 0);
  EXPECT_NE(FlipFree::ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetQuestions()->GetNumberOfRows(), 0);
  this->Filter->SetSeedCenter(48, 47, 47);
  this->Filter->UsePublishedParameters();
  this->Filter->SetResolution(16);
  ASSERT_EQ(FlipFree::ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_EQ(this->Filter->GetQuestions()->GetNumberOfRows(), 0);
  EXPECT_EQ(this->Filter->GetQuestions()->GetNumberOfColumns(), 6);
}

TEST_F(Questions, OfAGroupAreByOrgan)
{
  vtkNew<vtkFlipFreeOrganGroup> group;
  group->SetInputData(LobedBall(0));
  group->GetParameters()->SetResolution(16);
  group->AddOrgan("ball", 48, 47, 47, 18);
  EXPECT_EQ(group->GetQuestions(0), nullptr);
  ASSERT_EQ(FlipFree::ErrorOfUpdate(group), "0 errors");
  ASSERT_NE(group->GetQuestions(0), nullptr);
  EXPECT_EQ(group->GetQuestions(1), nullptr);
  ASSERT_EQ(group->GetQuestions(0)->GetNumberOfRows(), 1);
  EXPECT_NEAR(group->GetQuestions(0)->GetValueByName(0, "x").ToDouble(), 100, 8);
}
