/**
 * @class   vtkVesselAlgorithm
 * @brief   superclass of filters that follow a vessel between points
 *
 * Holds the image, the points, and what is known about the vessel in advance. The points lie in the
 * vessel: one at each end, more along it or at the ends of its branches, in any order. The two that
 * are closest to each other, by travel time through gray values like those at the points, are
 * joined first; then the next point is joined to the existing path, and so on. A point 5 mm off
 * does little harm.
 *
 * Input port 0: vtkImageData with one scalar component of any type; coordinates are the image's
 * physical millimeters, and the direction matrix is honored. No path runs through voxels without
 * data, those that are not finite, and nothing is learned from them.
 *
 * Errors, with a code of FlipFreeErrorCode.h: no scalars, several components, an empty image, fewer
 * than two points, a point outside the image or in a voxel without data, two points closer than 3
 * mm, points that no path through similar gray values joins, a property that is NaN. Each is
 * reported once, and the outputs are then empty.
 */
#ifndef vtkVesselAlgorithm_h
#define vtkVesselAlgorithm_h

#include "FlipFreeSegmentationModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace FlipFree
{
class FilterSettings;
struct VesselPoints;
struct VesselSegmentationSettings;
}

class FLIPFREESEGMENTATION_EXPORT vtkVesselAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkVesselAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The points in the vessel, in millimeters. Default: none; two or more are needed.
   */
  void AddPoint(double x, double y, double z);
  void RemoveAllPoints();
  int GetNumberOfPoints() const;
  void GetPoint(int index, double point[3]) const;
  ///@}

  ///@{
  /**
   * The vessel's approximate radius, in millimeters. Default 0: found in the image; 0 to 100. It
   * helps where a path strays into a wider or thinner neighbor. Below 7 mm, the search is for a
   * thin vessel, brighter than its surroundings; otherwise, it is for a wide one, and extends
   * farther from the points, up to 120 mm, if the image does not support the path found near them.
   */
  void SetRadius(double value);
  double GetRadius() const;
  ///@}

  ///@{
  /**
   * What is added to the outline, in millimeters, since the gray values show the vessel's lumen.
   * Default 0.3; -5 to 5. Human readers draw an aorta with its wall, 0.7 mm or so, and veins almost
   * without. A negative thickness makes the vessel thinner; it is an error where less than 0.5 mm
   * of a branch's mean radius would remain.
   */
  void SetWallThickness(double value);
  double GetWallThickness() const;
  ///@}

  ///@{
  /**
   * The scale of the gray values, by which the contrast across the outline is judged: one of
   * vtkGMMFeatureFilter::ModalityType, automatic (0), CT in Hounsfield units (1), or MR in any unit
   * (2), which is scaled to CT. Default 0: CT if a hundredth of the voxels are as negative as fat,
   * otherwise MR. Set it to CT for a part of a CT without fat and air.
   */
  void SetModality(int value);
  int GetModality() const;
  ///@}

protected:
  vtkVesselAlgorithm();
  ~vtkVesselAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /**
   * Throws if a property is not a number.
   */
  void RequireProperties() const;

  const std::unique_ptr<FlipFree::VesselPoints> Points;
  const std::unique_ptr<FlipFree::VesselSegmentationSettings> Settings;

private:
  friend class FlipFree::FilterSettings;
  vtkVesselAlgorithm(const vtkVesselAlgorithm&) = delete;
  void operator=(const vtkVesselAlgorithm&) = delete;
};

#endif
