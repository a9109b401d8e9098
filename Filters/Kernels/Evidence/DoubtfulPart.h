/**
 * A part about which the cut (OrganCut.h) decided with little evidence.
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
  double Margin = 0; ///< by how much the contrary costs more, per mm3 of it
};

} // namespace FlipFree

#endif
