/**
 * The parameters of surfaces of labels that users set, by name: where each stands in the settings,
 * and its range; see SegmentationParameters.h. S is the expression before the fields of
 * LabelSurfaceSettings.
 */
#ifndef FlipFreeLabelSurfaceParameters_h
#define FlipFreeLabelSurfaceParameters_h

#include "LabelSurface/LabelSurfaces.h"
#include "ParameterTable.h"

#include <limits>

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
  P(Iterations, int, S Iterations, 0, FlipFree::MaximumWallIterations, "N", "Of the smoothing")    \
  P(SmallestPart, double, S SmallestPart, 0, FlipFree::MaximumSmallestPart, "MM3",                 \
    "Parts of labels that are smaller get no surface: their voxels take the label, or "            \
    "background, "                                                                                 \
    "that most of their faces border")                                                             \
  P(FillCavities, bool, S FillCavities, false, true, "",                                           \
    "Background that labels enclose takes the label that most of its faces border")                \
  P(FillTunnels, double, S FillTunnels, 0, FlipFree::MaximumTunnel, "MM",                          \
    "Close tunnels through labels that are narrower, in mm, to a voxel; 0: none")                  \
  P(EdgeLength, double, S EdgeLength, 0, FlipFree::MaximumWallEdge, "MM",                          \
    "Collapse edges, for fewer triangles, while none becomes longer; 0: not used")                 \
  P(Triangles, int, S Triangles, 0, std::numeric_limits<int>::max(), "N",                          \
    "Collapse edges while there are more triangles than that, of all walls, each counted once; "   \
    "0: not used")                                                                                 \
  P(Tolerance, double, S Tolerance, 0, FlipFree::MaximumWallTolerance, "VOXELS",                   \
    "How far walls may move where edges are collapsed, in voxels of the smallest spacing; "        \
    "{Exact} surfaces keep each voxel center on its side as well")

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<LabelSurfaceSettings>& LabelSurfaceParameters();

} // namespace FlipFree

#endif
