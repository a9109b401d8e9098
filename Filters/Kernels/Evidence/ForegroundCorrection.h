/**
 * Obeys points in a foreground by one minimum cut (RegionCut.h). Each point is certain about its
 * surroundings, and proposes its side for more: an outside point for the part of the foreground in
 * which it lies, up to the neck that parts it from the seed; an inside point for the part of what
 * looks like it outside the foreground; both, where no neck parts them from the rest, for the
 * boundary around them (BoundaryShift.h). What a point proposes depends on the foreground and the
 * image, and shrinks with points of the other kind, never with those of its own. So an inside point
 * never removes a voxel, an outside point never adds one, and the order means nothing.
 */
#ifndef FlipFreeForegroundCorrection_h
#define FlipFreeForegroundCorrection_h

#include "Evidence/OtherParts.h"
#include "Evidence/TissueGrowth.h"
#include "Image/BitMask.h"
#include "Image/PointConstraint.h"
#include "Image/SmoothRegion.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// What a foreground is corrected in.
struct ForegroundImage
{
  ImageView<float> Smooth;
  VoxelReader Read;                     ///< voxels before smoothing
  ImageMaker Make;                      ///< called before smoothed voxels are read
  double Noise;                         ///< standard deviation before smoothing
  Modality Kind;                        ///< not Automatic
  const BitMask& Candidate;             ///< all that may be the organ; may have no grid
  const std::vector<OtherPart>& Others; ///< of other opinions
  TissueGrowth* Growth;                 ///< in the image; may be null
};

/// Corrects `foreground` and keeps what is connected with the seed, or with a piece that was not
/// connected with it before. Boundary points do not count here. Returns false if the monitor
/// stopped it; the foreground is then useless.
bool CorrectForeground(const ForegroundImage& image, const SeedSphere& seed,
  const ConstraintList& constraints, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& foreground);

/// Decides about the parts of other opinions whose margin is negative: the contrary is likelier, so
/// the foreground becomes what answers to questions about them would make of it, and the parts what
/// they are then, by the opposite margins. What the cut that carved the foreground has decided
/// about
/// (`decided`) stays: it knows the gray values on both sides of the neck. `others` are the image's.
/// Returns false if the monitor stopped it; the foreground is then useless.
bool DecideOtherParts(const ForegroundImage& image, const SeedSphere& seed,
  const std::vector<DoubtfulPart>& decided, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<OtherPart>& others, BitMask& foreground);

} // namespace FlipFree

#endif
