/**
 * @class   vtkAnisotropicDiffusionPrefilter
 * @brief   smooths a region of an image but not its edges, by ITK
 *
 * The prefilter of section 3.2 of the paper: ITK's curvature or gradient anisotropic diffusion, on
 * a region of the image only. It differs from ITK's filters in two defaults. The time step is the
 * largest that ITK calls stable for the image's spacing. The gradient magnitude that counts as an
 * edge is measured in a sphere (usually the seed) or given, and stays the same over the iterations;
 * ITK's average over the image would depend on how the image is cropped and on what else it shows.
 * So a voxel's result depends only on the voxels within NumberOfIterations of it and on the
 * sphere.
 *
 * Conduction falls off as exp(-(|gradient| / (Conductance * GradientScale))^2 / 2). In ITK's units
 * of time, one step changes intensities along an axis by TimeStep / spacing of their second
 * difference.
 *
 * As in ITK, gradients are measured along the grid's axes. If these are not at right angles (tilted
 * gantry), the smoothing is sheared with the grid.
 *
 * Input port 0: vtkImageData with one component of finite scalars; vtkSeedRegionDiffusion leaves
 * others out. Output port 0: vtkImageData, the VOI with the input's indices and geometry; scalars
 * float. Field data `NoiseStandardDeviation` (one double, gray values), only if there is a scale
 * sphere: the noise found in it before smoothing, as by vtkSeedRegionDiffusion, for
 * vtkGMMFeatureFilter.
 *
 * Errors, with a code of FlipFreeErrorCode.h: a missing or empty image, no scalars, several
 * components, scalars of bits, a spacing that is not positive, NaN or infinite voxels, a VOI or a
 * sphere without a voxel of the image, a TimeStep that is not stable, a property that is not a
 * number. Each is reported once and leaves the output empty. After an abort the output is empty
 * without an error; aborts take effect within an iteration.
 *
 * Source: ITK's itk::CurvatureAnisotropicDiffusionImageFilter (R. Whitaker and X. Xue,
 * Variable-conductance, level-set curvature for image denoising, ICIP 2001) and
 * itk::GradientAnisotropicDiffusionImageFilter (P. Perona and J. Malik, Scale-space and edge
 * detection using anisotropic diffusion, PAMI 12, 1990).
 */
#ifndef vtkAnisotropicDiffusionPrefilter_h
#define vtkAnisotropicDiffusionPrefilter_h

#include "FlipFreeImagingModule.h"
#include "vtkImageAlgorithm.h"

class FLIPFREEIMAGING_EXPORT vtkAnisotropicDiffusionPrefilter : public vtkImageAlgorithm
{
public:
  static vtkAnisotropicDiffusionPrefilter* New();
  vtkTypeMacro(vtkAnisotropicDiffusionPrefilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Values of Equation.
   */
  enum EquationType
  {
    CURVATURE = 0,
    GRADIENT = 1
  };

  ///@{
  /**
   * CURVATURE (default) flattens noise and keeps thin structures; GRADIENT is Perona and Malik's
   * equation, which conserves the mean.
   */
  vtkSetClampMacro(Equation, int, CURVATURE, GRADIENT);
  vtkGetMacro(Equation, int);
  void SetEquationToCurvature() { this->SetEquation(CURVATURE); }
  void SetEquationToGradient() { this->SetEquation(GRADIENT); }
  ///@}

  ///@{
  /**
   * Number of time steps. Default 5; 0 only converts to float.
   */
  vtkSetClampMacro(NumberOfIterations, int, 0, 10000);
  vtkGetMacro(NumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Length of a time step. 0 (default) means the largest stable one, a sixteenth of the smallest
   * spacing.
   */
  vtkSetClampMacro(TimeStep, double, 0, 1e9);
  vtkGetMacro(TimeStep, double);
  ///@}

  ///@{
  /**
   * How far gradients are smoothed away, in multiples of the gradient scale. Default 1; positive.
   */
  vtkSetClampMacro(Conductance, double, 1e-9, 1e9);
  vtkGetMacro(Conductance, double);
  ///@}

  ///@{
  /**
   * The gradient magnitude that is taken as the unit, in gray values per millimeter. 0 (default)
   * means the root mean square over the voxels of the scale sphere; if that is 0, too, because they
   * all have one gray value, nothing is smoothed.
   */
  vtkSetClampMacro(GradientScale, double, 0, 1e30);
  vtkGetMacro(GradientScale, double);
  ///@}

  ///@{
  /**
   * The sphere that gives the gradient scale and `NoiseStandardDeviation`: center (default 0, 0, 0)
   * and radius in millimeters. With a radius of 0 (default), the scale is measured in the whole
   * VOI, on which it otherwise does not depend, and there is no `NoiseStandardDeviation`.
   */
  vtkSetVector3Macro(ScaleCenter, double);
  vtkGetVector3Macro(ScaleCenter, double);
  vtkSetClampMacro(ScaleRadius, double, 0, 1e9);
  vtkGetMacro(ScaleRadius, double);
  ///@}

  ///@{
  /**
   * The region to filter, as an extent in voxels; what lies outside the image is cut off. Empty
   * (0, -1, 0, -1, 0, -1; the default) means the whole image.
   */
  vtkSetVector6Macro(VOI, int);
  vtkGetVector6Macro(VOI, int);
  ///@}

  ///@{
  /**
   * The gradient scale and the time step that the last update used.
   */
  vtkGetMacro(GradientScaleUsed, double);
  vtkGetMacro(TimeStepUsed, double);
  ///@}

protected:
  vtkAnisotropicDiffusionPrefilter() = default;
  ~vtkAnisotropicDiffusionPrefilter() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Equation = CURVATURE;
  int NumberOfIterations = 5;
  double TimeStep = 0;
  double Conductance = 1;
  double GradientScale = 0;
  double ScaleCenter[3] = { 0, 0, 0 };
  double ScaleRadius = 0;
  int VOI[6] = { 0, -1, 0, -1, 0, -1 };
  double GradientScaleUsed = 0;
  double TimeStepUsed = 0;

private:
  vtkAnisotropicDiffusionPrefilter(const vtkAnisotropicDiffusionPrefilter&) = delete;
  void operator=(const vtkAnisotropicDiffusionPrefilter&) = delete;
};

#endif
