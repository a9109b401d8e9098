/**
 * How much likelier a gray value is in the organ than around it.
 */
#ifndef FlipFreeIntensityOdds_h
#define FlipFreeIntensityOdds_h

#include "BaselineTask.h"

namespace FlipFree
{

/// Beyond this, a voxel is practically decided.
constexpr float MaximumLogOdds = 5;

/// The natural logarithm of the odds of each voxel of the region, between plus and minus
/// MaximumLogOdds: a mixture of Gaussians of the seeds, widened by `noiseWidening`
/// deviations of the noise, against one of the whole region's values of similar size.
std::vector<float> LogOddsOf(const BaselineTask& task, double noiseWidening,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
