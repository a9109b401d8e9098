/**
 * What runs answer: a surface, its voxels and the convergence table as objects of JavaScript.
 */
#ifndef FlipFreeAnswers_h
#define FlipFreeAnswers_h

#include "Bindings.h"

#include "Deformation/VolumeSegmentation.h"

namespace FlipFree
{

/// How messages call the volume.
constexpr const char* ImageName = "the image";

/// Throws std::invalid_argument for a volume without voxels and for an improper grid.
void RequireVoxels(const ImageGeometry& geometry);

/// { stopReason, aborted, selfIntersections, surface, runs, iterations, warnings }.
val AnswerOf(const OrganSurface& organ, const std::vector<VoxelRun>& voxels,
  const std::vector<std::string>& warnings);

} // namespace FlipFree

#endif
