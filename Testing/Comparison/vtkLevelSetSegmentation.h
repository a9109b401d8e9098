/**
 * @class   vtkLevelSetSegmentation
 * @brief   segments an organ by a level set that grows from the seed sphere
 *
 * The two modes of ITK-SNAP's snake tool, on ITK's sparse field level sets:
 *  - THRESHOLD (default; itk::ThresholdSegmentationLevelSetImageFilter): the front moves outward
 *    where the intensity is within IntensityWidth standard deviations of the seed's mean and inward
 *    elsewhere. The speed grows with the distance from the ends of that interval, up to 1;
 *  - GEODESIC (itk::GeodesicActiveContourLevelSetImageFilter): the front moves outward everywhere,
 *    slowly where the image has an edge, and advection pulls it to the middle of the edge. An edge
 *    is where the gradient is well above the seed's mean gradient.
 *
 * In both, curvature smooths the front. The evolution stops when the volume has settled, or after
 * MaximumIterations.
 *
 * Ports, errors and the common properties are those of vtkBaselineSegmentation; GEODESIC refuses
 * fewer than four voxels along an axis. The surface is the zero level set, located with subvoxel
 * accuracy.
 *
 * Source: P. Yushkevich et al., User-guided 3D active contour segmentation of anatomical structures
 * (2006); V. Caselles, R. Kimmel and G. Sapiro, Geodesic active contours (1997); R. Whitaker, A
 * level-set approach to 3D reconstruction from range data (1998).
 */
#ifndef vtkLevelSetSegmentation_h
#define vtkLevelSetSegmentation_h

#include "vtkBaselineSegmentation.h"

class vtkLevelSetSegmentation : public vtkBaselineSegmentation
{
public:
  static vtkLevelSetSegmentation* New();
  vtkTypeMacro(vtkLevelSetSegmentation, vtkBaselineSegmentation);

  /**
   * Values of Speed.
   */
  enum SpeedType
  {
    THRESHOLD = 0,
    GEODESIC = 1
  };

  /**
   * What moves the front: THRESHOLD (default) or GEODESIC.
   */
  vtkSetClampMacro(Speed, int, THRESHOLD, GEODESIC);
  void SetSpeedToThreshold() { this->SetSpeed(THRESHOLD); }
  void SetSpeedToGeodesic() { this->SetSpeed(GEODESIC); }

  /**
   * Half the width of the interval of intensities in which the front grows, in standard deviations
   * of the seed's smoothed intensities. Default 4; 0.1 to 100. THRESHOLD only.
   */
  vtkSetClampMacro(IntensityWidth, double, 0.1, 100);

  /**
   * Weight of the mean curvature, in millimeters, relative to the speed, which is at most 1.
   * Default 0: the best value for the speed, 2 for THRESHOLD and 0.5 for GEODESIC; 0 to 100.
   */
  vtkSetClampMacro(CurvatureScaling, double, 0, 100);

  /**
   * Weight of the pull toward edges. Default 5; 0 to 100. GEODESIC only.
   */
  vtkSetClampMacro(AdvectionScaling, double, 0, 100);

  /**
   * Standard deviation of the Gaussian with which the gradient is measured, in millimeters. Default
   * 1.5; 0.01 to 100. GEODESIC only.
   */
  vtkSetClampMacro(EdgeSigma, double, 0.01, 100);

  /**
   * The gradient that halves the speed, in multiples of the seed's mean gradient. Default 3; 0.01
   * to 1000. GEODESIC only.
   */
  vtkSetClampMacro(EdgeContrast, double, 0.01, 1000);

  /**
   * How far the final front is moved outward, in millimeters, because partial-volume voxels count
   * as background. Default 1.8; 0 (not at all) to 3. THRESHOLD only.
   */
  vtkSetClampMacro(RimWidth, double, 0, 3);

  /**
   * Maximum number of iterations. Default 1500; 1 to 1e6. In each, the front moves by at most a
   * sixth of a voxel.
   */
  vtkSetClampMacro(MaximumIterations, int, 1, 1000000);

  /**
   * The evolution stops when the volume has changed by less than this fraction over 25 iterations.
   * Default 0.0005; 0 (never) to 1.
   */
  vtkSetClampMacro(VolumeTolerance, double, 0, 1);

protected:
  vtkLevelSetSegmentation() = default;
  ~vtkLevelSetSegmentation() override = default;

  bool Segment(const FlipFree::BaselineTask& task, const std::function<bool(double)>& monitor,
    FlipFree::BaselineResult& result) override;
  void RequireProperties() override;

  int Speed = THRESHOLD;
  double IntensityWidth = 4;
  double CurvatureScaling = 0;
  double AdvectionScaling = 5;
  double EdgeSigma = 1.5;
  double EdgeContrast = 3;
  double RimWidth = 1.8;
  int MaximumIterations = 1500;
  double VolumeTolerance = 0.0005;
};

#endif
