/**
 * Keeps the foreground from leaking into neighbors: thin bridges are cut by an opening, and only
 * what is connected to the seed is kept. Lengths are in millimeters unless they say otherwise.
 */
#ifndef FlipFreeLeakControl_h
#define FlipFreeLeakControl_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/BitMask.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

struct LeakControlSettings
{
  /// Millimeters, at most two voxels; fills vessels and noise.
  double ClosingRadius = 1.5;

  /// In seed radii, clamped to 2.5 to 6 mm and then to at most two voxels. Cuts bridges; structures
  /// thinner than the ball are lost. Zero: no opening.
  double OpeningScale = 0.4;
};

/// Radii of the balls, in millimeters.
struct LeakControlRadii
{
  double Closing = 0;
  double Opening = 0;
};

/// The radii that the settings mean for a seed and a grid.
LeakControlRadii RadiiOf(const LeakControlSettings& settings, double seedRadius,
  const ImageGeometry& geometry);

/// The part of the mask that survives closing, opening, and connection with the seed. With an
/// opening that leaves nothing at the seed, the opening is not applied. Returns false if the
/// monitor, asked before each pass over the mask, stopped it; the mask is then useless.
bool ControlLeaks(BitMask& mask, const SeedSphere& seed, const LeakControlRadii& radii,
  const ParallelFor& parallelFor, const Monitor& monitor);

/// The same for a seed of the voxels `sources` (offsets, ascending).
bool ControlLeaks(BitMask& mask, const std::vector<std::size_t>& sources,
  const LeakControlRadii& radii, const ParallelFor& parallelFor, const Monitor& monitor);

/// Keeps the voxels of the mask that are connected, by faces, with one of `sources` (offsets of
/// voxels). Returns false if the monitor, asked now and then, stopped it; the mask is then as it
/// was.
bool KeepConnected(BitMask& mask, const std::vector<std::size_t>& sources, const Monitor& monitor);

/// Fills the holes of a mask: what is not connected, by faces, with the sides of its grid. Returns
/// false if the monitor stopped it; the mask is then as it was.
bool FillHoles(BitMask& mask, const Monitor& monitor);

/// Removes the voxels without data from a foreground on the grid of the voxels that `read` reads,
/// and what only they connect with the seed; holes of them are filled, as others are. Returns false
/// if the monitor stopped it; the foreground is then useless.
bool CutAtNoData(const VoxelReader& read, const SeedSphere& seed, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground);

} // namespace FlipFree

#endif
