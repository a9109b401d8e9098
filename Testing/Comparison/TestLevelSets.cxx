// The rim of the level set: so many millimeters at any spacing, and up to the image's end; and an
// abort while it is made.
#include "ProgressWatch.h"
#include "vtkLevelSetSegmentation.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace
{

struct VoxelGrid
{
  double Spacing[3];
  double Ball; // radius in millimeters
};

void PrintTo(const VoxelGrid& grid, std::ostream* stream)
{
  *stream << grid.Spacing[0] << " x " << grid.Spacing[1] << " x " << grid.Spacing[2] << " mm";
}

class LevelSetRim : public testing::TestWithParam<VoxelGrid>
{
protected:
  // A ball of 100 in -100, whose center is the origin.
  void SetUp() override
  {
    vtkNew<vtkImageData> image;
    int half[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      half[axis] = static_cast<int>(std::ceil((GetParam().Ball + 6) / GetParam().Spacing[axis]));
    }
    image->SetExtent(-half[0], half[0], -half[1], half[1], -half[2], half[2]);
    image->SetSpacing(GetParam().Spacing);
    image->AllocateScalars(VTK_SHORT, 1);
    auto* voxels = static_cast<short*>(image->GetScalarPointer());
    for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
    {
      double point[3];
      image->GetPoint(voxel, point);
      const bool inside = std::hypot(point[0], point[1], point[2]) < GetParam().Ball;
      voxels[voxel] = inside ? 100 : -100;
    }
    this->Filter->SetInputData(image);
    this->Filter->SetSeedRadius(0.7 * GetParam().Ball);
    this->Filter->SetDiffusionIterations(0);
    this->Filter->SetCurvatureScaling(0.5);
  }
  // Of the surface's points, the mean distance from the origin.
  double RadiusWithRim(double width)
  {
    this->Filter->SetRimWidth(width);
    this->Filter->Update();
    vtkPolyData* surface = this->Filter->GetSurface();
    double sum = 0;
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      const double* point = surface->GetPoint(i);
      sum += std::hypot(point[0], point[1], point[2]);
    }
    return sum / static_cast<double>(surface->GetNumberOfPoints());
  }

  vtkNew<vtkLevelSetSegmentation> Filter;
};

} // namespace

TEST_P(LevelSetRim, IsSoManyMillimeters)
{
  const double* spacing = GetParam().Spacing;
  const double voxel = std::cbrt(spacing[0] * spacing[1] * spacing[2]);
  const double front = this->RadiusWithRim(0);
  EXPECT_NEAR(front, GetParam().Ball, voxel);
  for (const double width : { 0.6, 1.2, 3.0 })
  {
    EXPECT_NEAR(this->RadiusWithRim(width) - front, width, 0.15 * voxel + 0.05 * width) << width;
  }
}

// The front has settled then, and is being moved.
TEST_P(LevelSetRim, AnAbortWhileItIsMadeLeavesNothing)
{
  constexpr double settled = 0.1 + 0.95 * (0.95 - 0.1); // the filter's shares of the progress
  for (const double width : { 0.0, 1.2 })
  {
    this->Filter->SetRimWidth(width);
    const FlipFree::ProgressWatch watch(this->Filter, settled - 1e-9);
    this->Filter->Update();
    // Without a rim there is nothing to be told of between the front and the end.
    EXPECT_EQ(this->Filter->GetSurface()->GetNumberOfPoints() == 0, width > 0) << width;
    EXPECT_EQ(this->Filter->GetLabelMap()->GetNumberOfPoints() == 0, width > 0) << width;
    EXPECT_TRUE(watch.StoppedSoon());
  }
  this->Filter->Modified();
  this->Filter->Update();
  EXPECT_GT(this->Filter->GetSurface()->GetNumberOfPoints(), 0);
}

INSTANTIATE_TEST_SUITE_P(Baselines, LevelSetRim,
  testing::Values(VoxelGrid{ { 0.3, 0.3, 0.3 }, 6 }, VoxelGrid{ { 0.7, 0.7, 2 }, 12 },
    VoxelGrid{ { 2, 2, 2 }, 20 }));

// Cut off by the image, in whose outermost voxels ITK's front lags behind: the rim is as wide up to
// there, and wider rims take more of the end.
TEST(LevelSet, HasARimUpToTheImagesEnd)
{
  constexpr double ball = 10;
  vtkNew<vtkImageData> image;
  image->SetExtent(-16, 4, -16, 16, -16, 16);
  image->AllocateScalars(VTK_SHORT, 1);
  const auto distanceOf = [&image](vtkIdType voxel)
  {
    double point[3];
    image->GetPoint(voxel, point);
    return std::hypot(point[0], point[1], point[2]);
  };
  auto* voxels = static_cast<short*>(image->GetScalarPointer());
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    voxels[voxel] = distanceOf(voxel) < ball ? 100 : -100;
  }
  vtkNew<vtkLevelSetSegmentation> filter;
  filter->SetInputData(image);
  filter->SetSeedCenter(-3, 0, 0);
  filter->SetSeedRadius(5);
  filter->SetDiffusionIterations(0);
  filter->SetCurvatureScaling(0.5);
  int before = -1; // without a rim, none
  for (const double width : { 0.0, 1.2, 3.0 })
  {
    filter->SetRimWidth(width);
    filter->Update();
    const auto* labels = static_cast<unsigned char*>(filter->GetLabelMap()->GetScalarPointer());
    int atEnd = 0;
    for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
    {
      const double distance = distanceOf(voxel);
      if (std::abs(distance - ball - width) > 1.5 && image->GetPoint(voxel)[0] < 3)
      {
        ASSERT_EQ(labels[voxel] != 0, distance < ball + width) << width << ", voxel " << voxel;
      }
      atEnd += image->GetPoint(voxel)[0] == 4 && labels[voxel] != 0;
    }
    EXPECT_GT(atEnd, before) << width;
    EXPECT_LE(atEnd, 3.15 * std::pow(ball + width + 1, 2));
    before = atEnd;
    double bounds[6];
    filter->GetSurface()->GetBounds(bounds);
    EXPECT_NEAR(bounds[0], -ball - width, 1);
    EXPECT_GE(bounds[1], width > 0 ? 4 : 3); // closed there
    EXPECT_LE(bounds[1], 5);
  }
}
