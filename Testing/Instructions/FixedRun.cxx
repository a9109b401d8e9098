// A small segmentation that is the same each time, on one thread and by the kernels alone, for
// callgrind to count its instructions. Prints what came out, so that a count can be told to be that
// of the same work.
#include "PhantomScan.h"

#include "Deformation/OrganSegmentation.h"
#include "Measures/SurfaceDistance.h"
#include "Measures/VoxelOverlap.h"
#include "Mesh/QuadSphere.h"
#include "Mesh/SurfaceVoxelization.h"

#include <cstdio>

using namespace FlipFree;

int main()
{
  // A cube, since it is soon painted.
  const PhantomScan scan =
    ScanPhantom(MakePlainPhantom(PlainShape::Cube, { 192, 192, 192 }, 160, 100), 1,
      { { 80, 80, 60 } }, { 2.4, 2.4, 3.2 }, SerialFor);
  FloatImage image;
  CropToFloat(ImageView<std::int16_t>{ scan.Voxels.data(), scan.Geometry },
    BoxAround(scan.Geometry, scan.Seed.Center, OrganReach), SerialFor, image);
  const double noise = NoiseStandardDeviation(image.View(), scan.Seed);
  AnisotropicDiffusionSettings diffusion;
  diffusion.Contrast = ContrastOfNoise(noise);
  SmoothRegion region(ReaderOf(image.View()), image.Geometry, diffusion, SerialFor);
  region.Make({ { { 0, 0, 0 } }, image.Geometry.Dimensions }, NeverStop);

  OrganSegmentationSettings settings;
  settings.Schedule.Levels = 2;
  settings.Schedule.MaximumIterations = 5;
  settings.Schedule.ChangeTolerance = -1; // as many iterations, whatever the last digits are
  settings.Schedule.DistanceTolerance = 0;
  const QuadSphere sphere =
    MakeQuadSphere(8, scan.Seed.Center, scan.Seed.Radius, QuadSphereSpacing::Equiangular);
  const ContourMesh mesh = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
  PointList before;
  const OrganSurface organ =
    OrganSegmenter(region, noise, scan.Seed, { mesh, sphere.Points }, settings, SerialFor)
      .FindSurface({}, nullptr, NeverStop,
        [&before](const ContourMesh&, const PointList& points, const CorrespondenceField&,
          const IterationRecord& record)
        {
          if (record.Iteration == 6)
          {
            before = points;
          }
        });

  std::vector<unsigned char> labels(scan.Geometry.NumberOfVoxels(), 0);
  FillRuns(VoxelizeSurface(organ.Points, organ.Mesh.Triangles, scan.Geometry, SerialFor),
    static_cast<unsigned char>(1), scan.Geometry, labels.data());
  const auto maskOf = [&scan](const std::vector<unsigned char>& voxels, unsigned char label)
  {
    return VoxelsWhere(
      ImageView<unsigned char>{ voxels.data(), scan.Geometry },
      [label](unsigned char value) { return value == label; }, SerialFor);
  };
  const VoxelOverlap overlap =
    MeasureOverlap(maskOf(labels, 1), maskOf(scan.Labels, scan.Label), SerialFor);
  const SurfaceDistance distance =
    MeasureSurfaceDistance(organ.Points, organ.Mesh.Triangles, before, organ.Mesh.Triangles, 2);
  std::printf("%zu iterations, Dice %.2f, %.1f mm between\n", organ.Iterations.size(),
    overlap.Dice(), distance.Average);
  return 0;
}
