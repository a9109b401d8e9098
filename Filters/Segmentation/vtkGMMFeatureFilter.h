/**
 * @class   vtkGMMFeatureFilter
 * @brief   how well each voxel fits the organ: a Gaussian mixture of the seed's intensities
 *
 * Models the intensities of the seed sphere by a mixture of Gaussians (section 3.2 and Eq. 1 of the
 * paper), fitted by expectation maximization; the Bayesian information criterion chooses the number
 * of components. The feature of a voxel is g(z) over its greatest value. With a surface on port 1
 * the feature is instead the odds of the intensities inside the surface against those of a shell
 * around it, in [0, 1] with threshold 1/2; the outermost 2 mm inside model neither.
 *
 * Leak control (beyond the paper) closes the foreground, opens it, and keeps what hangs together
 * with the seed, so that thin bridges to neighbors do not leak. Voxels that it takes away get half
 * the threshold, voxels that it fills in the threshold.
 *
 * Input port 0: vtkImageData, one scalar component, smoothed. Field data `NoiseStandardDeviation`
 * of vtkSeedRegionDiffusion is used where present; else the noise is measured in the seed. Input
 * port 1, optional: vtkPolyData, a closed surface within the organ (SetSurfaceConnection). Output
 * port 0: vtkImageData of the input's geometry, float scalars `Feature`, 0 to 1. Field data,
 * doubles: `FeatureThreshold` (1 value), `MixtureWeights`, `MixtureMeans`,
 * `MixtureStandardDeviations` (one per component, gray values), `EdgeRamp` (3 values: low, high,
 * width, by which vtkCorrespondenceSearch reads edges).
 *
 * Errors: as vtkSeedRegionDiffusion; a surface that is open, or holds no voxel of the image; a seed
 * that holds no voxel, or, unless a surface takes its place, has no contrast to its surroundings; a
 * `NoiseStandardDeviation` that is not one finite number; a property that is NaN. Warning: of a
 * surface with 200 voxels or fewer more than 2 mm inside, too few to model the organ, the feature
 * is that of the seed. Progress is reported and an abort obeyed between passes over the image; the
 * output is then empty.
 */
#ifndef vtkGMMFeatureFilter_h
#define vtkGMMFeatureFilter_h

#include "FlipFreeSegmentationModule.h"
#include "vtkImageAlgorithm.h"

class vtkPolyData;

class FLIPFREESEGMENTATION_EXPORT vtkGMMFeatureFilter : public vtkImageAlgorithm
{
public:
  static vtkGMMFeatureFilter* New();
  vtkTypeMacro(vtkGMMFeatureFilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The surface that takes the seed's place as the model of the organ (input port 1).
   */
  void SetSurfaceConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetSurfaceData(vtkPolyData* surface);
  ///@}

  ///@{
  /**
   * Center of the seed sphere, in millimeters. Default (0, 0, 0).
   */
  vtkSetVector3Macro(SeedCenter, double);
  vtkGetVector3Macro(SeedCenter, double);
  ///@}

  ///@{
  /**
   * Radius of the seed sphere, in millimeters. Default 10; 1e-6 to 1e6, and a voxel at least.
   */
  vtkSetClampMacro(SeedRadius, double, 1e-6, 1e6);
  vtkGetMacro(SeedRadius, double);
  ///@}

  ///@{
  /**
   * Greatest number of components. Default 3; 1 to 8.
   */
  vtkSetClampMacro(MaximumComponents, int, 1, 8);
  vtkGetMacro(MaximumComponents, int);
  ///@}

  ///@{
  /**
   * Components of less weight are dropped: vessels, stones, noise. Default 0.15; 0 to 1.
   */
  vtkSetClampMacro(MinimumComponentWeight, double, 0, 1);
  vtkGetMacro(MinimumComponentWeight, double);
  ///@}

  ///@{
  /**
   * Standard deviations of the noise that are added, in squares, to each component's deviation.
   * Default 1; 0 to 100.
   */
  vtkSetClampMacro(NoiseWidening, double, 0, 100);
  vtkGetMacro(NoiseWidening, double);
  ///@}

  ///@{
  /**
   * Mass of the mixture that the threshold keeps. Default 0.95; 0.01 to 0.99999. Counts where
   * FeatureThreshold is zero.
   */
  vtkSetClampMacro(ForegroundMass, double, 0.01, 0.99999);
  vtkGetMacro(ForegroundMass, double);
  ///@}

  ///@{
  /**
   * The threshold Gamma itself, 0 to 1. Default 0: by ForegroundMass.
   */
  vtkSetClampMacro(FeatureThreshold, double, 0, 1);
  vtkGetMacro(FeatureThreshold, double);
  ///@}

  ///@{
  /**
   * Close, open, and keep the seed's component. Default on.
   */
  vtkSetMacro(LeakControl, bool);
  vtkGetMacro(LeakControl, bool);
  vtkBooleanMacro(LeakControl, bool);
  ///@}

  ///@{
  /**
   * Radii of the closing and of the opening, in millimeters. Defaults 1.5 and 4; 0, which does
   * nothing, to 1000.
   */
  vtkSetClampMacro(ClosingRadius, double, 0, 1000);
  vtkGetMacro(ClosingRadius, double);
  vtkSetClampMacro(OpeningRadius, double, 0, 1000);
  vtkGetMacro(OpeningRadius, double);
  ///@}

protected:
  vtkGMMFeatureFilter();
  ~vtkGMMFeatureFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double SeedCenter[3] = { 0, 0, 0 };
  double SeedRadius = 10;
  int MaximumComponents = 3;
  double MinimumComponentWeight = 0.15;
  double NoiseWidening = 1;
  double ForegroundMass = 0.95;
  double FeatureThreshold = 0;
  bool LeakControl = true;
  double ClosingRadius = 1.5;
  double OpeningRadius = 4;

private:
  vtkGMMFeatureFilter(const vtkGMMFeatureFilter&) = delete;
  void operator=(const vtkGMMFeatureFilter&) = delete;
};

#endif
