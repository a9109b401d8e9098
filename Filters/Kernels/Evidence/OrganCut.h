/**
 * Where an organ ends, by one minimum cut inside a mask that holds it and may hold more. Rules
 * propose, the cut decides (RegionCut.h). What lies behind a neck is proposed to be no part of the
 * organ. How much that weighs depends on what the image shows where a cut would go: a part whose
 * gray values go on unchanged across it, and where no edge is, is the organ's own, like the left
 * lobe of a liver; a neighbor differs (SeveredParts.h). Gray values alone hardly count: a leak
 * looks like the organ.
 */
#ifndef FlipFreeOrganCut_h
#define FlipFreeOrganCut_h

#include "Evidence/DoubtfulPart.h"
#include "Image/BitMask.h"
#include "Image/ImagePart.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"

#include <vector>

namespace FlipFree
{

struct OrganCutSettings
{
  double SourceRadius = 0.6; ///< seed radii; what of the seed is certain

  /// A neck is narrower than this fraction of the part behind it; NeckRatioOfSlender counts in
  /// organs in which no ball of SlenderRadius (mm) fits.
  double NeckRatio = 0.7;
  double NeckRatioOfSlender = 0.5;
  double SlenderRadius = 12;
  double CoreDepth = 0.6; ///< of a part's depth; what is deeper is its core

  /// What a cut costs per mm2 and millimeter of the organ's depth, of which 5 to 40 count. The
  /// smoothness wanted grows with the organ, else small organs collapse.
  double Smoothness = 0.2;

  /// What a block that nothing supports (OrganCutState) loses of its worth, per mm3.
  double UnsupportedLoss = 0.5;

  bool FindsDoubts = true; ///< each of which takes a cut
};

/// What is known beside the image, and what one cut tells the next one. On the grid of the mask.
struct OrganCutState
{
  BitMask Supported; ///< what of the mask there is more evidence for; without a grid, all
  BitMask Own;       ///< parts that were found to be the organ's own, and stay so; may have no grid
  std::vector<DoubtfulPart> Doubts; ///< what might have been decided otherwise
};

/// Adds the seed sphere to the mask, which is on the grid of the part, fills its holes, and cuts
/// it. The cut is found on blocks of at most 2.5 mm. `noise` is the standard deviation before
/// smoothing. Adds to the state's own parts and doubts. Returns false if the monitor stopped it;
/// mask and state are then useless.
bool CutOrgan(const ImagePart& image, const SeedSphere& seed, double noise, Modality modality,
  const OrganCutSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask, OrganCutState& state);

} // namespace FlipFree

#endif
