/**
 * How far a surface can be trusted, from the image and from the way it was found. There are four
 * pieces of evidence:
 *
 * Support: 2 to 6 mm inside and outside, the gray values, pooled over a vertex's neighbors and
 * theirs, differ by more than the spread of those inside. Its mean over the surface counts only
 * those vertices beyond which it is darker, or only those beyond which it is brighter, whichever
 * are supported better: few organs are brighter than one half of their surroundings and darker than
 * the other. A leak into tissue of the same kind has no support; neither does a boundary in noise.
 *
 * Depth: the logarithm of the greatest depth inside, relative to that of the seed's center. A
 * surface that has a deeper place elsewhere has leaked into a larger organ, or has not found all of
 * its own.
 *
 * Seed: the logarithm of its radius. A small seed says little about the organ.
 *
 * Unanimity: what grows in other ways agrees with what was carved (OrganConsensus.h). Where such
 * opinions were sought and there were none, little is known.
 *
 * The surface's confidence is a logistic function of the four. It estimates the Dice score: in the
 * ranges up to 0.7, 0.85, 0.92, and above, its mean is 0.47, 0.80, 0.89 and 0.93, and the mean of
 * the scores is 0.52, 0.78, 0.91 and 0.94. A vertex has the product of its support and of its
 * agreement: the second run, on the carved foreground, ends where the first one did. A difference
 * between the runs says where to look, but, now that there is a consensus, no longer how good the
 * surface as a whole is.
 *
 * Eight numbers (five weights and three scales; see the source) were chosen on the results of four
 * levels on 98 organs of 26 volumes (three data sets and single ones, CT and MR): by the Dice
 * scores from each organ's own seed, from one of half the radius, and for most from two at random.
 * There the area under the ROC curve for a Dice below 0.85 is 0.96 from the own seeds (CT 0.98, MR
 * 0.94), 0.93 from those of half the radius, and 0.92 from random ones. With weights fitted to one
 * half of the volumes (Testing/Benchmarks/halves.csv), it is 0.97 and 0.94 on the other half; with
 * weights fitted without the volume that is judged, 0.94. They were not chosen anew when one cut
 * took the place of a vote in the consensus, and the unanimity that of its agreement.
 *
 * Of the vertices of a surface, those within 3 mm of the reference have the higher confidence in
 * 76 % of all pairs with one that is not (three levels).
 */
#ifndef FlipFreeSurfaceConfidence_h
#define FlipFreeSurfaceConfidence_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/SeedRegion.h"
#include "Mesh/ContourMesh.h"

#include <vector>

namespace FlipFree
{

struct SurfaceConfidence
{
  std::vector<float> OfVertices; ///< 0 to 1
  double OfSurface = 0;          ///< 0 to 1; the Dice score to expect
};

/// Below it, a result is doubtful. Of surfaces that fill labels, 126 of 142 with a Dice below 0.85
/// are (labels that were moved, mirrored, widened or narrowed), and 3 of 46 above 0.9; a fifth
/// lower, 71 and 0.
constexpr double DoubtfulConfidence = 0.85;

/// What is left of the surface's confidence where the seed holds more than one tissue: a large
/// sphere then says nothing about the organ's size, and the depth of its center nothing about a
/// leak. From seeds larger than two kidneys, an aorta and a gallbladder of a phantom, the mean
/// confidence would be 0.78, and the mean Dice score is 0.20.
constexpr double ConfidenceLeftByMixedSeed = 0.25;

/// `read` reads the image before smoothing; `shifts` are the distances of the vertices from the
/// surface that the first run ended with, in millimeters; empty if there was none, and then nothing
/// disagrees. `unanimity` is that of the consensus (OrganConsensus.h), 1 without one. The result
/// depends neither on the unit of gray values nor on which side is brighter.
SurfaceConfidence JudgeSurface(const VoxelReader& read, const ImageGeometry& geometry,
  const ContourMesh& mesh, const PointList& points, const SeedSphere& seed,
  const Eigen::VectorXd& shifts, double unanimity, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
