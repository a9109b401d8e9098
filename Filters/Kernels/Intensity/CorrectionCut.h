/**
 * Which voxels change sides in a foreground when a point is on the wrong side: the part around it
 * that a minimum cut separates from the rest.
 */
#ifndef FlipFreeCorrectionCut_h
#define FlipFreeCorrectionCut_h

#include "Image/BitMask.h"
#include "Image/ImagePart.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

struct Correction
{
  Eigen::Vector3d Point = Eigen::Vector3d::Zero();
  bool IsInside = true; ///< the right side
  double Away = 0;      ///< of the point from the right side, in millimeters
  double Reach = 0;     ///< what is certain around the point, in millimeters
  /// Balls around corrections to the other side, which stay.
  std::vector<SeedSphere> Kept;
};

/// How far an outside point's correction may reach: anywhere in the mask. An inside point's, in
/// millimeters from the point: 30, or twice its distance from the mask.
double DomainOf(const Correction& correction);

/// Changes the sides of voxels around the point, those to the right side only. An outside point
/// that lies in a part connected only by a neck takes that part away, up to the neck; one in the
/// depth of what looks like the seed takes what is nearer to it than to the seed; else what looks
/// more like the point's surroundings than like the organ's around the seed goes. An inside point
/// adds what looks like either. A point deep on the wrong side spreads farther than one near the
/// right side. `noise` is the standard deviation before smoothing; the modality is not Automatic.
/// Returns false if the monitor stopped it.
bool CutCorrection(const ImagePart& image, const SeedSphere& seed, const Correction& correction,
  double noise, Modality modality, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask);

} // namespace FlipFree

#endif
