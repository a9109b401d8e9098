/**
 * The parameters of scores that users set, by name: where each stands in the settings, and its
 * range; see SegmentationParameters.h. S is the expression before the fields of ScoreSettings.
 */
#ifndef FlipFreeScoreParameters_h
#define FlipFreeScoreParameters_h

#include "Measures/SegmentationScores.h"
#include "ParameterTable.h"

#include <limits>

// Fields cannot be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)

#define FLIPFREE_SCORE_PARAMETERS(P, S)                                                            \
  P(SegmentationLabel, int, S SegmentationLabel, std::numeric_limits<int>::min(),                  \
    std::numeric_limits<int>::max(), "N",                                                          \
    "Value of the segmentation's voxels that count as inside; negative: every value but 0; not "   \
    "used for a surface")                                                                          \
  P(ReferenceLabel, int, S ReferenceLabel, std::numeric_limits<int>::min(),                        \
    std::numeric_limits<int>::max(), "N",                                                          \
    "Value of the reference's voxels that count as inside; negative: every value but 0")           \
  P(SampleSpacing, double, S SampleSpacing, 0.001, 1000, "MM",                                     \
    "Greatest distance between neighboring samples of a surface")                                  \
  P(LabelSmoothing, int, S LabelSmoothing, 0, 100, "N",                                            \
    "Iterations of smoothing that the surfaces of label maps get")                                 \
  P(ScoreVoxelization, bool, S ScoreVoxelization, false, true, "",                                 \
    "Distances are those of the voxelized surface, not of the surface itself")

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<ScoreSettings>& ScoreParameters();

} // namespace FlipFree

#endif
