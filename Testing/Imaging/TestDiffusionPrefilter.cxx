// vtkAnisotropicDiffusionPrefilter: invariants, and ITK's own filters as the second implementation.
#include "vtkAnisotropicDiffusionPrefilter.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkSeedRegionDiffusion.h"

#include "ItkVtkBridge.h"

#include "../Filters/ProgressWatch.h"
#include "ExampleImages.h"

#include "vtkBitArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkSMPTools.h"

#include "itkCurvatureAnisotropicDiffusionImageFilter.h"
#include "itkGradientAnisotropicDiffusionImageFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace
{

using FloatImage = itk::Image<float, 3>;

/// Two half-spaces, 100 apart, with Gaussian noise; the border is behind the first half of the x
/// axis.
vtkSmartPointer<vtkImageData> NoisyStep(int nx, int ny, int nz, double noise)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(nx, ny, nz);
  image->SetSpacing(0.8, 0.9, 2.5);
  image->SetOrigin(-10, 20, -300);
  image->SetDirectionMatrix(ExampleImages::Directions()[5].Matrix.data());
  image->AllocateScalars(VTK_SHORT, 1);
  auto* voxels = static_cast<short*>(image->GetScalarPointer());
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, noise);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    voxels[i] = static_cast<short>(std::lround((i % nx < nx / 2 ? 0 : 100) + normal(random)));
  }
  return image;
}

void SetScaleSphere(vtkAnisotropicDiffusionPrefilter* filter, vtkImageData* image, double i,
  double j, double k, double radius)
{
  double center[3];
  image->TransformContinuousIndexToPhysicalPoint(i, j, k, center);
  filter->SetScaleCenter(center);
  filter->SetScaleRadius(radius);
}

float At(vtkImageData* image, int i, int j, int k)
{
  return *static_cast<float*>(image->GetScalarPointer(i, j, k));
}

class TestDiffusionEquations : public testing::TestWithParam<int>
{
};

TEST_P(TestDiffusionEquations, ConstantImageIsLeftAlone)
{
  for (const int type : { VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_INT, VTK_FLOAT, VTK_DOUBLE })
  {
    auto image = ExampleImages::Make(type, ExampleImages::Directions()[4].Matrix);
    image->GetPointData()->GetScalars()->Fill(77);
    for (const double scale : { 0.0, 3.0 }) // measured, which gives zero, and given
    {
      vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
      filter->SetInputData(image);
      filter->SetEquation(GetParam());
      filter->SetGradientScale(scale);
      filter->Update();
      EXPECT_EQ(filter->GetOutput()->GetScalarType(), VTK_FLOAT);
      ExampleImages::ExpectSameGeometry(filter->GetOutput(), image, 0);
      ExampleImages::ExpectSameVoxels(filter->GetOutput(), image);
    }
  }
}

TEST_P(TestDiffusionEquations, CroppingChangesNothingButTheRim)
{
  auto image = NoisyStep(40, 32, 24, 15);
  const int iterations = 4;
  int crop[6] = { 5, 33, 4, 29, 2, 20 };
  const int all[6] = { 0, -1, 0, -1, 0, -1 };
  const auto filtered = [&](vtkImageData* input, const int* voi)
  {
    auto filter = vtkSmartPointer<vtkAnisotropicDiffusionPrefilter>::New();
    filter->SetInputData(input);
    filter->SetEquation(GetParam());
    filter->SetNumberOfIterations(iterations);
    SetScaleSphere(filter, image, 15, 16, 11, 5);
    filter->SetVOI(voi);
    filter->Update();
    return filter;
  };
  // Cropped before the filter, with the sphere still inside; indices stay.
  auto smaller = vtkSmartPointer<vtkImageData>::New();
  smaller->SetOrigin(image->GetOrigin());
  smaller->SetSpacing(image->GetSpacing());
  smaller->SetDirectionMatrix(image->GetDirectionMatrix());
  smaller->SetExtent(crop);
  smaller->AllocateScalars(VTK_SHORT, 1);
  smaller->CopyAndCastFrom(image, crop);
  const auto whole = filtered(image, all);
  const auto part = filtered(image, crop);
  const auto cropped = filtered(smaller, all);

  EXPECT_EQ(part->GetGradientScaleUsed(), whole->GetGradientScaleUsed());
  EXPECT_EQ(cropped->GetGradientScaleUsed(), whole->GetGradientScaleUsed());
  ExampleImages::ExpectSameGeometry(part->GetOutput(), smaller, 0);
  ExampleImages::ExpectSameVoxels(part->GetOutput(), cropped->GetOutput());
  int differs = 0; // in the rim only
  for (int k = crop[4]; k <= crop[5]; ++k)
  {
    for (int j = crop[2]; j <= crop[3]; ++j)
    {
      for (int i = crop[0]; i <= crop[1]; ++i)
      {
        const int toRim = std::min(
          { i - crop[0], crop[1] - i, j - crop[2], crop[3] - j, k - crop[4], crop[5] - k });
        const bool same = At(part->GetOutput(), i, j, k) == At(whole->GetOutput(), i, j, k);
        ASSERT_TRUE(same || toRim < iterations) << i << " " << j << " " << k;
        differs += !same;
      }
    }
  }
  EXPECT_GT(differs, 0);
}

TEST_P(TestDiffusionEquations, EqualsItksFilterWithTheSameNumbers)
{
  // Also as thin as a voxel on some axes.
  for (const auto& [nx, ny, nz] : { std::array{ 21, 26, 15 }, std::array{ 1, 20, 15 },
         std::array{ 20, 1, 15 }, std::array{ 20, 15, 1 }, std::array{ 1, 1, 1 } })
  {
    auto image = NoisyStep(nx, ny, nz, 20);
    vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
    filter->SetInputData(image);
    filter->SetEquation(GetParam());
    filter->SetNumberOfIterations(3);
    filter->SetConductance(1.5);
    filter->SetGradientScale(12);
    filter->SetTimeStep(0.04);
    filter->Update();

    auto region = vtkSmartPointer<vtkImageData>::New();
    region->CopyStructure(image);
    region->AllocateScalars(VTK_FLOAT, 1);
    region->CopyAndCastFrom(image, image->GetExtent());
    const auto run = [&](auto itkFilter)
    {
      itkFilter->SetInput(FlipFree::ShareWithItk<float>(region));
      itkFilter->SetNumberOfIterations(3);
      itkFilter->SetConductanceParameter(1.5);
      itkFilter->SetFixedAverageGradientMagnitude(12);
      itkFilter->SetTimeStep(0.04);
      itkFilter->Update();
      return FlipFree::MoveToVtk(itkFilter->GetOutput());
    };
    const auto expected = GetParam() == vtkAnisotropicDiffusionPrefilter::CURVATURE
      ? run(itk::CurvatureAnisotropicDiffusionImageFilter<FloatImage, FloatImage>::New())
      : run(itk::GradientAnisotropicDiffusionImageFilter<FloatImage, FloatImage>::New());
    ExampleImages::ExpectSameGeometry(filter->GetOutput(), expected, 0);
    ExampleImages::ExpectSameVoxels(filter->GetOutput(), expected);
  }
}

TEST_P(TestDiffusionEquations, SameBitsForAnyNumberOfThreads)
{
  auto image = NoisyStep(21, 26, 15, 20);
  std::vector<vtkSmartPointer<vtkImageData>> results;
  for (const int threads : { 1, 2, 3 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads },
      [&]()
      {
        vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
        filter->SetInputData(image);
        filter->SetEquation(GetParam());
        filter->Update();
        results.emplace_back(filter->GetOutput());
      });
  }
  ExampleImages::ExpectSameVoxels(results[0], results[1]);
  ExampleImages::ExpectSameVoxels(results[0], results[2]);
}

TEST_P(TestDiffusionEquations, OrientationDoesNotMatter)
{
  auto image = NoisyStep(20, 18, 14, 20);
  vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
  filter->SetEquation(GetParam());
  SetScaleSphere(filter, image, 10, 9, 7, 5);
  filter->SetInputData(image);
  filter->Update();
  vtkNew<vtkImageData> expected;
  expected->DeepCopy(filter->GetOutput());
  for (const auto& direction : ExampleImages::Directions())
  {
    image->SetDirectionMatrix(direction.Matrix.data());
    SetScaleSphere(filter, image, 10, 9, 7, 5);
    filter->Update();
    ExampleImages::ExpectSameGeometry(filter->GetOutput(), image, 0);
    ExampleImages::ExpectSameVoxels(filter->GetOutput(), expected);
    EXPECT_NE(filter->GetOutput()->GetDirectionMatrix(),
      image->GetDirectionMatrix()); // no common one
  }
}

INSTANTIATE_TEST_SUITE_P(Equations, TestDiffusionEquations,
  testing::Values(vtkAnisotropicDiffusionPrefilter::CURVATURE,
    vtkAnisotropicDiffusionPrefilter::GRADIENT),
  [](const auto& parameter)
  {
    return parameter.param == vtkAnisotropicDiffusionPrefilter::CURVATURE ? "Curvature"
                                                                          : "Gradient";
  });

TEST(TestDiffusionPrefilter, GradientScaleOfARampIsItsSlope)
{
  // 3 per mm along the first axis, 4 along the third: 5. The sphere keeps clear of the borders.
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(20, 20, 20);
  image->SetSpacing(0.5, 1, 2);
  image->SetDirectionMatrix(ExampleImages::Directions()[4].Matrix.data());
  image->AllocateScalars(VTK_DOUBLE, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const vtkIdType slice = i / 400;
    const double value =
      3 * 0.5 * static_cast<double>(i % 20) + 4 * 2.0 * static_cast<double>(slice);
    image->GetPointData()->GetScalars()->SetComponent(i, 0, value);
  }
  vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
  filter->SetInputData(image);
  SetScaleSphere(filter, image, 10, 10, 10, 3.5);
  filter->Update();
  EXPECT_NEAR(filter->GetGradientScaleUsed(), 5, 1e-5);
  EXPECT_DOUBLE_EQ(filter->GetTimeStepUsed(), 0.5 / 16);
}

// By default, over all of the VOI, whose rim has neighbors in the image.
TEST(TestDiffusionPrefilter, GradientScaleOfTheRegionCountsItsVoxels)
{
  for (const int type : { VTK_SHORT, VTK_FLOAT })
  {
    auto step = NoisyStep(21, 26, 15, 20);
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->CopyStructure(step);
    image->SetExtent(-3, 17, 10, 35, 2, 16);
    image->AllocateScalars(type, 1);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      image->GetPointData()->GetScalars()->SetTuple1(i,
        step->GetPointData()->GetScalars()->GetTuple1(i));
    }
    for (const auto& voi : { std::array<int, 6>{ { -3, 17, 10, 35, 2, 16 } },
           std::array<int, 6>{ { 0, 17, 12, 12, 5, 9 } } })
    {
      double sum = 0;
      int count = 0;
      for (int k = voi[4]; k <= voi[5]; ++k)
      {
        for (int j = voi[2]; j <= voi[3]; ++j)
        {
          for (int i = voi[0]; i <= voi[1]; ++i)
          {
            const std::array<int, 3> index{ { i, j, k } };
            for (int axis = 0; axis < 3; ++axis)
            {
              std::array<int, 3> before = index;
              std::array<int, 3> after = index;
              before[axis] = std::max(before[axis] - 1, image->GetExtent()[2 * axis]);
              after[axis] = std::min(after[axis] + 1, image->GetExtent()[2 * axis + 1]);
              const double difference =
                image->GetScalarComponentAsDouble(after[0], after[1], after[2], 0) -
                image->GetScalarComponentAsDouble(before[0], before[1], before[2], 0);
              sum += std::pow(difference / (2 * image->GetSpacing()[axis]), 2);
            }
            ++count;
          }
        }
      }
      vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
      filter->SetInputData(image);
      filter->SetVOI(voi.data());
      filter->Update();
      const double expected = std::sqrt(sum / count);
      EXPECT_NEAR(filter->GetGradientScaleUsed(), expected, 1e-12 * expected);
    }
  }
}

// The grid of a gantry tilted by 40 degrees. A voxel of the sphere's far end, along the shear,
// makes all the difference.
TEST(TestDiffusionPrefilter, GradientScaleOfAShearedGridCountsTheWholeSphere)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(30, 30, 30);
  const double tilt = 40 * std::atan(1.0) / 45;
  const double sheared[9] = { 1, 0, 0, 0, 1, std::sin(tilt), 0, 0, std::cos(tilt) };
  image->SetDirectionMatrix(sheared);
  image->AllocateScalars(VTK_FLOAT, 1);
  const double radius = 6;
  int index[3];
  double center[3];
  image->TransformContinuousIndexToPhysicalPoint(15, 15, 15, center);
  double sum = 0;
  int count = 0;
  for (index[2] = 0; index[2] < 30; ++index[2])
  {
    for (index[1] = 0; index[1] < 30; ++index[1])
    {
      for (index[0] = 0; index[0] < 30; ++index[0])
      {
        image->SetScalarComponentFromDouble(index[0], index[1], index[2], 0, index[1] * index[1]);
        double point[3];
        image->TransformIndexToPhysicalPoint(index, point);
        if (std::hypot(point[0] - center[0], point[1] - center[1], point[2] - center[2]) <= radius)
        {
          sum += 4.0 * index[1] * index[1]; // the slope is twice the index
          ++count;
        }
      }
    }
  }
  vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
  filter->SetInputData(image);
  filter->SetScaleCenter(center);
  filter->SetScaleRadius(radius);
  filter->Update();
  EXPECT_NEAR(filter->GetGradientScaleUsed(), std::sqrt(sum / count), 1e-6);
}

TEST(TestDiffusionPrefilter, FeatureIsModeledWithTheNoiseBeforeSmoothing)
{
  auto image = NoisyStep(40, 30, 20, 5);
  double center[3];
  image->TransformContinuousIndexToPhysicalPoint(9, 15, 10, center);
  const double radius = 6.03;
  const auto noiseOf = [](vtkImageData* smooth)
  {
    vtkDataArray* noise = smooth->GetFieldData()->GetArray("NoiseStandardDeviation");
    return noise && noise->GetNumberOfValues() == 1 ? noise->GetTuple1(0) : -1;
  };
  vtkNew<vtkAnisotropicDiffusionPrefilter> smooth;
  smooth->SetInputData(image);
  smooth->SetNumberOfIterations(20);
  smooth->Update();
  EXPECT_EQ(noiseOf(smooth->GetOutput()), -1); // without a sphere
  smooth->SetScaleCenter(center);
  smooth->SetScaleRadius(radius);
  vtkNew<vtkGMMFeatureFilter> feature;
  feature->SetInputConnection(smooth->GetOutputPort());
  feature->SetSeedCenter(center);
  feature->SetSeedRadius(radius);
  feature->Update();
  const double noise = noiseOf(smooth->GetOutput());
  EXPECT_NEAR(noise, 5, 0.5);

  vtkNew<vtkSeedRegionDiffusion> other;
  other->SetInputData(image);
  other->SetSeedCenter(center);
  other->SetSeedRadius(radius);
  other->Update();
  EXPECT_DOUBLE_EQ(noise, noiseOf(other->GetOutput()));

  const auto narrowest = [&feature]()
  {
    double range[2];
    feature->GetOutput()->GetFieldData()->GetArray("MixtureStandardDeviations")->GetRange(range);
    return range[0];
  };
  EXPECT_GE(narrowest(), noise);
  vtkNew<vtkImageData> unknown; // the very same voxels
  unknown->DeepCopy(smooth->GetOutput());
  unknown->GetFieldData()->Initialize();
  feature->SetInputData(unknown);
  feature->Update();
  EXPECT_LT(narrowest(), noise);
}

TEST(TestDiffusionPrefilter, NoIterationOnlyConverts)
{
  auto image = NoisyStep(12, 10, 8, 25);
  vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
  filter->SetInputData(image);
  filter->SetNumberOfIterations(0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetScalarType(), VTK_FLOAT);
  ExampleImages::ExpectSameVoxels(filter->GetOutput(), image);
}

TEST(TestDiffusionPrefilter, BadInputIsRefusedWithOneError)
{
  const auto refuse = [](vtkImageData* image, const std::string& words,
                        const std::function<void(vtkAnisotropicDiffusionPrefilter*)>& set = {})
  {
    SCOPED_TRACE(words);
    vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
    filter->SetInputData(image);
    if (set)
    {
      set(filter);
    }
    ExampleImages::ExpectRefusal(filter, { words }, [&filter]() { filter->Update(); });
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  };
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(3, 3, 3);
  refuse(bare, "no point scalars");
  bare->AllocateScalars(VTK_SHORT, 2);
  refuse(bare, "2 components");
  vtkNew<vtkBitArray> bits;
  bits->SetName("Mask");
  bits->SetNumberOfValues(27);
  bare->GetPointData()->SetScalars(bits);
  refuse(bare, "the scalars 'Mask' of the image on port 0 are of type bit");
  auto image = NoisyStep(12, 10, 8, 25);
  image->SetSpacing(1, -1, 1);
  refuse(image, "spacing of (1, -1, 1) mm");
  image = NoisyStep(12, 10, 8, 25);
  refuse(image, "VOI", [](auto* filter) { filter->SetVOI(100, 110, 0, 9, 0, 7); });
  refuse(image, "TimeStep", [](auto* filter) { filter->SetTimeStep(0.06); });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuse(image, "the value of TimeStep", [=](auto* filter) { filter->SetTimeStep(nan); });
  refuse(image, "the value of Conductance", [=](auto* filter) { filter->SetConductance(nan); });
  refuse(image, "the value of GradientScale", [=](auto* filter) { filter->SetGradientScale(nan); });
  refuse(image, "the value of ScaleRadius", [=](auto* filter) { filter->SetScaleRadius(nan); });
  refuse(image, "scale sphere",
    [=](auto* filter)
    {
      filter->SetScaleCenter(nan, 0, 0);
      filter->SetScaleRadius(10);
    });
  refuse(image, "scale sphere",
    [](auto* filter)
    {
      filter->SetScaleCenter(1e6, 1e6, 1e6);
      filter->SetScaleRadius(10);
    });
  refuse(image, "scale sphere", // which the scale does not need, but the noise
    [](auto* filter)
    {
      filter->SetGradientScale(5);
      filter->SetScaleCenter(1e6, 1e6, 1e6);
      filter->SetScaleRadius(10);
    });
  refuse(image, "scale sphere", // between the voxels
    [&](auto* filter) { SetScaleSphere(filter, image, 5.5, 5.5, 5.5, 0.1); });
  auto broken = ExampleImages::Make(VTK_DOUBLE, ExampleImages::Directions()[0].Matrix);
  for (const double value :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300 })
  {
    broken->SetScalarComponentFromDouble(3, 2, 1, 0, value);
    refuse(broken, "is not a finite number in the range of float; replace such voxels first");
  }
}

// At the first report nothing has been looked at: not the voxels' finiteness, not their gradients.
TEST(TestDiffusionPrefilter, AnAbortAtAnyReportLeavesNothing)
{
  auto image = NoisyStep(12, 10, 8, 25);
  const auto abortAt = [&image](int report)
  {
    vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
    ExampleImages::Errors errors(filter);
    filter->SetInputData(image);
    const FlipFree::ProgressWatch watch(filter, FlipFree::NoAbort, report);
    filter->Update();
    EXPECT_EQ(errors.Count(), 0);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints() == 0, report > 0) << "report " << report;
    EXPECT_EQ(filter->GetGradientScaleUsed() == 0, report > 0 && report < 4) << report;
    return watch.Reports;
  };
  ASSERT_GE(abortAt(0), 5);
  for (int report = 1; report <= 4; ++report) // before there is a copy that ITK works on
  {
    abortAt(report);
  }
}

TEST(TestDiffusionPrefilter, AbortMidwayEndsTheWork)
{
  auto image = NoisyStep(80, 80, 60, 5);
  vtkNew<vtkAnisotropicDiffusionPrefilter> filter;
  ExampleImages::Errors errors(filter);
  filter->SetInputData(image);
  filter->SetNumberOfIterations(10);
  filter->SetGradientScale(5);
  const FlipFree::ProgressWatch watch(filter, 0.07); // after the preparations
  filter->Update();
  EXPECT_GT(watch.Reports, 3);
  EXPECT_LT(watch.ProgressOfAbort, 0.2);
  EXPECT_TRUE(watch.StoppedSoon());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors.Count(), 0);
}

} // namespace
