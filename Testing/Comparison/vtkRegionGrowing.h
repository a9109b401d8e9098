/**
 * @class   vtkRegionGrowing
 * @brief   segments an organ by growing a region from the seed sphere
 *
 * Confidence connected region growing (itk::ConfidenceConnectedImageFilter): the voxels that are
 * connected to the seed sphere and whose intensity is within Multiplier standard deviations of the
 * region's mean. The mean is measured again on the grown region, Repetitions times. Then the region
 * is closed, which fills vessels and noise, and opened, which cuts leaks through thin bridges. What
 * is still connected to the seed is the organ.
 *
 * Ports, errors and the common properties are those of vtkBaselineSegmentation.
 *
 * Source: R. Adams and L. Bischof, Seeded region growing (1994); L. Ibanez et al., The ITK Software
 * Guide, section 4.1.3.
 */
#ifndef vtkRegionGrowing_h
#define vtkRegionGrowing_h

#include "vtkBaselineSegmentation.h"

class vtkRegionGrowing : public vtkBaselineSegmentation
{
public:
  static vtkRegionGrowing* New();
  vtkTypeMacro(vtkRegionGrowing, vtkBaselineSegmentation);

  /**
   * Half the width of the interval of intensities, in standard deviations of the region. Default 3;
   * 0.1 to 100.
   */
  vtkSetClampMacro(Multiplier, double, 0.1, 100);

  /**
   * How many times the statistics are measured again on the grown region, which is then grown
   * again. Default 1; 0 to 100.
   */
  vtkSetClampMacro(Repetitions, int, 0, 100);

  /**
   * Radius of the ball of the closing, in millimeters; at most two voxels are used. Default 1.5; 0
   * (none) to 100.
   */
  vtkSetClampMacro(ClosingRadius, double, 0, 100);

  /**
   * Radius of the ball of the opening, in seed radii; used between 2.5 and 6 mm and up to two
   * voxels. Default 0.3; 0 (none) to 1000. An opening that would
   * leave nothing at the seed is not applied.
   */
  vtkSetClampMacro(OpeningScale, double, 0, 1000);

protected:
  vtkRegionGrowing() = default;
  ~vtkRegionGrowing() override = default;

  bool Segment(const FlipFree::BaselineTask& task, const std::function<bool(double)>& monitor,
    FlipFree::BaselineResult& result) override;
  void RequireProperties() override;

  double Multiplier = 3;
  int Repetitions = 1;
  double ClosingRadius = 1.5;
  double OpeningScale = 0.3;
};

#endif
