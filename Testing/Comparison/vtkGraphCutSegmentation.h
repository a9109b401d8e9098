/**
 * @class   vtkGraphCutSegmentation
 * @brief   segments an organ by a minimum cut
 *
 * Finds the set of voxels with the least sum of a regional and a boundary term, by a maximum flow
 * (Boost.Graph's, of Boykov and Kolmogorov):
 *  - regional: the odds of a voxel's intensity under a mixture of Gaussians of the seed sphere
 *    against one of its surroundings;
 *  - boundary: the area of the organ's surface, which costs less where intensities jump.
 *
 * As hard constraints, the seed sphere is organ, and voxels with very low odds or without a
 * connection to the seed are background, which keeps the graph small. The mixture of a smoothed
 * sphere is too narrow for partial-volume voxels, so the cut comes out about a voxel too small; a
 * rim is added to it.
 *
 * Mode VOLUME cuts the whole region within reach. Mode SLICES (default), that of the paper, cuts
 * slice by slice (planes of the image's first two axes), starting at the seed's center and
 * proceeding in both directions. What lies well inside the outline of one slice is organ in the
 * next, and what lies well outside is background.
 *
 * Ports, errors and the common properties are those of vtkBaselineSegmentation. NumberOfIterations
 * is the number of slices cut, 1 in mode VOLUME.
 *
 * Source: Y. Boykov and M.-P. Jolly, Interactive graph cuts for optimal boundary and region
 * segmentation of objects in N-D images (2001); Y. Boykov and V. Kolmogorov, An experimental
 * comparison of min-cut/max-flow algorithms for energy minimization in vision (2004).
 */
#ifndef vtkGraphCutSegmentation_h
#define vtkGraphCutSegmentation_h

#include "vtkBaselineSegmentation.h"

class vtkGraphCutSegmentation : public vtkBaselineSegmentation
{
public:
  static vtkGraphCutSegmentation* New();
  vtkTypeMacro(vtkGraphCutSegmentation, vtkBaselineSegmentation);

  /**
   * Values of Mode.
   */
  enum ModeType
  {
    SLICES = 0,
    VOLUME = 1
  };

  /**
   * SLICES (default) or VOLUME.
   */
  vtkSetClampMacro(Mode, int, SLICES, VOLUME);
  void SetModeToSlices() { this->SetMode(SLICES); }
  void SetModeToVolume() { this->SetMode(VOLUME); }

  /**
   * How much the seed's mixture is widened, in standard deviations of the image's noise, added in
   * quadrature. Default 1; 0 to 100.
   */
  vtkSetClampMacro(NoiseWidening, double, 0, 100);

  /**
   * Weight of the boundary, in millimeters: the cost of one square millimeter in flat parts of the
   * image, relative to natural log odds of one over a cubic millimeter. Default 0: the best value
   * for the mode, 20 for SLICES and 10 for VOLUME; 0 to 1000.
   */
  vtkSetClampMacro(Smoothness, double, 0, 1000);

  /**
   * Difference of neighboring voxels that makes the boundary between them cheap (exp(-1/2)), in
   * standard deviations of the noise. Default 1; 0.01 to 1000.
   */
  vtkSetClampMacro(EdgeContrast, double, 0.01, 1000);

  /**
   * How far the outline may move from slice to slice, in millimeters. Farther inside the outline of
   * the previous slice, voxels with favorable odds are organ; farther outside, all voxels are
   * background. Default 6; 0.1 to 1000. SLICES only.
   */
  vtkSetClampMacro(SliceMargin, double, 0.1, 1000);

  /**
   * Radius of the ball of the closing after the cut, which fills vessels, in millimeters; at most
   * two voxels are used. Default 1.5; 0 (none) to 100.
   */
  vtkSetClampMacro(ClosingRadius, double, 0, 100);

  /**
   * Radius of the ball of the opening after that, which cuts leaks, in seed radii; used between 2.5
   * and 6 mm and up to two voxels. Default 0.4, as in vtkFlipFreeSegmentation; 0 (none) to 1000. An
   * opening that would leave nothing at the seed is not applied.
   */
  vtkSetClampMacro(OpeningScale, double, 0, 1000);

  /**
   * Width of the rim that is added to the cut, in millimeters; no rim where voxels are wider.
   * Default 1.3; 0 (none) to 100.
   */
  vtkSetClampMacro(RimWidth, double, 0, 100);

protected:
  vtkGraphCutSegmentation() = default;
  ~vtkGraphCutSegmentation() override = default;

  bool Segment(const FlipFree::BaselineTask& task, const std::function<bool(double)>& monitor,
    FlipFree::BaselineResult& result) override;
  void RequireProperties() override;

  int Mode = SLICES;
  double NoiseWidening = 1;
  double Smoothness = 0;
  double EdgeContrast = 1;
  double SliceMargin = 6;
  double ClosingRadius = 1.5;
  double OpeningScale = 0.4;
  double RimWidth = 1.3;
};

#endif
