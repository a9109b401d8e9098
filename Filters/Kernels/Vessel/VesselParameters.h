/**
 * The parameters of vessels that users set, by name, as SegmentationParameters.h has those of
 * organs: lists from which the stages make their properties, and a table of all.
 */
#ifndef FlipFreeVesselParameters_h
#define FlipFreeVesselParameters_h

#include "ParameterTable.h"
#include "Vessel/VesselSegmentation.h"

// Fields cannot be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)

#define FLIPFREE_VESSEL_PATH_PARAMETERS(P, S)                                                      \
  P(Radius, double, S Path.Radius, 0, 100)                                                         \
  P(WallThickness, double, S Path.WallThickness, -5, 5)

#define FLIPFREE_VESSEL_SURFACE_PARAMETERS(P, S)                                                   \
  P(Levels, int, S Levels, 1, 4)                                                                   \
  P(MaximumIterations, int, S MaximumIterations, 0, 1000)

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<VesselSegmentationSettings>& VesselParameters();

/// Throws std::invalid_argument, naming the first parameter that is not a finite number.
void RequireNumbers(const VesselSegmentationSettings& settings);

} // namespace FlipFree

#endif
