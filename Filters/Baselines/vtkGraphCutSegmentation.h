/**
 * @class   vtkGraphCutSegmentation
 * @brief   segments an organ by a minimum cut
 *
 * Finds the set of voxels with the least sum of a regional and a boundary term, by a maximum flow
 * (Boost.Graph's, of Boykov and Kolmogorov):
 *  - regional: the odds of a voxel's intensity under a mixture of Gaussians of the seed sphere
 *    against one of its surroundings;
 *  - boundary: the area of the organ's surface, which costs less where intensities jump.
 * The seed sphere is organ for certain. Voxels whose odds are hopeless, and those that do not hang
 * together with the seed, are background for certain; that keeps the graph small. The mixture of a
 * smoothed sphere is too narrow for voxels that organ and neighbor share, so that the cut is too
 * small by about a voxel: a rim is added to it.
 *
 * Mode VOLUME cuts the reachable region at once. Mode SLICES (default), the one of the paper, cuts
 * slice by slice (planes of the image's first two axes), from the one through the seed's center on
 * to both sides: what lies well inside the slice before is organ for certain in the next, and what
 * lies well outside is background.
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

class FLIPFREEBASELINES_EXPORT vtkGraphCutSegmentation : public vtkBaselineSegmentation
{
public:
  static vtkGraphCutSegmentation* New();
  vtkTypeMacro(vtkGraphCutSegmentation, vtkBaselineSegmentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Values of Mode.
   */
  enum ModeType
  {
    SLICES = 0,
    VOLUME = 1
  };

  ///@{
  /**
   * Slice by slice: SLICES (default), or at once: VOLUME.
   */
  vtkSetClampMacro(Mode, int, SLICES, VOLUME);
  vtkGetMacro(Mode, int);
  void SetModeToSlices() { this->SetMode(SLICES); }
  void SetModeToVolume() { this->SetMode(VOLUME); }
  ///@}

  ///@{
  /**
   * Standard deviations of the image's noise by which the seed's mixture is widened, added in
   * squares. Default 1; 0 to 100.
   */
  vtkSetClampMacro(NoiseWidening, double, 0, 100);
  vtkGetMacro(NoiseWidening, double);
  ///@}

  ///@{
  /**
   * Weight of the boundary, in millimeters: what a square millimeter of it costs in flat parts of
   * the image, in natural logarithms of odds over a cubic millimeter. Default 0: what suits the
   * mode best, 20 for SLICES and 10 for VOLUME; 0 to 1000.
   */
  vtkSetClampMacro(Smoothness, double, 0, 1000);
  vtkGetMacro(Smoothness, double);
  ///@}

  ///@{
  /**
   * Difference of neighboring voxels that makes the boundary between them cheap (exp(-1/2)), in
   * standard deviations of the noise. Default 1; 0.01 to 1000.
   */
  vtkSetClampMacro(EdgeContrast, double, 0.01, 1000);
  vtkGetMacro(EdgeContrast, double);
  ///@}

  ///@{
  /**
   * How far the outline moves from slice to slice, in millimeters: so far inside that of the slice
   * before, voxels that look like organ are organ; so far outside, all are background. Default 6;
   * 0.1 to 1000. SLICES only.
   */
  vtkSetClampMacro(SliceMargin, double, 0.1, 1000);
  vtkGetMacro(SliceMargin, double);
  ///@}

  ///@{
  /**
   * Radius of the ball of the closing after the cut, which fills vessels, in millimeters; used up
   * to two voxels. Default 1.5; 0 (none) to 100.
   */
  vtkSetClampMacro(ClosingRadius, double, 0, 100);
  vtkGetMacro(ClosingRadius, double);
  ///@}

  ///@{
  /**
   * Radius of the ball of the opening after that, which cuts leaks, in seed radii; used between 2.5
   * and 6 mm and up to two voxels. Default 0.4, as in vtkFlipFreeSegmentation; 0 (none) to 1000. An
   * opening that would leave nothing at the seed is not applied.
   */
  vtkSetClampMacro(OpeningScale, double, 0, 1000);
  vtkGetMacro(OpeningScale, double);
  ///@}

  ///@{
  /**
   * Width of the rim that is added to the cut, in millimeters; where voxels are wider, none is.
   * Default 1.3; 0 (none) to 100.
   */
  vtkSetClampMacro(RimWidth, double, 0, 100);
  vtkGetMacro(RimWidth, double);
  ///@}

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

private:
  vtkGraphCutSegmentation(const vtkGraphCutSegmentation&) = delete;
  void operator=(const vtkGraphCutSegmentation&) = delete;
};

#endif
