/**
 * @class   vtkVesselPath
 * @brief   the centerline of a vessel between points, with radii
 *
 * Finds the fastest path through gray values like those at the points, away from edges and wide
 * bodies, by fast marching; centers it with rays in its cross-sections, which also give its radius;
 * and keeps it smooth. Three or more points give the tree of such paths. See vtkVesselAlgorithm for
 * points, input and errors.
 *
 * Output port 0: vtkPolyData, a poly line for each branch, the longest path first, with the point
 * arrays `Radius` (double, mm; of a disk of the section's area, with the wall) and `ArcLength`
 * (double, mm; from the branch's first point), and the cell array `Parent` (int): the line on which
 * a branch begins, -1 for the first.
 *
 * Source: J. A. Sethian, A fast marching level set method for monotonically advancing fronts, 1996;
 * T. Deschamps and L. D. Cohen, Fast extraction of minimal paths in 3D images and applications to
 * virtual endoscopy, 2001.
 */
#ifndef vtkVesselPath_h
#define vtkVesselPath_h

#include "FlipFreeSegmentationModule.h"
#include "vtkVesselAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkVesselPath : public vtkVesselAlgorithm
{
public:
  static vtkVesselPath* New();
  vtkTypeMacro(vtkVesselPath, vtkVesselAlgorithm);

protected:
  vtkVesselPath() = default;
  ~vtkVesselPath() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkVesselPath(const vtkVesselPath&) = delete;
  void operator=(const vtkVesselPath&) = delete;
};

#endif
