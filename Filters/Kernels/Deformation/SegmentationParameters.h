/**
 * The parameters that users set, by name: where each stands in the settings, and its range. The
 * stages make their properties from these lists, and a front end without stages has all of them in
 * one table.
 *
 * A list calls P(Name, type, field, minimum, maximum) for each parameter; S is the expression
 * before the settings' fields, such as Settings-> in a stage.
 */
#ifndef FlipFreeSegmentationParameters_h
#define FlipFreeSegmentationParameters_h

#include "Deformation/VolumeSegmentation.h"
#include "ParameterTable.h"

// Fields cannot be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)

#define FLIPFREE_SCHEDULE_PARAMETERS(P, S)                                                         \
  P(Resolution, int, S Resolution, 2, 256)                                                         \
  P(Levels, int, S Levels, 1, 6)                                                                   \
  P(MaximumIterations, int, S MaximumIterations, 0, 100000)                                        \
  P(DistanceTolerance, double, S DistanceTolerance, 0, 1e6)                                        \
  P(ChangeTolerance, double, S ChangeTolerance, -1e6, 1e6)

// The stage and the whole method have different names for its iterations.
#define FLIPFREE_SMOOTHING_PARAMETERS(P, S, Iterations_)                                           \
  P(Reach, double, S Reach, 0, 1e6)                                                                \
  P(Iterations_, int, S Iterations, 0, 1000)

#define FLIPFREE_FEATURE_PARAMETERS(P, S)                                                          \
  P(MaximumComponents, int, S Intensity.Mixture.MaximumComponents, 1, 8)                           \
  P(MinimumComponentWeight, double, S Intensity.Mixture.MinimumWeight, 0, 1)                       \
  P(NoiseWidening, double, S Intensity.NoiseWidening, 0, 100)                                      \
  P(ForegroundMass, double, S Intensity.ForegroundMass, 0.01, 0.99999)                             \
  P(FeatureThreshold, double, S Intensity.Threshold, 0, 1)                                         \
  P(ReestimateIntensities, bool, S ReestimateIntensities, false, true)                             \
  P(LeakControl, bool, S ControlLeaks, false, true)                                                \
  P(Carving, bool, S Carving, false, true)                                                         \
  P(Consensus, bool, S Consensus, false, true)                                                     \
  P(ClosingRadius, double, S Leaks.ClosingRadius, 0, 1000)                                         \
  P(OpeningScale, double, S Leaks.OpeningScale, 0, 1000)

#define FLIPFREE_TARGET_PARAMETERS(P, S)                                                           \
  P(SearchDistance, double, S Correspondence.SearchDistance, 0, 1e6)                               \
  P(SearchScale, double, S SearchScale, 0, 1e6)                                                    \
  P(RunLength, double, S Correspondence.RunLength, 0, 1000)                                        \
  P(RunVoxels, int, S Correspondence.RunVoxels, 1, 1000)                                           \
  P(SearchInward, bool, S Correspondence.SearchInward, false, true)                                \
  P(EdgeWindow, double, S Correspondence.EdgeWindow, 0, 1000)                                      \
  P(ImageBoundaryDistance, double, S Correspondence.ImageBoundaryDistance, 0, 1e6)                 \
  P(NormalSmoothingIterations, int, S NormalSmoothingIterations, 0, 1000)                          \
  P(OutlierStandardDeviations, double, S OutlierStandardDeviations, 0, 1e6)                        \
  P(MaximumDisplacement, double, S MaximumDisplacement, 0, 1e6)

#define FLIPFREE_STEP_PARAMETERS(P, S)                                                             \
  P(AvoidFlips, bool, S AvoidFlips, false, true)                                                   \
  P(FlipThreshold, double, S FlipThreshold, 0, 1)                                                  \
  P(PropagationIterations, int, S Propagation.Iterations, 0, 100000)                               \
  P(SmoothingIterations, int, S Propagation.SmoothingIterations, 0, 100000)                        \
  P(PositionWeight, double, S Energy.PositionWeight, 0, 1e6)                                       \
  P(UniformWeight, double, S Energy.UniformWeight, 0, 1e6)                                         \
  P(Fairing, double, S Energy.Fairing, 0, 1)                                                       \
  P(Guard, bool, S Guard, false, true)

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<VolumeSegmentationSettings>& SegmentationParameters();

/// Throws Error, naming the first parameter that is not a finite number.
void RequireNumbers(const VolumeSegmentationSettings& settings);

} // namespace FlipFree

#endif
