/**
 * The ramp of gray values by which an organ's boundary is located with subvoxel accuracy.
 */
#ifndef FlipFreeEdgeRamp_h
#define FlipFreeEdgeRamp_h

namespace FlipFree
{

/// Maps gray values before the organ's boundary is located: 1 between Low and High, falling to 0
/// within Width outside of them, so that everything unlike the organ looks alike.
struct EdgeRamp
{
  double Low = 0;
  double High = 0;
  double Width = 0; ///< zero: the gray values themselves

  double operator()(double z) const
  {
    const double outside = z < this->Low ? this->Low - z : (z > this->High ? z - this->High : 0);
    return outside < this->Width ? 1 - outside / this->Width : 0;
  }
};

} // namespace FlipFree

#endif
