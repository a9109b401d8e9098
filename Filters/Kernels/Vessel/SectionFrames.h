/**
 * Cross-sections of a line: at each point the line's direction and two axes across it that turn as
 * little as possible from one point to the next (W. Wang, B. Juettler, D. Zheng, Y. Liu:
 * Computation of rotation minimizing frames, 2008, the double reflection method).
 */
#ifndef FlipFreeSectionFrames_h
#define FlipFreeSectionFrames_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

/// An orthonormal, right-handed frame: First x Second = Tangent.
struct SectionFrame
{
  Eigen::Vector3d Origin;
  Eigen::Vector3d Tangent;
  Eigen::Vector3d First;
  Eigen::Vector3d Second;

  /// The direction at an angle from the first axis toward the second.
  Eigen::Vector3d Ray(double angle) const
  {
    return std::cos(angle) * this->First + std::sin(angle) * this->Second;
  }
};

/// One frame per point of a line of at least two points, no two consecutive ones alike.
std::vector<SectionFrame> MakeSectionFrames(const PointList& line);

} // namespace FlipFree

#endif
