/**
 * The parameters of vessels that users set, by name: where each stands in the settings, and its
 * range; see SegmentationParameters.h. S is the expression before the fields of
 * VesselSegmentationSettings.
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
  P(MaximumIterations, int, S MaximumIterations, 0, 1000)                                          \
  P(LabelValue, int, S LabelValue, 1, 255)

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<VesselSegmentationSettings>& VesselParameters();

/// Throws Error, naming the first parameter that is not a finite number.
void RequireNumbers(const VesselSegmentationSettings& settings);

} // namespace FlipFree

#endif
