#include "Measures/ScoreColumns.h"

namespace FlipFree
{

const std::vector<ScoreColumn>& ScoreColumns()
{
#define COLUMN(Name, unit) { #Name, unit, &SegmentationScores::Name },
  static const std::vector<ScoreColumn> columns{ FLIPFREE_SCORE_COLUMNS(COLUMN) };
#undef COLUMN
  return columns;
}

const std::vector<ScoreTextColumn>& ScoreTextColumns()
{
  static const std::vector<ScoreTextColumn> columns{
    { "OverlapOf", &SegmentationScores::OverlapOf },
    { "DistanceOf", &SegmentationScores::DistanceOf },
  };
  return columns;
}

} // namespace FlipFree
