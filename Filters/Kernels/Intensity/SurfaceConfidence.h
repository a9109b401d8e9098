/**
 * How far a surface can be trusted, from the image and from the way it was found. Three evidences:
 *
 * Clearness: 2 to 6 mm inside and outside, the gray values, not smoothed, differ by more than those
 * inside spread. A leak into tissue of the same kind is not clear; neither is a boundary in noise.
 *
 * Agreement: the second run, on the carved foreground, ends where the first one did. Where carving
 * has moved the surface by much of the organ's size, one of the two was wrong, and often both.
 *
 * Span: the vertices' root mean square distance from the seed's center, in radii of a ball of the
 * same volume. A surface that has leaked reaches far for its volume.
 *
 * The surface's confidence is a logistic function of the three, fitted to Dice scores. A vertex has
 * the product of its contrast, pooled over its neighbors and theirs, and of its agreement.
 *
 * Nine numbers (four weights and five scales; see the source) were chosen on 98 organs of 26
 * volumes (three data sets and single ones, CT and MR), and rounded. Over all of them the area
 * under the ROC curve for a Dice below 0.85 is 0.93 (CT 0.97, MR 0.87; halves of the volumes 0.94
 * and 0.90), and 24 of 28 such results are below the threshold, and 9 of 70 others. These numbers
 * are optimistic: weights fitted to one half gave about 0.90 and 0.95 on the other, but the scales,
 * the evidences and the threshold were chosen on both. Of the vertices of a surface, those within 3
 * mm of the reference have the higher confidence in 76 % of all pairs with one that is not.
 */
#ifndef FlipFreeSurfaceConfidence_h
#define FlipFreeSurfaceConfidence_h

#include "Image/AnisotropicDiffusion.h"
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

/// `read` reads the image before smoothing; `seed` is the seed sphere's center. `shifts` are the
/// distances of the vertices from the surface that the first run ended with, in millimeters; empty
/// if there was none, and then nothing disagrees. The result depends neither on the unit of gray
/// values nor on which side is brighter.
SurfaceConfidence JudgeSurface(const VoxelReader& read, const ImageGeometry& geometry,
  const ContourMesh& mesh, const PointList& points, const Eigen::Vector3d& seed,
  const Eigen::VectorXd& shifts, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
