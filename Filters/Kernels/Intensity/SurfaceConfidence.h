/**
 * How far a surface can be trusted, from the image and from the way it was found. Four evidences:
 *
 * Support: 2 to 6 mm inside and outside, the gray values, pooled over a vertex' neighbors and
 * theirs, differ by more than those inside spread; its mean over the surface. A leak into tissue of
 * the same kind has none there; neither has a boundary in noise.
 *
 * Span: the vertices' root mean square distance from the seed's center, in radii of a ball of the
 * same volume. A surface that has leaked reaches far for its volume.
 *
 * Seed: the logarithm of its radius. A small seed tells little of the organ.
 *
 * Unanimity: the opinions of the consensus (OrganConsensus.h) are alike. Where one was sought and
 * there was none, little is known.
 *
 * The surface's confidence is a logistic function of the four. It reads like a Dice score: where it
 * is below 0.7, 0.85, 0.92 or above, its mean is 0.53, 0.80, 0.88 and 0.93, and the scores' mean is
 * 0.63, 0.77, 0.91 and 0.94. A vertex has the product of its support and of its agreement: the
 * second run, on the carved foreground, ends where the first one did. That the runs differ says
 * where to look, but since there is a consensus it says no more how good the whole is.
 *
 * Eight numbers (five weights and three scales; see the source) were chosen on 98 organs of 26
 * volumes (three data sets and single ones, CT and MR), on results of three levels, and rounded.
 * There the area under the ROC curve for a Dice below 0.85 was 0.96 (CT 0.98, MR 0.91), with
 * weights fitted without the volume that is judged 0.94 (CT 0.97, MR 0.91), and with seeds of half
 * the radius 0.92; but the evidences were chosen on all. On the results of four levels, the default
 * since then, which nothing was fitted to, it is 0.93 (CT 0.93, MR 0.92): 16 of 19 such results are
 * below the threshold, and 13 of 79 others.
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

/// Below it, a result is doubtful.
constexpr double DoubtfulConfidence = 0.85;

/// `read` reads the image before smoothing; `shifts` are the distances of the vertices from the
/// surface that the first run ended with, in millimeters; empty if there was none, and then nothing
/// disagrees. `unanimity` is that of the consensus (OrganConsensus.h), 1 without one. The result
/// depends neither on the unit of gray values nor on which side is brighter.
SurfaceConfidence JudgeSurface(const VoxelReader& read, const ImageGeometry& geometry,
  const ContourMesh& mesh, const PointList& points, const SeedSphere& seed,
  const Eigen::VectorXd& shifts, double unanimity, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
