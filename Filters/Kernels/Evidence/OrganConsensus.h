/**
 * Further opinions about an organ whose carving changed much of the surface that it began with, and
 * which is therefore doubtful. The foreground is grown again from the carved one, under a wider
 * opening, once from the image and once from the image without the organ's intensity field. What
 * two of the three hold is supported, and one cut decides about that and what was carved
 * (OrganCut.h). An organ that has leaked beyond carving needs another start: growth from the seed
 * by narrower intervals of gray values. Where it is better on blocks (CoarseOrgan.h), it is tried,
 * and taken if the image supports its boundary clearly better.
 */
#ifndef FlipFreeOrganConsensus_h
#define FlipFreeOrganConsensus_h

#include "Evidence/OrganCarving.h"
#include "Intensity/OrganFeature.h"

namespace FlipFree
{

/// Whether the carved foreground and the inside of the surface that was carved overlap by less than
/// a Dice score of 0.92.
bool IsDoubtful(const BitMask& inside, const BitMask& carved);

/// The part of the image in which opinions are sought: 30 mm around the carved foreground and the
/// seed. The image must have values there.
VoxelBox ConsensusBox(const BitMask& carved, const SeedSphere& seed);

/// What further opinions were about; all on the grid of the image.
struct FurtherOpinions
{
  /// The carved foreground as it was, and all others, also those that do not count: a mask that is
  /// worse as a whole may still be right about a part.
  std::vector<BitMask> Carved;
  BitMask Considered; ///< what has grown
  /// The Dice score between the carved foreground and what is supported.
  double Unanimity = 1;
};

/// Replaces the carved foreground, on the grid of the image, by the consensus. A foreground that
/// fills more than thrice its volume, or more than twice and goes on beyond ConsensusBox(), is
/// about something else; without both of the two, nothing is decided, and the unanimity is 1/2.
/// `noise` is the standard deviation before smoothing; the settings' modality is not Automatic.
/// Returns false if the monitor, asked before each pass over the image, stopped it; the foreground
/// is then as it was.
bool SeekConsensus(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const OrganFeatureSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& carved, FurtherOpinions& opinions);

} // namespace FlipFree

#endif
