/**
 * What every method is given, and what it gives back.
 */
#ifndef FlipFreeBaselineTask_h
#define FlipFreeBaselineTask_h

#include "Error.h"
#include "Image/SeedRegion.h"

#include <string>
#include <vector>

namespace FlipFree
{

struct BaselineTask
{
  FloatImage Region; ///< smoothed; the part of the image that can be reached from the seeds
  double Noise = 0;  ///< standard deviation in the seeds before smoothing
  std::vector<SeedSphere> Seeds;       ///< one at least
  std::vector<std::size_t> SeedVoxels; ///< offsets in the region, ascending; one at least
};

/// The seed of a method that starts from one surface or slice; throws if there are more.
inline const SeedSphere& OnlySeedOf(const BaselineTask& task)
{
  if (task.Seeds.size() > 1)
  {
    throw Error(ErrorCode::OutOfRange,
      "the method starts from one seed, and has " + std::to_string(task.Seeds.size()) +
        "; remove the further seeds, or take another method");
  }
  return task.Seeds.front();
}

/// Either a field, positive inside the organ, on the region's grid; or a closed surface; or, of
/// methods that look at one plane, such a field and its outline there: points without triangles.
struct BaselineResult
{
  std::vector<float> Field;
  PointList Points;
  TriangleList Triangles;
  int Iterations = 0;
};

} // namespace FlipFree

#endif
