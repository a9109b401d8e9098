/**
 * What people read of scores and of a surface's validity, a line for each.
 */
#ifndef FlipFreeScoreSummary_h
#define FlipFreeScoreSummary_h

#include "Measures/SegmentationScores.h"
#include "Measures/SurfaceValidity.h"

#include <string>

namespace FlipFree
{

std::string SummaryOf(const SegmentationScores& scores);
std::string SummaryOf(const SurfaceValidity& validity);

} // namespace FlipFree

#endif
