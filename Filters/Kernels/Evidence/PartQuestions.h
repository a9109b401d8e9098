/**
 * What is worth asking a user: "Is this part of the organ?" Of the parts that might have been
 * decided otherwise (DoubtfulPart.h), those where an answer is worth most. Yes is an inside point
 * at the part's place, no an outside point.
 *
 * Two parts at the same place are one: later rounds of the cut find the same part again, and know
 * more. An inside point, an outside point or a further seed in the neighborhood has answered a
 * part.
 *
 * Parts are sorted by what an answer is worth, the square root of their volume times their doubt:
 * with the volume itself, first questions were about large parts that are hardly in doubt. Doubt
 * is the chance that the contrary is true, 1 / (1 + exp(margin / MarginScale)). A cut's costs are
 * logarithms of likelihoods, so the difference of two is the logarithm of the odds, up to a scale:
 * without any margin, the odds are even. Of the parts that were cut off at first in 115 organs, 4
 * of 11 below a margin of 2.1 were decided wrongly, and 3 of 39 above. The scale follows these:
 * 0.35 at half of 2.1, 0.08 at twice.
 */
#ifndef FlipFreePartQuestions_h
#define FlipFreePartQuestions_h

#include "Evidence/DoubtfulPart.h"
#include "Image/PointConstraint.h"
#include "Mesh/SurfaceVoxelization.h"
#include "TableColumn.h"

#include <cstddef>
#include <vector>

namespace FlipFree
{

struct QuestionSettings
{
  double MarginScale = DoubtfulPart::MarginScale; ///< per mm3, as margins
  std::size_t Most = 5;
};

/// The questions, the most important first: `doubts` in the order of the rounds, without parts that
/// the constraints have answered. The voxels are those inside the surface; they say what is
/// included. Places become centers of the image's voxels.
std::vector<DoubtfulPart> QuestionsOf(const std::vector<DoubtfulPart>& doubts,
  const ConstraintList& constraints, const std::vector<VoxelRun>& voxels,
  const ImageGeometry& image, const QuestionSettings& settings = {});

/// The columns of a table of questions: x, y, z (mm), volume_ml, included (0 or 1), margin.
const std::vector<TableColumn<DoubtfulPart>>& QuestionColumns();

} // namespace FlipFree

#endif
