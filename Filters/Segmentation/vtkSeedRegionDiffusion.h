/**
 * @class   vtkSeedRegionDiffusion
 * @brief   smooths the part of an image that a surface grown from the seed can reach
 *
 * Anisotropic diffusion (P. Perona and J. Malik, 1990; section 3.2 of the paper) with physical
 * spacing, on the box of voxels within Reach of the seed alone. Its scale, what counts as an edge,
 * is taken from the noise in the seed sphere, so that cropping the image elsewhere changes nothing.
 *
 * Input port 0: vtkImageData with one scalar component of any type.
 * Output port 0: vtkImageData of the box, float; its extent, origin and direction keep every voxel
 * in its place. Field data `NoiseStandardDeviation` (one double, gray values): the noise found
 * before smoothing.
 *
 * Errors: an image without scalars or with several components, voxels that are not finite, a seed
 * outside the image or smaller than a voxel.
 */
#ifndef vtkSeedRegionDiffusion_h
#define vtkSeedRegionDiffusion_h

#include "FlipFreeSegmentationModule.h"
#include "vtkImageAlgorithm.h"

class FLIPFREESEGMENTATION_EXPORT vtkSeedRegionDiffusion : public vtkImageAlgorithm
{
public:
  static vtkSeedRegionDiffusion* New();
  vtkTypeMacro(vtkSeedRegionDiffusion, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Center of the seed sphere, in millimeters. Default (0, 0, 0).
   */
  vtkSetVector3Macro(SeedCenter, double);
  vtkGetVector3Macro(SeedCenter, double);
  ///@}

  ///@{
  /**
   * Radius of the seed sphere, in millimeters. Default 10; a voxel or more.
   */
  vtkSetClampMacro(SeedRadius, double, 1e-6, 1e6);
  vtkGetMacro(SeedRadius, double);
  ///@}

  ///@{
  /**
   * Half the edge length of the box around the seed's center, in millimeters. Default 100.
   */
  vtkSetClampMacro(Reach, double, 1e-6, 1e6);
  vtkGetMacro(Reach, double);
  ///@}

  ///@{
  /**
   * Number of explicit steps, each the greatest stable one. Default 5; zero only crops.
   */
  vtkSetClampMacro(NumberOfIterations, int, 0, 1000);
  vtkGetMacro(NumberOfIterations, int);
  ///@}

  /**
   * Values of Equation.
   */
  enum EquationType
  {
    FACES = 0,
    GRADIENT = 1,
    CURVATURE = 2
  };

  ///@{
  /**
   * What keeps edges. FACES (default): each face between two voxels conducts by the difference
   * across it, which is fastest and smooths most. GRADIENT and CURVATURE: the equations of ITK's
   * filters, with their numbers, and the noise's gradient for their scale;
   * vtkAnisotropicDiffusionPrefilter runs ITK's own.
   */
  vtkSetClampMacro(Equation, int, FACES, CURVATURE);
  vtkGetMacro(Equation, int);
  void SetEquationToFaces() { this->SetEquation(FACES); }
  void SetEquationToGradient() { this->SetEquation(GRADIENT); }
  void SetEquationToCurvature() { this->SetEquation(CURVATURE); }
  ///@}

protected:
  vtkSeedRegionDiffusion() = default;
  ~vtkSeedRegionDiffusion() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double SeedCenter[3] = { 0, 0, 0 };
  double SeedRadius = 10;
  double Reach = 100;
  int NumberOfIterations = 5;
  int Equation = FACES;

private:
  vtkSeedRegionDiffusion(const vtkSeedRegionDiffusion&) = delete;
  void operator=(const vtkSeedRegionDiffusion&) = delete;
};

#endif
