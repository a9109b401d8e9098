/**
 * The scores by name, in the order in which every front end gives them: the filter's table, the
 * fields of Python and of the browser, and the columns of files.
 */
#ifndef FlipFreeScoreColumns_h
#define FlipFreeScoreColumns_h

#include "Measures/SegmentationScores.h"

#include <string>
#include <vector>

/// Calls P(Name, unit) for each number; the name is that of its member, too.
#define FLIPFREE_SCORE_COLUMNS(P)                                                                  \
  P(Dice, "")                                                                                      \
  P(Jaccard, "")                                                                                   \
  P(RelativeVolumeDifference, "")                                                                  \
  P(ASD, "mm")                                                                                     \
  P(RMS, "mm")                                                                                     \
  P(HD95, "mm")                                                                                    \
  P(HD, "mm")                                                                                      \
  P(SegmentationVolume, "ml")                                                                      \
  P(ReferenceVolume, "ml")

namespace FlipFree
{

struct ScoreColumn
{
  const char* Name;
  const char* Unit; ///< empty for fractions
  double SegmentationScores::*Member;
};

const std::vector<ScoreColumn>& ScoreColumns();

/// What the numbers were measured on, as text; these columns follow the numbers.
struct ScoreTextColumn
{
  const char* Name;
  std::string SegmentationScores::*Member;
};

const std::vector<ScoreTextColumn>& ScoreTextColumns();

/// Calls visit(name, value) for each column, the value a number or a text.
template <typename Visit>
void ForEachScore(const SegmentationScores& scores, const Visit& visit)
{
  for (const ScoreColumn& column : ScoreColumns())
  {
    visit(column.Name, scores.*column.Member);
  }
  for (const ScoreTextColumn& column : ScoreTextColumns())
  {
    visit(column.Name, scores.*column.Member);
  }
}

} // namespace FlipFree

#endif
