/**
 * A part that might have been decided otherwise: the cut had little evidence (OrganCut.h), or
 * another opinion disagrees (OtherParts.h).
 */
#ifndef FlipFreeDoubtfulPart_h
#define FlipFreeDoubtfulPart_h

#include "KernelTypes.h"

#include <cmath>

namespace FlipFree
{

struct DoubtfulPart
{
  Eigen::Vector3d Place = Eigen::Vector3d::Zero(); ///< where it is deepest, in millimeters
  double Volume = 0;                               ///< mm3
  bool IsIncluded = false;                         ///< in the organ
  /// By how much the contrary costs more, per mm3 of it, or for a part of another opinion how sure
  /// the foreground is, on the same scale; then negative where the contrary is likelier.
  double Margin = 0;

  /// The contrary is true with the chance 1 / (1 + exp(margin / MarginScale)).
  static constexpr double MarginScale = 1.75;

  /// Whether it is in the part's neighborhood, the ball of its volume around its place.
  bool IsNear(const Eigen::Vector3d& place) const
  {
    return (this->Place - place).norm() < std::cbrt(this->Volume * 3 / (4 * EIGEN_PI));
  }
  /// Whether they are taken for one: each place is in the other's neighborhood.
  bool IsSame(const DoubtfulPart& other) const
  {
    return this->IsNear(other.Place) && other.IsNear(this->Place);
  }
};

} // namespace FlipFree

#endif
