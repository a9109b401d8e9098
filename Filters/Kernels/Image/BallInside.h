/**
 * How deep a shape is at a seed: the largest ball around the seed that the shape contains.
 */
#ifndef FlipFreeBallInside_h
#define FlipFreeBallInside_h

#include "Image/BitMask.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

/// The ball about the seed's center up to the nearest voxel center outside the mask, but never
/// smaller than the seed. A mask that fills its grid, or holds nothing at the center, gives the
/// seed.
SeedSphere BallInside(const BitMask& mask, const SeedSphere& seed);

} // namespace FlipFree

#endif
