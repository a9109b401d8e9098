#include "Intensity/OrganCarving.h"

#include "Image/NoData.h"
#include "Intensity/HalfContrastRim.h"
#include "Intensity/HollowCarving.h"
#include "Intensity/NeckCarving.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

constexpr int CarvingRounds = 2;

} // namespace

VoxelBox CarvingBox(const ImageGeometry& geometry, const std::vector<VoxelRun>& inside,
  const SeedSphere& seed)
{
  VoxelBox box = BoxAround(geometry, seed.Center, seed.Radius);
  for (const VoxelRun& run : inside)
  {
    box = box.Joined({ { { run.Begin, run.J, run.K } }, { { run.End, run.J + 1, run.K + 1 } } });
  }
  return box.Widened(RimReachOf(geometry, CarvingRounds), WholeBox(geometry));
}

bool CarveOrgan(const ImageView<float>& smooth, const std::vector<VoxelRun>& inside,
  const SeedSphere& seed, double noise, Modality modality, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground)
{
  const VoxelBox box = CarvingBox(smooth.Geometry, inside, seed);
  const auto [i, j, k] = box.Begin;
  BitMask mask(CropGeometry(smooth.Geometry, box));
  for (const VoxelRun& run : inside)
  {
    mask.InsertRun(run.Begin - i, run.End - i, run.J - j, run.K - k);
  }
  RemoveNoData(ReaderOf(smooth, box.Begin), parallelFor, mask);
  const ImagePart part{ smooth, box.Begin };
  double done = 0;
  const Monitor proceed = [&](double) { return monitor(done / (2 * CarvingRounds + 1)); };
  for (int round = 0; round < CarvingRounds; ++round)
  {
    if (!CarveNecks(part, seed, noise, modality, parallelFor, proceed, mask))
    {
      return false;
    }
    ++done;
    if (!GrowRim(part, noise, modality, parallelFor, proceed, mask))
    {
      return false;
    }
    ++done;
  }
  if (!CarveHollows(part, modality, parallelFor, proceed, mask))
  {
    return false;
  }
  foreground = BitMask(smooth.Geometry);
  foreground.Insert(mask, box.Begin);
  return true;
}

double RadiusOf(const BitMask& foreground, const SeedSphere& seed)
{
  const double volume =
    static_cast<double>(foreground.Count()) * foreground.GetGeometry().VoxelVolume();
  return std::max<double>(seed.Radius, std::cbrt(volume * 3 / (4 * EIGEN_PI)));
}

} // namespace FlipFree
