/**
 * @class   vtkGMMFeatureFilter
 * @brief   how well each voxel fits the organ: a Gaussian mixture of the seed's intensities
 *
 * Models the intensities of the seed sphere by a mixture of Gaussians (section 3.2 and Eq. 1 of the
 * paper), fitted by expectation maximization; the Bayesian information criterion chooses the number
 * of components. The feature of a voxel is g(z) over its greatest value. With a surface on port 1
 * the feature is instead the odds of the intensities inside the surface against those of a shell
 * around it, in [0, 1] with threshold 1/2; the outermost 2 mm inside are used for neither.
 *
 * Leak control (beyond the paper) closes the foreground, opens it, and keeps what is connected to
 * the seed, so that thin bridges to neighbors do not leak. Voxels that it removes get half the
 * threshold; voxels that it fills get the threshold itself. Voxels that are not finite have no
 * data: nothing is learned from them, and their feature is NaN, unless the foreground encloses
 * them.
 *
 * Input port 0: vtkImageData, one scalar component, smoothed. Field data `NoiseStandardDeviation`
 * of vtkSeedRegionDiffusion is used where present; otherwise the noise is measured in the seed.
 * Input port 1, optional: vtkPolyData, a closed surface of the organ (SetSurfaceConnection).
 * Output port 0: vtkImageData of the input's geometry, float scalars `Feature`, 0 to 1. Field data,
 * doubles: `FeatureThreshold` (1 value), `SeedRadius` (1 value, mm; after carving, that of a ball
 * of the foreground's volume, if greater), `MixtureWeights`, `MixtureMeans`,
 * `MixtureStandardDeviations` (one per component, gray values), `EdgeRamp` (3 values: low, high,
 * width, by which vtkCorrespondenceSearch reads edges).
 *
 * Errors, with a code of FlipFreeErrorCode.h: as vtkSeedRegionDiffusion; a surface that is open, or
 * holds no voxel of the image; a seed that holds no voxel, or, unless a surface takes its place,
 * has no contrast to its surroundings; a `NoiseStandardDeviation` that is not one finite number; a
 * property that is NaN. Warning: a surface that has 200 voxels or fewer more than 2 mm inside it,
 * too few to model the organ; the intensities are then those of the seed. Progress is reported and
 * an abort obeyed between passes over the image; the output is then empty.
 */
#ifndef vtkGMMFeatureFilter_h
#define vtkGMMFeatureFilter_h

#include "FlipFreeSegmentationModule.h"
#include "vtkImageAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkPolyData;

namespace FlipFree
{
struct OrganFeatureSettings;
}

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
  void SetSeedRadius(double value);
  vtkGetMacro(SeedRadius, double);
  ///@}

  ///@{
  /**
   * Maximum number of Gaussians of the mixture (Eq. 1). Default 3; 1 to 8.
   */
  void SetMaximumComponents(int value);
  int GetMaximumComponents() const;
  ///@}

  ///@{
  /**
   * Components of less weight are dropped: specks in the seed sphere are not the organ. Default
   * 0.15, 0 to 1; 0 keeps all.
   */
  void SetMinimumComponentWeight(double value);
  double GetMinimumComponentWeight() const;
  ///@}

  ///@{
  /**
   * By how many standard deviations of the image's noise each component is widened, added in
   * quadrature: smoothed voxels of a small sphere vary less than those of the whole organ. Default
   * 1, 0 to 100; 0 does not widen.
   */
  void SetNoiseWidening(double value);
  double GetNoiseWidening() const;
  ///@}

  ///@{
  /**
   * Mass of the mixture above the threshold Gamma of Eq. 2. Default 0.95; 0.01 to 0.99999. Used
   * only if FeatureThreshold is 0.
   */
  void SetForegroundMass(double value);
  double GetForegroundMass() const;
  ///@}

  ///@{
  /**
   * Gamma itself, relative to the mode of g, 0 to 1. Default 0: derived from ForegroundMass, or,
   * with a surface on port 1, even odds of organ and background (0.5).
   */
  void SetFeatureThreshold(double value);
  double GetFeatureThreshold() const;
  ///@}

  ///@{
  /**
   * Fit the intensities again to the inside of the surface on port 1, against a shell around it.
   * Default on; off keeps the intensities of the seed.
   */
  void SetReestimateIntensities(bool value);
  bool GetReestimateIntensities() const;
  vtkBooleanMacro(ReestimateIntensities, bool);
  ///@}

  ///@{
  /**
   * Close and open the foreground by balls and keep the seed's component, so that thin bridges to
   * neighbors do not leak. Default on.
   */
  void SetLeakControl(bool value);
  bool GetLeakControl() const;
  vtkBooleanMacro(LeakControl, bool);
  ///@}

  ///@{
  /**
   * With a surface on port 1 that has found its organ, the foreground is its inside and, in CT,
   * what else is connected with it and has its gray values, without what leaked through a neck (a
   * minimum cut separates it from the seed; in CT, not where the gray values go on unchanged and no
   * edge is in between), up to where the gray values are halfway between those of the organ and
   * those of its surroundings, both taken locally. In CT, the fat in hollows that open to the
   * outside, at most 20 mm wide, is removed from it, and so is the inferior vena cava from an organ
   * of at least 0.7 l, as a liver is. Default on. vtkFlipFreeSegmentation first runs all levels
   * without carving, then carves, and runs all levels again, from the start, on that foreground. A
   * pipeline of the stages does the same, from a seed within one tissue, with CarvingOff() at first
   * and CarvingOn() later. See Y. Boykov, G. Funka-Lea: Graph cuts and efficient N-D image
   * segmentation, 2006. Without a surface, it does nothing.
   */
  void SetCarving(bool value);
  bool GetCarving() const;
  vtkBooleanMacro(Carving, bool);
  ///@}

  ///@{
  /**
   * Where carving changes much of the surface's inside (a Dice score below 0.92), the organ is
   * doubtful: its foreground is grown again from the carved one, with and without its intensity
   * field, and one cut decides about what two of the three hold; growth from the seed by a narrower
   * interval takes its place where its boundary is clearly better supported. Default on; takes
   * extra time for doubtful organs only. Part of Carving; without LeakControl, it does nothing.
   */
  void SetConsensus(bool value);
  bool GetConsensus() const;
  vtkBooleanMacro(Consensus, bool);
  ///@}

  /**
   * Scales of gray values.
   */
  enum ModalityType
  {
    AUTOMATIC = 0, ///< CT if the range of gray values is that of Hounsfield units, else MR
    CT = 1,        ///< Hounsfield units
    MR = 2         ///< any unit
  };

  ///@{
  /**
   * The scale of the gray values, from which Carving's tolerances are derived: AUTOMATIC (0), CT
   * (1) or MR (2). Default AUTOMATIC: CT if a hundredth of the voxels are as negative as fat in
   * Hounsfield units, and a hundredth as bright as tissue to bone, otherwise MR. For MR, the scale
   * does not matter.
   */
  void SetModality(int value);
  int GetModality() const;
  void SetModalityToAutomatic() { this->SetModality(AUTOMATIC); }
  void SetModalityToCT() { this->SetModality(CT); }
  void SetModalityToMR() { this->SetModality(MR); }
  ///@}

  ///@{
  /**
   * Radius of the closing, in millimeters. Default 1.5, 0 to 1000; at most two voxels are used, and
   * 0 does not close.
   */
  void SetClosingRadius(double value);
  double GetClosingRadius() const;
  ///@}

  ///@{
  /**
   * Radius of the opening, in seed radii; used between 2.5 and 6 mm and up to two voxels. Default
   * 0.4, 0 to 1000; 0 does not open.
   */
  void SetOpeningScale(double value);
  double GetOpeningScale() const;
  ///@}

protected:
  vtkGMMFeatureFilter();
  ~vtkGMMFeatureFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double SeedCenter[3] = { 0, 0, 0 };
  double SeedRadius = 10;

private:
  friend class vtkFlipFreeSegmentation; // takes the settings as a whole

  void RequireProperties() const;
  void ComputeFeature(vtkImageData* image, vtkPolyData* surface, vtkImageData* output);

  const std::unique_ptr<FlipFree::OrganFeatureSettings> Settings;

  vtkGMMFeatureFilter(const vtkGMMFeatureFilter&) = delete;
  void operator=(const vtkGMMFeatureFilter&) = delete;
};

#endif
