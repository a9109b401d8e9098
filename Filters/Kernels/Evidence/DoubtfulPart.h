/**
 * A part that might have been decided otherwise: the cut had little evidence (OrganCut.h), or
 * another opinion disagrees (OtherParts.h).
 */
#ifndef FlipFreeDoubtfulPart_h
#define FlipFreeDoubtfulPart_h

#include "KernelTypes.h"

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
};

} // namespace FlipFree

#endif
