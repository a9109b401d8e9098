// How many Gaussians vtkGMMFeatureFilter models an organ by.
#include "vtkGMMFeatureFilter.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

// A ball of two tissues in fat, all as bright as in CT.
class FeatureMixture : public testing::Test
{
protected:
  void SetUp() override
  {
    constexpr int size = 40;
    constexpr double middle = 19.5;
    vtkNew<vtkImageData> image;
    image->SetDimensions(size, size, size);
    image->SetSpacing(2, 2, 2);
    image->AllocateScalars(VTK_FLOAT, 1);
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, 4);
    for (int k = 0; k < size; ++k)
    {
      for (int j = 0; j < size; ++j)
      {
        for (int i = 0; i < size; ++i)
        {
          const bool isInside = std::hypot(i - middle, j - middle, k - middle) < 14;
          const float tissue = i < size / 2 ? 60 : 120;
          *static_cast<float*>(image->GetScalarPointer(i, j, k)) =
            (isInside ? tissue : -100) + noise(random);
        }
      }
    }
    this->Filter->SetInputData(image);
    this->Filter->SetSeedCenter(39, 39, 39);
    this->Filter->SetSeedRadius(20);
  }

  vtkIdType NumberOfGaussians()
  {
    this->Filter->Update();
    vtkDataArray* const weights =
      this->Filter->GetOutput()->GetFieldData()->GetArray("MixtureWeights");
    return weights ? weights->GetNumberOfValues() : 0;
  }

  vtkNew<vtkGMMFeatureFilter> Filter;
};

} // namespace

TEST_F(FeatureMixture, IsOneGaussianInCT)
{
  EXPECT_EQ(this->NumberOfGaussians(), 1);
  this->Filter->SetModalityToCT();
  EXPECT_EQ(this->NumberOfGaussians(), 1);
}

TEST_F(FeatureMixture, HasSeveralInMR)
{
  this->Filter->SetModalityToMR();
  EXPECT_EQ(this->NumberOfGaussians(), 2);
}

TEST_F(FeatureMixture, HasSeveralWithoutCarving)
{
  this->Filter->CarvingOff();
  EXPECT_EQ(this->NumberOfGaussians(), 2);
}

TEST_F(FeatureMixture, HasAsManyAsTheUserAllows)
{
  this->Filter->SetMaximumComponents(3);
  EXPECT_EQ(this->NumberOfGaussians(), 2);
  this->Filter->SetMaximumComponents(1);
  this->Filter->SetModalityToMR();
  EXPECT_EQ(this->NumberOfGaussians(), 1);
}
