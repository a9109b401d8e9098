// Real volumes. Organs that touch, segmented together: exactly no contact, no voxel in both. Points
// that correct an organ: the surface stays where they change nothing.
#include "ContourMeshAdapter.h"
#include "Deformation/VolumeSegmentation.h"
#include "ExampleImages.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "GrayImageAdapter.h"
#include "ImageAdapter.h"
#include "Mesh/MeshUnion.h"
#include "Mesh/SurfaceVoxelization.h"
#include "RealVolume.h"
#include "SurfaceMotion.h"

#include "vtkFlipFreeOrganGroup.h"
#include "vtkMedicalImageReader.h"
#include "vtkPolyData.h"

using namespace FlipFree;

TEST(RealOrgans, LiverAndRightKidneyDoNotMeet)
{
  const std::string name = RealVolume("btcv15_ct.nii.gz");
  if (!std::filesystem::exists(name))
  {
    GTEST_SKIP() << NoRealVolume(name);
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

namespace
{

struct CorrectedOrgan
{
  std::string File;
  SeedSphere Seed;
  Eigen::Vector3d Outside; // at the boundary, in a little too much
};

} // namespace

// By no more than a fraction of a voxel. The same evidence alone left 0.26 and 0.28 mm.
TEST(RealOrgans, PointsMoveNothingFarAway)
{
  const std::vector<CorrectedOrgan> organs{
    { "btcv06_ct.nii.gz", { { 86.40, -117.82, 387.00 }, 32.08 }, { 138.763, -141.381, 381 } },
    { "chaos01_mr.nii.gz", { { -128.90, 38.16, 146.21 }, 32.72 },
      { -18.9037, -0.588715, 123.108 } },
  };
  for (const CorrectedOrgan& organ : organs)
  {
    const std::string name = RealVolume(organ.File);
    if (!std::filesystem::exists(name))
    {
      GTEST_SKIP() << NoRealVolume(name);
    }
    vtkNew<vtkMedicalImageReader> reader;
    reader->SetFileName(name.c_str());
    reader->Update();
    VolumeSegmenter segmenter(GrayVolumeOf(reader->GetOutput(), name), name, organ.Seed, nullptr,
      {}, Threading());
    const auto run = [&](const ConstraintList& points)
    {
      return segmenter
        .Segment(points, NeverStop,
          [](const ContourMesh&, const PointList&, const CorrespondenceField&,
            const IterationRecord&) {})
        .Organ;
    };
    const OrganSurface free = run({});
    const OrganSurface corrected = run({ { ConstraintKind::Outside, organ.Outside, 0 } });
    EXPECT_NE(corrected.Points, free.Points);
    EXPECT_EQ(WindingNumber(corrected.Points, corrected.Mesh.Triangles, organ.Outside), 0);
    EXPECT_LT(MotionBeyond(organ.Outside, corrected, free, 1000), 0.25) << organ.File;
    EXPECT_LT(MotionBeyond(organ.Outside, free, corrected, 1000), 0.25) << organ.File;
  }
}
