/**
 * From a closed surface that has found its organ, more or less, to the organ's foreground: what is
 * inside is carved (OrganCarving.h), and where that changes much of it, further opinions are sought
 * (OrganConsensus.h).
 */
#ifndef FlipFreeSurfaceForeground_h
#define FlipFreeSurfaceForeground_h

#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

namespace FlipFree
{

/// `make` is called before voxels of the smoothed image are read. `noise` is the standard deviation
/// before smoothing; the modality is not Automatic. `unanimity` is that of the opinions
/// (SeekConsensus()), and 1 where no further one was asked for. Returns false if the monitor
/// stopped it; the foreground is then useless.
bool ForegroundOfSurface(const ImageView<float>& smooth, const ImageMaker& make,
  const PointList& points, const TriangleList& triangles, const SeedSphere& seed, double noise,
  Modality modality, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, double& unanimity);

} // namespace FlipFree

#endif
