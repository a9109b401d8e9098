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
    std::numeric_limits<int>::max(), "N")                                                          \
  P(ReferenceLabel, int, S ReferenceLabel, std::numeric_limits<int>::min(),                        \
    std::numeric_limits<int>::max(), "N")                                                          \
  P(SampleSpacing, double, S SampleSpacing, 0.001, 1000, "MM")                                     \
  P(LabelSmoothing, int, S LabelSmoothing, 0, 100, "N")                                            \
  P(ScoreVoxelization, bool, S ScoreVoxelization, false, true, "")

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<ScoreSettings>& ScoreParameters();

} // namespace FlipFree

#endif
