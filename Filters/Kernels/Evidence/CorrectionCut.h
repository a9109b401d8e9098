/**
 * What inside and outside points change in a mask, by one minimum cut (RegionCut.h) of what may
 * change; all else stays.
 *
 * A point is certain about its surroundings. It proposes its side for what looks alike around it
 * (PointWorth.h), and, where it lies on top of a part that necks separate from the rest
 * (NestedParts.h), for all of that part: an outside point in the depth of the mask, an inside point
 * in the depth of what might belong to the organ but is not in the mask. A part behind a wide neck
 * stays, though, if the image shows that it is the organ's own (SeveredParts.h). Where no neck
 * parts an outside point in the depth of the mask from the organ, all that is nearer to it than to
 * the organ may leave. An inside point in the depth of what was not expected in the organ proposes
 * the part around it of what grows from there (TissueGrowth.h). Where a point lies at the place of
 * a part about which another opinion disagrees (OtherParts.h), that part is proposed as a whole; so
 * it is where an outside point as deep as the organ lies in one that does not hold the seed. What a
 * point proposes depends on the mask and the image, and gets less by points of the other kind,
 * never by those of its own. So a further inside point can only add, a further outside point only
 * remove, and their order means nothing: minimum cuts are monotone in their terminals.
 */
#ifndef FlipFreeCorrectionCut_h
#define FlipFreeCorrectionCut_h

#include "Evidence/OtherParts.h"
#include "Evidence/PointCorrection.h"
#include "Image/BitMask.h"
#include "Image/BlockGrid.h"
#include "Image/ImagePart.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"

#include <array>

namespace FlipFree
{

/// What a mask is corrected by; all of it is on the grid of the part.
struct CorrectionEvidence
{
  ImagePart Image;                      ///< smoothed
  BitMask Before;                       ///< the mask
  BitMask Candidate;                    ///< all that may be the organ; may have no grid
  const std::vector<OtherPart>& Others; ///< their boxes are in the image, not in the part
  SeedSphere Seed;
  double Noise;  ///< standard deviation before smoothing
  Modality Kind; ///< not Automatic
};

/// The blocks of the cut. A part of a mask has the same blocks if it holds all of its voxels and
/// begins with a block.
BlockGrid CorrectionGrid(const BitMask& mask, const SeedSphere& seed);

/// The voxels that change, those that leave the mask first, then those that enter it. Returns false
/// if the monitor stopped it.
bool CutCorrections(const CorrectionEvidence& evidence,
  const std::vector<PointCorrection>& corrections, const ParallelFor& parallelFor,
  const Monitor& monitor, std::array<BitMask, 2>& changed);

} // namespace FlipFree

#endif
