/**
 * The parameters of surfaces of labels that users set, by name: where each stands in the settings,
 * and its range; see SegmentationParameters.h. S is the expression before the fields of
 * LabelSurfaceSettings.
 */
#ifndef FlipFreeLabelSurfaceParameters_h
#define FlipFreeLabelSurfaceParameters_h

#include "LabelSurface/LabelSurfaces.h"
#include "ParameterTable.h"

// Fields cannot be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)

#define FLIPFREE_LABEL_SURFACE_PARAMETERS(P, S)                                                    \
  P(Exact, bool, S Exact, false, true, "",                                                         \
    "Keep the center of each voxel on the side of its own label: voxelized again, the "            \
    "surfaces are the label map")                                                                  \
  P(Distance, double, S Distance, FlipFree::MinimumWallDistance, FlipFree::MaximumWallDistance,    \
    "VOXELS",                                                                                      \
    "Without {Exact}: how far surfaces may go along each axis to be smooth before voxels change "  \
    "sides, in voxels")                                                                            \
  P(Iterations, int, S Iterations, 0, FlipFree::MaximumWallIterations, "N", "Of the smoothing")

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<LabelSurfaceSettings>& LabelSurfaceParameters();

} // namespace FlipFree

#endif
