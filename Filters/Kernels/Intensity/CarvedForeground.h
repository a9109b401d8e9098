/**
 * From a closed surface that has found its organ, more or less, to the organ's foreground: what is
 * inside is carved (OrganCarving.h), and where that changes much of it, further opinions are sought
 * (OrganConsensus.h). In CT, the vena cava beside a liver is removed at last (VenaCavaCarving.h).
 */
#ifndef FlipFreeCarvedForeground_h
#define FlipFreeCarvedForeground_h

#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

namespace FlipFree
{

/// What is known of the organ. The surface's points and triangles must outlive it.
struct CarvedForegroundInputs
{
  ImageView<float> Smooth; ///< the smoothed image
  ImageMaker MakeSmooth;   ///< is called before voxels of it are read
  const PointList* Points = nullptr;
  const TriangleList* Triangles = nullptr;
  SeedSphere Seed;
  double Noise = 0;              ///< standard deviation before smoothing
  OrganFeatureSettings Settings; ///< the modality is not Automatic
};

/// Carves the foreground from the inside of the surface. `unanimity` is that of the opinions
/// (SeekConsensus()), and 1 where no further one was asked for. Returns false if the monitor
/// stopped it; the foreground is then useless.
bool CarveForeground(const CarvedForegroundInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, double& unanimity);

} // namespace FlipFree

#endif
