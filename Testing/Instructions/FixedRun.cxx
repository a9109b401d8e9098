// A small segmentation that is the same each time, on one thread and by the kernels alone, for
// callgrind to count its instructions. Prints what came out, so that a count can be told to be that
// of the same work.
#include "PhantomScan.h"

#include "AnisotropicDiffusion.h"
#include "OrganSegmentation.h"
#include "QuadSphere.h"
#include "SurfaceDistance.h"
#include "SurfaceVoxelisation.h"
#include "VoxelOverlap.h"

#include <cstdio>

using namespace FlipFree;

int main()
{
  const PhantomScan scan = ScanAbdomen({ { 110, 85, 90 } }, { 3, 3, 3 }, 1, SerialFor);
  FloatImage image = CropToFloat(ImageView<std::int16_t>{ scan.Voxels.data(), scan.Geometry },
    ReachableExtent(scan.Geometry, scan.Seed.Center, LiverReach), SerialFor);
  const double noise = NoiseDeviation(image.View(), scan.Seed);
  AnisotropicDiffusionSettings diffusion;
  diffusion.Contrast = ContrastOfNoise(noise);
  DiffuseAnisotropically(image.Voxels, image.Geometry, diffusion, SerialFor, NeverStop);

  OrganSegmentationSettings settings = LiverSettings(scan);
  settings.Levels = 2;
  settings.MaximumIterations = 8;
  settings.ChangeTolerance = -1; // as many iterations, whatever the last digits are
  settings.DistanceTolerance = 0;
  const QuadSphere sphere =
    MakeQuadSphere(8, scan.Seed.Center, scan.Seed.Radius, QuadSphereSpacing::Equiangular);
  const ContourMesh mesh = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
  const OrganSurface liver = SegmentOrgan(image.View(), noise, scan.Seed, mesh, sphere.Points,
    settings, SerialFor, NeverStop,
    [](const ContourMesh&, const PointList&, const CorrespondenceField&, const IterationRecord&) {
    });

  std::vector<unsigned char> labels(scan.Geometry.NumberOfVoxels(), 0);
  FillRuns(VoxeliseSurface(liver.Points, liver.Mesh.Triangles, scan.Geometry, SerialFor), 1,
    scan.Geometry, labels.data());
  std::vector<unsigned char> truth(scan.Labels.size());
  for (std::size_t voxel = 0; voxel < truth.size(); ++voxel)
  {
    truth[voxel] = scan.Labels[voxel] == scan.Label;
  }
  const VoxelOverlap overlap =
    MeasureOverlap({ labels.data(), scan.Geometry }, { truth.data(), scan.Geometry }, SerialFor);
  const SurfaceDistance distance =
    MeasureSurfaceDistance(liver.Points, liver.Mesh.Triangles, sphere.Points, mesh.Triangles, 1);
  std::printf("%zu iterations, Dice %.2f, %.0f mm from the seed\n", liver.Iterations.size(),
    overlap.Dice(), distance.Average);
  return 0;
}
