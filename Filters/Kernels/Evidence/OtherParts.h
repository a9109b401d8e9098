/**
 * The parts about which other opinions of an organ disagree with its foreground. As a whole, a mask
 * that is found in another way, such as by a narrower interval of gray values, is mostly worse. But
 * where it differs by a deep part, one of the two is wrong about all of that part. The same may be
 * true of a part of the foreground behind a wide neck, which all opinions hold: an organ that is
 * as bright, and joined. How well the image supports the boundary with and without the part
 * (BoundarySupport.h), and how deep the part is, tell how likely that is. These parts are worth
 * asking about (PartQuestions.h), and are what a point at the place of one means (CorrectionCut.h).
 */
#ifndef FlipFreeOtherParts_h
#define FlipFreeOtherParts_h

#include "Evidence/DoubtfulPart.h"
#include "Image/MaskPart.h"
#include "Image/SeedRegion.h"
#include "Intensity/OrganFeature.h"

#include <vector>

namespace FlipFree
{

struct OtherPart : MaskPart
{
  DoubtfulPart Doubt;
};

/// Finds the parts by which opinions, on the grid of the foreground and of the image, differ from
/// it, and further ones, which are grown from the seed on blocks and carved; and parts of the
/// foreground itself behind necks. An opinion may be worse than the foreground in all else. Parts
/// have at least 2 % of the foreground's volume, those behind its necks 15 %; the surest are left
/// out, and the others sorted, the most doubtful first. Only the voxels in ConsensusBox() need to
/// have values. `noise` is the standard deviation before smoothing; the settings' modality is not
/// Automatic; `ofSeed` is the seed's (FitToSeed()). Returns false if the monitor, asked before each
/// pass over the image, stopped it; there are then no parts.
bool FindOtherParts(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const OrganFeatureSettings& settings, const IntensityModel& ofSeed, const BitMask& foreground,
  const std::vector<BitMask>& opinions, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<OtherPart>& parts);

} // namespace FlipFree

#endif
