/**
 * Obeys constraints in a foreground: where a point is on the wrong side, the part around it with
 * similar gray values changes sides, up to where a minimum cut finds an edge or a neck
 * (CorrectionCut.h).
 *
 * An inside point adds voxels, an outside point removes some, each as if it were the only one of
 * its kind, so the order of the list means nothing, and a further point takes back nothing that an
 * earlier one of its kind has mended. A point that was on the right side until others changed the
 * foreground takes back only that. If an inside point adds a part far away, a bridge connects it to
 * the rest.
 */
#ifndef FlipFreeForegroundCorrection_h
#define FlipFreeForegroundCorrection_h

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
  ImageMaker Make; ///< called before voxels are read
  double Noise;    ///< standard deviation before smoothing
  Modality Kind;   ///< not Automatic
};

/// Corrects `foreground` and keeps what is connected with the seed. Boundary points do not count
/// here. Returns false if the monitor stopped it; the foreground is then useless.
bool CorrectForeground(const ForegroundImage& image, const SeedSphere& seed,
  const ConstraintList& constraints, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& foreground);

} // namespace FlipFree

#endif
