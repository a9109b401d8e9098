// The way from VTK to ITK and back, by ITKVtkGlue or by the stand-ins: the same tests for both.
#include "ItkVtkBridge.h"

#include "ExampleImages.h"

#include <cstring>

namespace
{

class TestItkVtkBridge : public testing::TestWithParam<ExampleImages::NamedDirection>
{
};

TEST_P(TestItkVtkBridge, ToItkKeepsPlaceAndSharesVoxels)
{
  auto image = ExampleImages::Make(VTK_SHORT, GetParam().Matrix);
  const auto place = ExampleImages::FindMark(image);
  const auto shared = FlipFree::ShareWithItk<short>(image);

  EXPECT_EQ(shared->GetBufferPointer(), image->GetScalarPointer());
  const itk::Image<short, 3>::IndexType index = { { ExampleImages::MarkedVoxel[0],
    ExampleImages::MarkedVoxel[1], ExampleImages::MarkedVoxel[2] } };
  EXPECT_EQ(shared->GetPixel(index), ExampleImages::Mark);
  const auto point = shared->TransformIndexToPhysicalPoint<double>(index);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(point[i], place[i], 1e-12);
  }
}

TEST_P(TestItkVtkBridge, ExtentThatDoesNotBeginAtZero)
{
  auto image = ExampleImages::Make(VTK_FLOAT, GetParam().Matrix);
  const auto place = ExampleImages::FindMark(image);
  int extent[6] = { 3, 9, -2, 1, 10, 14 };
  auto moved = vtkSmartPointer<vtkImageData>::New();
  moved->ShallowCopy(image);
  double origin[3];
  image->TransformContinuousIndexToPhysicalPoint(-3, 2, -10, origin);
  moved->SetExtent(extent);
  moved->SetOrigin(origin);

  const auto shared = FlipFree::ShareWithItk<float>(moved);
  const itk::Image<float, 3>::IndexType index = { { ExampleImages::MarkedVoxel[0] + 3,
    ExampleImages::MarkedVoxel[1] - 2, ExampleImages::MarkedVoxel[2] + 10 } };
  EXPECT_EQ(shared->GetPixel(index), ExampleImages::Mark);
  const auto point = shared->TransformIndexToPhysicalPoint<double>(index);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(point[i], place[i], 1e-10);
  }
  ExampleImages::ExpectSameGeometry(FlipFree::MoveToVtk(shared.GetPointer()), moved, 0);
}

TEST_P(TestItkVtkBridge, ThereAndBack)
{
  auto image = ExampleImages::Make(VTK_UNSIGNED_CHAR, GetParam().Matrix);
  const auto shared = FlipFree::ShareWithItk<unsigned char>(image);
  const auto back = FlipFree::MoveToVtk(shared.GetPointer());
  ExampleImages::ExpectSameGeometry(back, image, 0);
  ExampleImages::ExpectSameVoxels(back, image);
  // ITK did not own the voxels: so there are now two of them.
  EXPECT_NE(back->GetScalarPointer(), image->GetScalarPointer());
}

TEST_P(TestItkVtkBridge, ToVtkTakesTheVoxelsOver)
{
  auto image = ExampleImages::Make(VTK_FLOAT, GetParam().Matrix);
  vtkSmartPointer<vtkImageData> taken;
  const void* voxels = nullptr;
  {
    const auto shared = FlipFree::ShareWithItk<float>(image);
    auto own = itk::Image<float, 3>::New();
    own->CopyInformation(shared);
    own->SetRegions(shared->GetLargestPossibleRegion());
    own->Allocate();
    voxels = own->GetBufferPointer();
    std::memcpy(own->GetBufferPointer(), shared->GetBufferPointer(),
      shared->GetPixelContainer()->Size() * sizeof(float));
    taken = FlipFree::MoveToVtk(own.GetPointer());
  }
  // The ITK image is gone, its voxels are not.
  EXPECT_EQ(taken->GetScalarPointer(), voxels);
  ExampleImages::ExpectSameGeometry(taken, image, 0);
  ExampleImages::ExpectSameVoxels(taken, image);
}

INSTANTIATE_TEST_SUITE_P(Directions, TestItkVtkBridge,
  testing::ValuesIn(ExampleImages::Directions()),
  [](const auto& parameter) { return std::string(parameter.param.Name); });

// Told once, so that a log says which of the two was tested.
TEST(TestItkVtkBridgeKind, IsToldByTheBuild)
{
#ifdef FLIPFREE_HAVE_ITKVTKGLUE
  RecordProperty("Bridge", "ITKVtkGlue");
  std::puts("The bridge is ITK's: itk::VTKImageToImageFilter and itk::ImageToVTKImageFilter.");
  const char* expected = "VTKImageToImageFilter";
#else
  RecordProperty("Bridge", "stand-ins");
  std::puts("The bridge is made of our stand-ins.");
  const char* expected = "VTKImageImport";
#endif
  using Filter = FlipFree::VtkToItkFilter<itk::Image<float, 3>>;
  EXPECT_STREQ(Filter::New()->GetNameOfClass(), expected);
}

} // namespace
