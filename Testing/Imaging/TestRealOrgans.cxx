// Organs that touch in a real volume, segmented together: exactly no contact, no voxel in both.
#include "ContourMeshAdapter.h"
#include "ExampleImages.h"
#include "Geometry/SelfIntersection.h"
#include "ImageAdapter.h"
#include "Mesh/MeshUnion.h"
#include "Mesh/SurfaceVoxelization.h"

#include "vtkFlipFreeOrganGroup.h"
#include "vtkMedicalImageReader.h"
#include "vtkPolyData.h"

#include <cstdlib>

using namespace FlipFree;

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
