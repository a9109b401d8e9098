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
  P(Radius, double, S Path.Radius, 0, 100, "MM",                                                   \
    "The vessel's approximate radius, up to 100; 0: found in the volume")                          \
  P(WallThickness, double, S Path.WallThickness, -5, 5, "MM",                                      \
    "Added to the outline, which gray values show without the vessel's wall, -5 to 5; less "       \
    "than 0 makes the vessel thinner, of which 0.5 mm must remain")                                \
  P(Modality, FlipFree::Modality, S Path.Modality, 0, 2, "N",                                      \
    "Scale of the gray values, by which the contrast across the outline is judged; 0: "            \
    "automatic, 1: CT, 2: MR")

#define FLIPFREE_VESSEL_SURFACE_PARAMETERS(P, S)                                                   \
  P(Levels, int, S Levels, 1, 4, "N", "Levels from coarse to fine")                                \
  P(MaximumIterations, int, S MaximumIterations, 0, 1000, "N",                                     \
    "Maximum number of iterations at each level")                                                  \
  P(LabelValue, int, S LabelValue, 1, 255, "N", "Value of the vessel in the label map, 1 to 255")

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<VesselSegmentationSettings>& VesselParameters();

/// Throws Error, naming the first parameter that is not a finite number.
void RequireNumbers(const VesselSegmentationSettings& settings);

} // namespace FlipFree

#endif
