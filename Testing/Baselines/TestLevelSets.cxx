// The rim of the level set: so many millimetres at any spacing.
#include "vtkLevelSetSegmentation.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace
{

struct Grid
{
  double Spacing[3];
  double Ball; // radius in millimetres
};

void PrintTo(const Grid& grid, std::ostream* stream)
{
  *stream << grid.Spacing[0] << " x " << grid.Spacing[1] << " x " << grid.Spacing[2] << " mm";
}

class LevelSetRim : public testing::TestWithParam<Grid>
{
protected:
  // A ball of 100 in -100, whose centre is the origin.
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

TEST_P(LevelSetRim, IsSoManyMillimetres)
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

INSTANTIATE_TEST_SUITE_P(Baselines, LevelSetRim,
  testing::Values(Grid{ { 0.3, 0.3, 0.3 }, 6 }, Grid{ { 0.7, 0.7, 2 }, 12 },
    Grid{ { 2, 2, 2 }, 20 }));
