/**
 * Keeps the foreground from leaking into neighbors: thin bridges are cut by an opening, and only
 * what hangs together with the seed stays. All lengths are millimeters.
 */
#ifndef FlipFreeLeakControl_h
#define FlipFreeLeakControl_h

#include "Image/BitMask.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

struct LeakControlSettings
{
  double ClosingRadius = 1.5; ///< fills vessels and noise
  double OpeningRadius = 4;   ///< cuts bridges; what is thinner is lost
};

/// The part of the mask that survives closing, opening, and connection with the seed. With an
/// opening that leaves nothing at the seed, the opening is not applied. Returns false if the
/// monitor, asked before each pass over the mask, stopped it; the mask is then useless.
bool ControlLeaks(BitMask& mask, const SeedSphere& seed, const LeakControlSettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor);

/// The same for a seed of the voxels `sources` (offsets, ascending).
bool ControlLeaks(BitMask& mask, const std::vector<std::size_t>& sources,
  const LeakControlSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor);

/// Keeps the voxels of the mask that are connected, by faces, with one of `sources` (offsets of
/// voxels). Returns false if the monitor, asked now and then, stopped it; the mask is then as it
/// was.
bool KeepConnected(BitMask& mask, const std::vector<std::size_t>& sources, const Monitor& monitor);

} // namespace FlipFree

#endif
