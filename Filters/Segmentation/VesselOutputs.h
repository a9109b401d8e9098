/**
 * Private to the module: the points that a user gives to vessels, and the centerline that comes
 * back.
 */
#ifndef FlipFreeVesselOutputs_h
#define FlipFreeVesselOutputs_h

#include "Vessel/VesselSegmentation.h"

#include <vector>

class vtkPolyData;

namespace FlipFree
{

struct VesselPoints
{
  std::vector<Eigen::Vector3d> All;
  ConstraintList Corrections;

  PointList List() const
  {
    PointList list(static_cast<Eigen::Index>(this->All.size()), 3);
    for (Eigen::Index point = 0; point < list.rows(); ++point)
    {
      list.row(point) = this->All[point];
    }
    return list;
  }
};

/// A poly line per branch, with the arrays that vtkVesselPath documents.
void FillCenterline(const VesselTree& tree, vtkPolyData* centerline);

} // namespace FlipFree

#endif
