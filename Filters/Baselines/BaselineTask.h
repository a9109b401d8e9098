/**
 * Private to the module: what every method is given, and what it gives back.
 */
#ifndef FlipFreeBaselineTask_h
#define FlipFreeBaselineTask_h

#include "Image/SeedRegion.h"

#include <vector>

namespace FlipFree
{

struct BaselineTask
{
  FloatImage Region; ///< smoothed; the part of the image that can be reached from the seed
  double Noise = 0;  ///< standard deviation in the seed before smoothing
  SeedSphere Seed;
};

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
