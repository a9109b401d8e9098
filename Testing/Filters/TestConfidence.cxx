// What vtkFlipFreeSegmentation says of its own result: high for a clear ball, low with a warning
// for one that noise hides, none after an error.
#include "BadInput.h"

#include "vtkFieldData.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkFloatArray.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

using namespace FlipFree;

namespace
{

/// A ball of radius 28 mm in voxels of 2 mm.
vtkSmartPointer<vtkImageData> BallInNoise(double contrast, double noise)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(48, 48, 48);
  image->SetSpacing(2, 2, 2);
  image->AllocateScalars(VTK_SHORT, 1);
  std::mt19937 random(1);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    const Eigen::Vector3d point(image->GetPoint(voxel));
    const bool inside = (point - Eigen::Vector3d(47, 47, 47)).norm() < 28;
    // Nearly normal, and the same numbers with every library.
    double sum = 0;
    for (int part = 0; part < 12; ++part)
    {
      sum += random() / 4294967296.0;
    }
    image->GetPointData()->GetScalars()->SetTuple1(voxel,
      100 + (inside ? contrast : 0) + noise * (sum - 6));
  }
  return image;
}

vtkSmartPointer<vtkFlipFreeSegmentation> MakeFilter(vtkImageData* image)
{
  auto filter = vtkSmartPointer<vtkFlipFreeSegmentation>::New();
  filter->SetInputData(image);
  filter->SetSeedCenter(47, 47, 47);
  filter->SetSeedRadius(15);
  filter->SetResolution(16);
  return filter;
}

} // namespace

TEST(Confidence, IsHighWhereTheBoundaryIsClear)
{
  const auto filter = MakeFilter(BallInNoise(100, 10));
  EXPECT_EQ(filter->GetConfidence(), -1);
  std::vector<std::string> warnings;
  KeepWarnings(filter, warnings);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_TRUE(warnings.empty());
  EXPECT_GT(filter->GetConfidence(), 0.9);
  EXPECT_LE(filter->GetConfidence(), 1);

  vtkPolyData* const surface = filter->GetSurface();
  auto* const ofVertices =
    vtkFloatArray::SafeDownCast(surface->GetPointData()->GetArray("Confidence"));
  ASSERT_TRUE(ofVertices);
  ASSERT_EQ(ofVertices->GetNumberOfTuples(), surface->GetNumberOfPoints());
  const auto [least, greatest] = std::minmax_element(ofVertices->GetPointer(0),
    ofVertices->GetPointer(0) + ofVertices->GetNumberOfTuples());
  EXPECT_GT(*least, 0.5);
  EXPECT_LE(*greatest, 1);
  EXPECT_EQ(surface->GetFieldData()->GetArray("Confidence")->GetTuple1(0), filter->GetConfidence());
}

TEST(Confidence, IsLowAndSaidWhereNoiseHidesTheBoundary)
{
  const auto filter = MakeFilter(BallInNoise(60, 25));
  std::vector<std::string> warnings;
  KeepWarnings(filter, warnings);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_LT(filter->GetConfidence(), 0.85);
  ASSERT_FALSE(warnings.empty()); // it may go on to parts
  EXPECT_NE(warnings[0].find("The result is doubtful: its confidence is 0."), std::string::npos)
    << warnings[0];
  EXPECT_NE(warnings[0].find("below 0.85"), std::string::npos) << warnings[0];

  // After an error there is none.
  filter->SetSeedCenter(500, 0, 0);
  EXPECT_NE(ErrorOfUpdate(filter), "0 errors");
  EXPECT_EQ(filter->GetConfidence(), -1);
}

TEST(Confidence, OfThePresetsWithoutCarvingWarnsOfNothing)
{
  const auto filter = MakeFilter(BallInNoise(60, 25));
  filter->UsePublishedParameters();
  std::vector<std::string> warnings;
  KeepWarnings(filter, warnings);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  EXPECT_GE(filter->GetConfidence(), 0);
  for (const std::string& warning : warnings)
  {
    EXPECT_EQ(warning.find("doubtful"), std::string::npos) << warning;
  }
}
