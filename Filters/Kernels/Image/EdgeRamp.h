/**
 * The ramp of gray values by which an organ's boundary is located with subvoxel accuracy.
 */
#ifndef FlipFreeEdgeRamp_h
#define FlipFreeEdgeRamp_h

#include <Eigen/Core>

namespace FlipFree
{

/// Maps gray values before the organ's boundary is located: 1 between Low and High, falling to 0
/// within Width outside of them, so that everything unlike the organ looks alike.
struct EdgeRamp
{
  double Low = 0;
  double High = 0;
  double Width = 0; ///< zero: the gray values themselves

  /// Of four gray values, if Width is not zero.
  Eigen::Array4d operator()(const Eigen::Array4d& z) const
  {
    const Eigen::Array4d outside = (this->Low - z).max(z - this->High).max(0.0);
    return (1 - outside / this->Width).max(0.0);
  }
};

} // namespace FlipFree

#endif
