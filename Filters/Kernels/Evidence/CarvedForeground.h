/**
 * From a closed surface that has found its organ, more or less, to the organ's foreground: of all
 * that may be the organ (OrganCandidate.h), what is not is carved off (OrganCarving.h), and where
 * that changes much, further opinions are sought (OrganConsensus.h). In CT, the vena cava beside a
 * liver is removed at last (VenaCavaCarving.h).
 */
#ifndef FlipFreeCarvedForeground_h
#define FlipFreeCarvedForeground_h

#include "Evidence/OrganCarving.h"
#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

namespace FlipFree
{

/// What is known of the organ. The surface's points and triangles must outlive it.
struct CarvedForegroundInputs
{
  ImageView<float> Smooth;   ///< the smoothed image
  ImageMaker EnsureSmoothed; ///< is called before voxels of it are read
  const PointList* Points = nullptr;
  const TriangleList* Triangles = nullptr;
  SeedSphere Seed;
  double Noise = 0;              ///< standard deviation before smoothing
  OrganFeatureSettings Settings; ///< the modality is not Automatic
};

/// All masks are on the grid of the image.
struct CarvedForeground
{
  BitMask Mask;
  BitMask Candidate;             ///< all that was ever considered
  std::vector<BitMask> Opinions; ///< others about the organ, none without consensus
  CarvingReport Report;
};

/// Carves the foreground from the inside of the surface. Returns false if the monitor stopped it;
/// what is carved is then useless.
bool CarveForeground(const CarvedForegroundInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, CarvedForeground& carved);

} // namespace FlipFree

#endif
