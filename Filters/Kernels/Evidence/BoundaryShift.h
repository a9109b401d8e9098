/**
 * Shifts the boundary of a foreground around a point that is found on the wrong side: a boundary
 * that is wrong at a point is usually wrong around it, too, but less so with distance.
 */
#ifndef FlipFreeBoundaryShift_h
#define FlipFreeBoundaryShift_h

#include "Evidence/PointCorrection.h"
#include "Image/BitMask.h"
#include "Image/ImagePart.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// How far from the point the boundary moves, in millimeters.
constexpr double BoundaryShiftReach = 30;

/// Finds the voxels within BoundaryShiftReach of the point, on the wrong side, that change: those
/// no farther from the right side than a part of the point's distance that fades out, that look
/// like the point, or like what lies between it and the organ (inside), or are as unlike the organ
/// as it (outside), and that no point of the other kind holds. They are
/// connected with what lies between the point and its side. The masks are on the grid of the part;
/// `noise` is the standard deviation before smoothing; the modality is not Automatic. Returns false
/// if the monitor stopped it.
bool ShiftBoundary(const ImagePart& image, const PointCorrection& correction, double noise,
  Modality modality, const ParallelFor& parallelFor, const Monitor& monitor, const BitMask& before,
  BitMask& changed);

} // namespace FlipFree

#endif
