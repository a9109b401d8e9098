/**
 * Shifts the boundary of a foreground around a point that is found on the wrong side: a boundary
 * that is wrong at a point is usually wrong around it, too, but less so with distance.
 */
#ifndef FlipFreeBoundaryShift_h
#define FlipFreeBoundaryShift_h

#include "Intensity/CorrectionCut.h"

namespace FlipFree
{

/// How far from the point the boundary moves, in millimeters.
constexpr double BoundaryShiftReach = 30;

/// Changes the sides of voxels within BoundaryShiftReach of the point: those no farther from the
/// right side than a part of the point's distance that fades out, and that look like the point, or
/// like what lies between it and the organ (inside), or are as unlike the organ as it (outside).
/// They are connected to the point. `before` is the mask before CutCorrection() changed it;
/// `noise` is the standard deviation before smoothing; the modality is not Automatic. Returns false
/// if the monitor stopped it.
bool ShiftBoundary(const ImagePart& image, const Correction& correction, double noise,
  Modality modality, const ParallelFor& parallelFor, const Monitor& monitor, const BitMask& before,
  BitMask& mask);

} // namespace FlipFree

#endif
