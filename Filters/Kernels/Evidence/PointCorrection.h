/**
 * One point that corrects a mask: an inside or an outside point, and what limits what it changes.
 */
#ifndef FlipFreePointCorrection_h
#define FlipFreePointCorrection_h

#include "Evidence/TissueGrowth.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace FlipFree
{

struct PointCorrection
{
  Eigen::Vector3d Point = Eigen::Vector3d::Zero();
  bool IsInside = false;
  double Radius = 0; ///< mm; of a further seed
  double Away = 0;   ///< mm to the nearest voxel center on its side of the mask; 0 on that side
  Eigen::Vector3d NearestOnSide = Eigen::Vector3d::Zero(); ///< that center
  /// From an inside point deep in what was not expected in the organ; else null.
  std::shared_ptr<const MaskPart> Tissue;
  double Domain = 0; ///< mm; how far away from the point its surroundings may change
  /// Points of the other kind; for an outside point, the seed's center with them.
  std::vector<Eigen::Vector3d> Opposite;

  /// Whether the point leaves a place to one of the other kind, which holds what is nearer to it
  /// than HeldRadius and than half the distance between the two.
  bool IsHeld(const Eigen::Vector3d& place) const
  {
    return std::any_of(this->Opposite.begin(), this->Opposite.end(),
      [&](const Eigen::Vector3d& other) {
        return (place - other).norm() <= std::min(HeldRadius, 0.5 * (other - this->Point).norm());
      });
  }

  /// Whether a place is so near to the point that none of the other kind can be as near to it.
  bool IsOwn(const Eigen::Vector3d& place) const
  {
    return std::all_of(this->Opposite.begin(), this->Opposite.end(),
      [&](const Eigen::Vector3d& other)
      { return (place - this->Point).norm() <= 0.5 * (other - this->Point).norm(); });
  }

  static constexpr double HeldRadius = 20; ///< millimeters
};

} // namespace FlipFree

#endif
