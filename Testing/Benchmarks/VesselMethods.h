/**
 * The methods that FlipFree is compared with on vessels. They start from balls at the same points,
 * whose voxels together model the intensities, and end at the planes across FlipFree's path at its
 * ends: no method knows ends by itself. Each has one setting for all vessels, chosen on half A of
 * the volumes (halves.csv).
 */
#ifndef VesselMethods_h
#define VesselMethods_h

#include "vtkBaselineSegmentation.h"
#include "vtkSmartPointer.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

class vtkImageData;
class vtkPolyData;

struct VesselMethod
{
  std::string Name;
  double SeedRadius; ///< of the balls, mm
  double Reach;      ///< beyond the box of the points, mm: the less, the less a method can leak
  std::function<vtkSmartPointer<vtkBaselineSegmentation>()> Make;
};

const std::vector<VesselMethod>& VesselMethods();

/// By name; throws std::out_of_range if there is none.
const VesselMethod& VesselMethodOf(const std::string& name);

/// The method on a vessel, to be updated. `parameters` are changes of its setting, `NAME=VALUE` by
/// the names of setters; those that the method does not have are ignored.
vtkSmartPointer<vtkBaselineSegmentation> PrepareMethod(const VesselMethod& method,
  vtkImageData* image, const std::vector<Eigen::Vector3d>& points, vtkPolyData* centerline,
  const std::vector<std::string>& parameters);

#endif
