/**
 * The parameters that users set, by name: where each stands in the settings, its range, and what
 * people read about it. The stages make their properties from these lists, and front ends have all
 * of them in one table, from which they make options, keywords and help.
 *
 * A list calls P(Name, type, field, minimum, maximum, unit, help, group) for each parameter (see
 * ParameterWords; the group may be left out); S is the expression before the settings' fields, such
 * as Settings-> in a stage.
 */
#ifndef FlipFreeSegmentationParameters_h
#define FlipFreeSegmentationParameters_h

#include "Deformation/VolumeSegmentation.h"
#include "ParameterTable.h"

// Fields cannot be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)

// Of the whole method.
#define FLIPFREE_WHOLE_PARAMETERS(P, S)                                                            \
  P(StartScale, double, S StartScale, 1e-3, 1e3, "F", "Radius of the first sphere, in seed radii", \
    "Start")                                                                                       \
  P(Resolution, int, S Method.Schedule.Resolution, 2, 256, "N",                                    \
    "Vertices along an edge of each of the mesh's six sides, 6 N^2 in all; rounded down to a "     \
    "multiple of 2^(levels - 1)")                                                                  \
  P(Levels, int, S Method.Schedule.Levels, 1, 6, "N", "Levels from coarse to fine")                \
  P(MaximumIterations, int, S Method.Schedule.MaximumIterations, 0, 100000, "N",                   \
    "Maximum number of iterations at each level")                                                  \
  P(DistanceTolerance, double, S Method.Schedule.DistanceTolerance, 0, 1e6, "VOXELS",              \
    "A level ends when the mean distance to the targets is below this, in voxels of the greatest " \
    "spacing",                                                                                     \
    "Start")                                                                                       \
  P(ChangeTolerance, double, S Method.Schedule.ChangeTolerance, -1e6, 1e6, "VOXELS",               \
    "A level ends when that distance, in the same voxels, changes by less over five iterations; "  \
    "negative: never",                                                                             \
    "Start")                                                                                       \
  P(LabelValue, int, S LabelValue, 1, 255, "N",                                                    \
    "Value of the organ in the label map, 1 to 255; of several, of the first", "Result")           \
  P(KeepHistory, bool, S KeepHistory, false, true, "",                                             \
    "Keep the surface of every iteration as a time step: the play button shows it grow",           \
    "History")

// The stage and the whole method have different names for its iterations.
#define FLIPFREE_SMOOTHING_PARAMETERS(P, S, Iterations_)                                           \
  P(Reach, double, S Reach, 0, 1e6, "MM",                                                          \
    "How far from the seed the surface may get; 0: ten seed radii, at least 100 and at most "      \
    "250 mm")                                                                                      \
  P(Iterations_, int, S Iterations, 0, 1000, "N",                                                  \
    "Iterations of the diffusion that smooths the volume")

#define FLIPFREE_FEATURE_PARAMETERS(P, S)                                                          \
  P(MaximumComponents, int, S Intensity.Mixture.MaximumComponents, 1, 8, "N",                      \
    "Maximum number of Gaussians in the mixture", "Feature")                                       \
  P(MinimumComponentWeight, double, S Intensity.Mixture.MinimumWeight, 0, 1, "P",                  \
    "Weight below which a Gaussian is dropped from the mixture", "Feature")                        \
  P(NoiseWidening, double, S Intensity.NoiseWidening, 0, 100, "F",                                 \
    "How much each Gaussian is widened, in standard deviations of the volume's noise", "Feature")  \
  P(ForegroundMass, double, S Intensity.ForegroundMass, 0.01, 0.99999, "P",                        \
    "Mass of the mixture that counts as the organ")                                                \
  P(FeatureThreshold, double, S Intensity.Threshold, 0, 1, "G",                                    \
    "Gamma of Eq. 2, 0 to 1; 0: derived from {ForegroundMass}", "Feature")                         \
  P(ReestimateIntensities, bool, S ReestimateIntensities, false, true, "",                         \
    "Fit the intensities again inside the growing surface", "Feature")                             \
  P(LeakControl, bool, S ControlLeaks, false, true, "",                                            \
    "Cut thin bridges between the organ and its neighbors")                                        \
  P(Carving, bool, S Carving, false, true, "",                                                     \
    "Carve off what is connected only by a neck, move the boundary to half the local "             \
    "contrast, and run again",                                                                     \
    "Feature")                                                                                     \
  P(Consensus, bool, S Consensus, false, true, "",                                                 \
    "Where {Carving} changes much, grow the foreground again in other ways, and decide once "      \
    "more; only with {Carving} and {LeakControl}",                                                 \
    "Feature")                                                                                     \
  P(ClosingRadius, double, S Leaks.ClosingRadius, 0, 1000, "MM",                                   \
    "Radius of the foreground's closing", "Feature")                                               \
  P(OpeningScale, double, S Leaks.OpeningScale, 0, 1000, "F",                                      \
    "Radius of the foreground's opening, in seed radii, clamped to 2.5 to 6 mm; 0: none",          \
    "Feature")                                                                                     \
  P(Modality, FlipFree::Modality, S Modality, 0, 2, "N",                                           \
    "Scale of the gray values, for {Carving}; 0: automatic, 1: CT, 2: MR", "Feature")

#define FLIPFREE_TARGET_PARAMETERS(P, S)                                                           \
  P(SearchDistance, double, S Correspondence.SearchDistance, 0, 1e6, "MM",                         \
    "Length of the search lines; 0: proportional to the radius")                                   \
  P(SearchScale, double, S SearchScale, 0, 1e6, "F",                                               \
    "Length of the search lines in seed radii, clamped to 15 to 60 mm, if {SearchDistance} is 0",  \
    "Search")                                                                                      \
  P(RunLength, double, S Correspondence.RunLength, 0, 1000, "MM",                                  \
    "Length of background that marks the boundary; 0: {RunVoxels} counts", "Search")               \
  P(RunVoxels, int, S Correspondence.RunVoxels, 1, 1000, "N",                                      \
    "The same in voxels, the paper's N + 1", "Search")                                             \
  P(SearchInward, bool, S Correspondence.SearchInward, false, true, "",                            \
    "Vertices in the background search inward for the organ", "Search")                            \
  P(EdgeWindow, double, S Correspondence.EdgeWindow, 0, 1000, "MM",                                \
    "Standard deviation of the window in which targets snap to the strongest edge before "         \
    "carving, at most 1.5 voxels; 0: they do not",                                                 \
    "Search")                                                                                      \
  P(ImageBoundaryDistance, double, S Correspondence.ImageBoundaryDistance, 0, 1e6, "MM",           \
    "A vertex this close to the volume's boundary takes it for its target; 0: it has none",        \
    "Search")                                                                                      \
  P(NormalSmoothingIterations, int, S NormalSmoothingIterations, 0, 1000, "N",                     \
    "Smoothing passes over the surface's normals", "Search")                                       \
  P(OutlierStandardDeviations, double, S OutlierStandardDeviations, 0, 1e6, "F",                   \
    "Standard deviations, plus a voxel, beyond which a target is dropped; 0: none is", "Search")   \
  P(MaximumDisplacement, double, S MaximumDisplacement, 0, 1e6, "VOXELS",                          \
    "Maximum displacement in one iteration; 0: unlimited", "Search")

#define FLIPFREE_STEP_PARAMETERS(P, S)                                                             \
  P(AvoidFlips, bool, S AvoidFlips, false, true, "", "Avoid the flips that are detected",          \
    "Deformation")                                                                                 \
  P(FlipThreshold, double, S FlipThreshold, 0, 1, "R",                                             \
    "r of Eq. 3: neighbors flip if the cosine between their edge before and after is below it",    \
    "Deformation")                                                                                 \
  P(PropagationIterations, int, S Propagation.Iterations, 0, 100000, "N",                          \
    "Passes that carry displacements to solitary vertices", "Deformation")                         \
  P(SmoothingIterations, int, S Propagation.SmoothingIterations, 0, 100000, "N",                   \
    "Passes that smooth the displacements of matched vertices, too", "Deformation")                \
  P(PositionWeight, double, S Energy.PositionWeight, 0, 1e6, "F",                                  \
    "lambda_p of Eq. 7: weight of the distance to the targets against the surface's shape",        \
    "Deformation")                                                                                 \
  P(UniformWeight, double, S Energy.UniformWeight, 0, 1e6, "F",                                    \
    "lambda_u of Eq. 8: weight of an even distribution of the vertices", "Deformation")            \
  P(Fairing, double, S Energy.Fairing, 0, 1, "F",                                                  \
    "0 keeps the surface's shape (Eq. 5), 1 smooths it", "Deformation")                            \
  P(Guard, bool, S Guard, false, true, "",                                                         \
    "Keep the surface from intersecting itself; without, it may, and faces may flip")

// NOLINTEND(bugprone-macro-parentheses)

namespace FlipFree
{

/// All of them.
const ParameterTable<VolumeSegmentationSettings>& SegmentationParameters();

/// Throws Error, naming the first parameter that is not a finite number.
void RequireNumbers(const VolumeSegmentationSettings& settings);

} // namespace FlipFree

#endif
