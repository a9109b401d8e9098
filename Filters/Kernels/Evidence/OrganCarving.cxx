#include "Evidence/OrganCarving.h"

#include "Evidence/HalfContrastRim.h"
#include "Evidence/HollowCarving.h"
#include "Evidence/OrganCut.h"
#include "Image/NoData.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

constexpr int CarvingRounds = 2;
// Of the candidate. Where the first cut makes it smaller by less, a second one, and a second move
// of the boundary, hardly change anything.
constexpr double LeastCut = 0.02;

} // namespace

VoxelBox CarvingBox(const BitMask& candidate, const SeedSphere& seed)
{
  const ImageGeometry& geometry = candidate.GetGeometry();
  return candidate.Bounds()
    .Joined(BoxAround(geometry, seed.Center, seed.Radius))
    .Widened(RimReachOf(geometry, CarvingRounds), WholeBox(geometry));
}

bool CarveOrgan(const ImageView<float>& smooth, const BitMask& candidate, const BitMask* supported,
  const SeedSphere& seed, double noise, Modality modality, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, std::vector<DoubtfulPart>* doubts)
{
  const VoxelBox box = CarvingBox(candidate, seed);
  BitMask mask = candidate.Cropped(box);
  OrganCutSettings settings;
  settings.FindsDoubts = doubts != nullptr;
  OrganCutState state;
  if (supported)
  {
    state.Supported = supported->Cropped(box);
  }
  RemoveNoData(ReaderOf(smooth, box.Begin), parallelFor, mask);
  const ImagePart part{ smooth, box.Begin };
  double done = 0;
  const Monitor proceed = [&](double) { return monitor(done / (2 * CarvingRounds + 1)); };
  bool isSettled = false;
  for (int round = 0; round < CarvingRounds && !isSettled; ++round)
  {
    const auto before = static_cast<double>(mask.Count());
    if (!CutOrgan(part, seed, noise, modality, settings, parallelFor, proceed, mask, state))
    {
      return false;
    }
    isSettled = static_cast<double>(mask.Count()) > (1 - LeastCut) * before;
    state.Supported = BitMask(); // what is left is what the cut has chosen
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
  if (doubts)
  {
    doubts->insert(doubts->end(), state.Doubts.begin(), state.Doubts.end());
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
