// Organs of real volumes. Two that touch, segmented together: exactly no contact, no voxel in both.
// One that a point corrects: far from the point, and from what is connected with it, nothing moves.
#include "ContourMeshAdapter.h"
#include "Deformation/StartMask.h"
#include "ExampleImages.h"
#include "Geometry/DistanceQuery.h"
#include "Geometry/SelfIntersection.h"
#include "Image/PointConstraint.h"
#include "ImageAdapter.h"
#include "LabelAdapter.h"
#include "Mesh/MeshUnion.h"
#include "Mesh/SurfaceVoxelization.h"

#include "vtkFlipFreeOrganGroup.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkMedicalImageReader.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace FlipFree;

namespace
{

struct ClickedOrgan
{
  const char* Image;
  const char* Labels;
  int Label;
  double Seed[4]; ///< center and radius
};

std::string RealFile(const char* name)
{
  const char* const folder = std::getenv("FLIPFREE_DATA_DIR");
  return std::string(folder ? folder : "") + "/" + name;
}

vtkSmartPointer<vtkImageData> ReadRealFile(const char* name)
{
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(RealFile(name).c_str());
  reader->Update();
  return reader->GetOutput();
}

BitMask Without(BitMask mask, const BitMask& other)
{
  mask.Remove(other);
  return mask;
}

/// What a user clicks next: the middle of the thickest error.
PointConstraint NextClickOn(const BitMask& found, const BitMask& reference)
{
  const SeedSphere missed = LargestBallIn(Without(reference, found), "what was missed", SMPFor);
  const SeedSphere tooMuch = LargestBallIn(Without(found, reference), "what is too much", SMPFor);
  return missed.Radius > tooMuch.Radius
    ? PointConstraint{ ConstraintKind::Inside, missed.Center, 0 }
    : PointConstraint{ ConstraintKind::Outside, tooMuch.Center, 0 };
}

/// Of the voxels that have changed, those that hang together with ones within a ball, and their
/// neighbors.
std::vector<bool> MendedPlace(const BitMask& before, const BitMask& after, const SeedSphere& ball)
{
  const ImageGeometry& geometry = before.GetGeometry();
  const auto& size = geometry.Dimensions;
  std::vector<bool> mended(geometry.NumberOfVoxels());
  std::vector<std::array<int, 3>> open;
  const auto hasChanged = [&](int i, int j, int k)
  { return before(i, j, k) != after(i, j, k); };
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        if (hasChanged(i, j, k) &&
          (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - ball.Center).norm() <= ball.Radius)
        {
          open.push_back({ { i, j, k } });
        }
      }
    }
  }
  while (!open.empty())
  {
    const auto [x, y, z] = open.back();
    open.pop_back();
    for (int k = std::max(0, z - 1); k <= std::min(size[2] - 1, z + 1); ++k)
    {
      for (int j = std::max(0, y - 1); j <= std::min(size[1] - 1, y + 1); ++j)
      {
        for (int i = std::max(0, x - 1); i <= std::min(size[0] - 1, x + 1); ++i)
        {
          const std::size_t voxel = geometry.Offset(i, j, k);
          if (!mended[voxel])
          {
            mended[voxel] = true;
            if (hasChanged(i, j, k))
            {
              open.push_back({ { i, j, k } });
            }
          }
        }
      }
    }
  }
  return mended;
}

class TestRealClicks : public testing::TestWithParam<ClickedOrgan>
{
};

} // namespace

TEST_P(TestRealClicks, AreLocal)
{
  const ClickedOrgan& organ = GetParam();
  if (!std::filesystem::exists(RealFile(organ.Image)))
  {
    GTEST_SKIP() << "'" << RealFile(organ.Image) << "' does not exist; FLIPFREE_DATA_DIR names the "
                 << "folder with the real volumes.";
  }
  const auto labels = ReadRealFile(organ.Labels);
  const BitMask reference = MaskOf(labels, organ.Label, "the reference");
  vtkNew<vtkFlipFreeSegmentation> filter;
  filter->SetInputData(ReadRealFile(organ.Image));
  filter->SetSeedCenter(organ.Seed[0], organ.Seed[1], organ.Seed[2]);
  filter->SetSeedRadius(organ.Seed[3]);
  filter->SetKeepForCorrections(true);
  filter->Update();
  const DeformableSurface before = DeformableSurfaceOf(filter->GetSurface(), "it", false);
  const BitMask voxelsBefore = MaskOf(filter->GetLabelMap(), 1, "it");

  const PointConstraint click = NextClickOn(voxelsBefore, reference);
  const Eigen::Vector3d& at = click.Point;
  (filter.Get()
      ->*(click.Kind == ConstraintKind::Inside ? &vtkFlipFreeSegmentation::AddInsidePoint : &vtkFlipFreeSegmentation::AddOutsidePoint))(
    at[0], at[1], at[2]);
  filter->Update();
  const DeformableSurface after = DeformableSurfaceOf(filter->GetSurface(), "it", false);
  const BitMask voxelsAfter = MaskOf(filter->GetLabelMap(), 1, "it");
  ASSERT_NE(voxelsAfter, voxelsBefore);

  const DistanceQuery surface(before.Points, before.Mesh.Triangles);
  const Eigen::VectorXd moved = surface.DistancesOf(after.Points);
  const double reach = std::max(30.0, 2 * surface.DistancesOf(PointList(at.transpose()))[0]);
  const std::vector<bool> mended = MendedPlace(voxelsBefore, voxelsAfter, { at, reach });
  const ImageGeometry& geometry = voxelsBefore.GetGeometry();
  double sum = 0;
  int far = 0;
  int elsewhere = 0;
  for (Eigen::Index vertex = 0; vertex < after.Points.rows(); ++vertex)
  {
    const Eigen::Vector3d point = after.Points.row(vertex).transpose();
    if ((point - at).norm() > reach)
    {
      ++far;
      const Eigen::Vector3i voxel = geometry.ToIndex(point).array().round().cast<int>();
      if (!mended[geometry.Offset(voxel[0], voxel[1], voxel[2])])
      {
        ++elsewhere;
        sum += moved[vertex];
      }
    }
  }
  std::cout << NameOf(click) << " moves " << elsewhere << " of " << far << " vertices beyond "
            << reach << " mm by " << sum / elsewhere << " mm in the mean\n";
  ASSERT_GT(far, 500);
  EXPECT_GT(elsewhere, far / 2); // or nothing would be tested
  EXPECT_LT(sum / elsewhere, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Organs, TestRealClicks,
  testing::Values(ClickedOrgan{ "abdomen3mm_ct.nii.gz", "abdomen3mm_lab.nii.gz", 5,
                    { -98.04, -164.32, 394.30, 23.57 } },
    ClickedOrgan{ "abdomen01_ct.nii.gz", "abdomen01_lab.nii.gz", 6,
      { 83.24, -153.87, 321.00, 25.68 } },
    ClickedOrgan{ "chaos01_mr.nii.gz", "chaos01_labels.nii.gz", 1,
      { -128.90, 38.16, 146.21, 32.72 } }));

TEST(TestRealOrgans, LiverAndRightKidneyDoNotMeet)
{
  const char* folder = std::getenv("FLIPFREE_DATA_DIR");
  const std::string name = std::string(folder ? folder : "") + "/btcv15_ct.nii.gz";
  if (!std::filesystem::exists(name))
  {
    GTEST_SKIP() << "'" << name << "' does not exist; FLIPFREE_DATA_DIR names the folder with the "
                 << "real volumes.";
  }
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  vtkNew<vtkFlipFreeOrganGroup> group;
  group->SetInputConnection(reader->GetOutputPort());
  group->AddOrgan("liver", 94.10, -160.92, 385, 23.11);
  group->AddOrgan("right kidney", 95.46, -169.11, 255, 10.15);
  group->Update();
  ContourMesh mesh;
  PointList points(0, 3);
  for (int organ = 0; organ < 2; ++organ)
  {
    ASSERT_TRUE(group->GetSurface(organ));
    const DeformableSurface surface =
      DeformableSurfaceOf(group->GetSurface(organ), "the surface", true);
    AppendMesh(surface.Mesh, mesh);
    AppendPoints(surface.Points, points);
  }
  EXPECT_EQ(points.rows(), 2 * 6144);
  EXPECT_EQ(CountSelfIntersections(points, mesh.Faces), 0);
  // What the surfaces hold one by one is what the label map holds: nothing twice.
  std::size_t voxels = 0;
  for (int organ = 0; organ < 2; ++organ)
  {
    const DeformableSurface surface =
      DeformableSurfaceOf(group->GetSurface(organ), "the surface", true);
    voxels += CountVoxels(
      VoxelizeSurface(surface.Points, surface.Mesh.Triangles, GeometryOf(reader->GetOutput())));
  }
  std::size_t labeled = 0;
  auto* const labels = group->GetLabelMap();
  const auto* const values = static_cast<const unsigned char*>(labels->GetScalarPointer());
  for (vtkIdType voxel = 0; voxel < labels->GetNumberOfPoints(); ++voxel)
  {
    labeled += values[voxel] != 0 ? 1 : 0;
  }
  EXPECT_EQ(labeled, voxels);
}
