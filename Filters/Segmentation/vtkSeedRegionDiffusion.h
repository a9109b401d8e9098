/**
 * @class   vtkSeedRegionDiffusion
 * @brief   smooths the part of an image that a surface grown from the seed can reach
 *
 * Anisotropic diffusion (P. Perona and J. Malik, 1990; section 3.2 of the paper) with physical
 * spacing, on the box of voxels within Reach of the seed. The contrast that counts as an edge is
 * derived from the noise in the seed sphere, so cropping the image elsewhere changes nothing.
 * vtkAnisotropicDiffusionPrefilter runs ITK's equations instead.
 *
 * Input port 0: vtkImageData with one scalar component of any type. Voxels that are not finite
 * have no data: nothing flows to or from them, as across the image's border, and they stay so.
 * Output port 0: vtkImageData of the box, float; its extent, origin and direction keep every voxel
 * in its place. Field data `NoiseStandardDeviation` (one double, gray values): the noise found
 * before smoothing.
 *
 * Errors, with a code of FlipFreeErrorCode.h: an image without scalars or with several components,
 * a seed outside the image, smaller than a voxel or wider than the image, or with voxels that are
 * not finite, a Reach that ends within the seed, a property that is NaN.
 */
#ifndef vtkSeedRegionDiffusion_h
#define vtkSeedRegionDiffusion_h

#include "FlipFreeSegmentationModule.h"
#include "vtkImageAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace FlipFree
{
struct SmoothingSettings;
}

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
   * Radius of the seed sphere, in millimeters. Default 10; at least a voxel.
   */
  void SetSeedRadius(double value);
  vtkGetMacro(SeedRadius, double);
  ///@}

  ///@{
  /**
   * How far from the seed's center, in millimeters, the surface may get; only this box of the image
   * is read. Default 0: ten seed radii, at least 100 and at most 250 mm.
   */
  void SetReach(double value);
  double GetReach() const;
  ///@}

  ///@{
  /**
   * Number of explicit steps, each the largest stable one. Default 5, 0 to 1000; 0 only crops.
   */
  void SetNumberOfIterations(int value);
  int GetNumberOfIterations() const;
  ///@}

protected:
  vtkSeedRegionDiffusion();
  ~vtkSeedRegionDiffusion() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double SeedCenter[3] = { 0, 0, 0 };
  double SeedRadius = 10;

private:
  friend class vtkFlipFreeSegmentation; // takes the settings as a whole

  void RequireProperties() const;

  const std::unique_ptr<FlipFree::SmoothingSettings> Settings;

  vtkSeedRegionDiffusion(const vtkSeedRegionDiffusion&) = delete;
  void operator=(const vtkSeedRegionDiffusion&) = delete;
};

#endif
