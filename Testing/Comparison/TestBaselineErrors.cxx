// Whatever is wrong with the input of a method: one error that says what, where, and what to do,
// and empty outputs.
#include "BaselineMethods.h"

#include "BadInput.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

using namespace FlipFree;

namespace
{

class BaselineRefuses : public testing::TestWithParam<BaselineMethod>
{
protected:
  void SetUp() override
  {
    this->Filter = GetParam().Make();
    this->Filter->SetInputData(SphereImage());
    this->Filter->SetSeedCenter(ExampleCenter.data());
    this->Filter->SetSeedRadius(ExampleRadius);
  }
  void ExpectSegmentation()
  {
    EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
    EXPECT_GT(this->Filter->GetSurface()->GetNumberOfCells(), 0);
    EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints(), 32 * 32 * 32);
  }

  vtkSmartPointer<vtkBaselineSegmentation> Filter;
};

} // namespace

TEST_P(BaselineRefuses, BadImagesAlone)
{
  this->ExpectSegmentation();
  std::vector<Bad<vtkImageData>> images = BadImages();
  const std::vector<Bad<vtkImageData>> more = ImagesWithoutData();
  images.insert(images.end(), more.begin(), more.end());
  for (const Bad<vtkImageData>& bad : images)
  {
    ExpectRefused<vtkImageData>({ bad }, this->Filter, 0, "the image on port 0");
    EXPECT_EQ(this->Filter->GetNumberOfIterations(), 0) << bad.Name;
  }
  this->Filter->SetInputData(nullptr);
  ExpectPipelineRefusal(this->Filter, "port 0");
}

TEST_P(BaselineRefuses, ButNotVoxelsFarFromTheSeed)
{
  const auto image = ImageWith(0);
  image->SetScalarComponentFromDouble(0, 0, 0, 0, NotANumber);
  this->Filter->SetInputData(image);
  this->Filter->SetReach(40);
  this->ExpectSegmentation();
}

TEST_P(BaselineRefuses, Seeds)
{
  ExpectBadSeedsRefused(this->Filter.Get());
  ExpectSeedBetweenSlicesRefused(this->Filter.Get());
}

// A message of ITK's would say neither.
TEST_P(BaselineRefuses, ThinImagesByAWordOfItsOwn)
{
  const auto thin = SphereImage();
  thin->SetExtent(14, 16, 0, 31, 0, 31);
  thin->AllocateScalars(VTK_SHORT, 1);
  thin->GetPointData()->GetScalars()->Fill(100);
  thin->SetScalarComponentFromDouble(15, 0, 0, 0, 0);
  if (GetParam().Name == "GVFSnake" || GetParam().Name == "GeodesicLevelSet")
  {
    this->Filter->SetInputData(thin);
    ExpectRefusal(this->Filter,
      { "only 3 voxels of the image on port 0", "axis 0", "raise Reach" });
    return;
  }
  this->Filter->SetInputData(thin);
  EXPECT_EQ(ErrorOfUpdate(this->Filter), "0 errors");
  EXPECT_GT(this->Filter->GetSurface()->GetNumberOfCells(), 0);
  EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints(), 3 * 32 * 32);
}

TEST_P(BaselineRefuses, PropertiesThatAreNotNumbers)
{
  this->Filter->SetReach(NotANumber);
  ExpectRefusal(this->Filter, { "the value of Reach", "NaN", "set it" });
}

// The slice through the sphere's center: what the snake outlines, it needs no others for.
TEST(SnakeAccepts, AnImageOfOneSlice)
{
  const auto sphere = SphereImage();
  vtkNew<vtkImageData> slice;
  slice->SetDimensions(32, 32, 1);
  slice->SetSpacing(3, 3, 3);
  slice->SetOrigin(0, 0, ExampleCenter.z());
  slice->AllocateScalars(VTK_SHORT, 1);
  for (int j = 0; j < 32; ++j)
  {
    for (int i = 0; i < 32; ++i)
    {
      slice->SetScalarComponentFromDouble(i, j, 0, 0,
        sphere->GetScalarComponentAsDouble(i, j, 15, 0));
    }
  }
  vtkNew<vtkGVFSnake> filter;
  filter->SetInputData(slice);
  filter->SetSeedCenter(ExampleCenter.data());
  filter->SetSeedRadius(ExampleRadius);
  EXPECT_EQ(ErrorOfUpdate(filter), "0 errors");
  int inside = 0;
  for (vtkIdType voxel = 0; voxel < 32 * 32; ++voxel)
  {
    inside += filter->GetLabelMap()->GetPointData()->GetScalars()->GetTuple1(voxel) > 0;
  }
  EXPECT_NEAR(inside, 314, 60); // a disc of 30 mm
}

INSTANTIATE_TEST_SUITE_P(Baselines, BaselineRefuses, testing::ValuesIn(BaselineMethods()), NameOf);
